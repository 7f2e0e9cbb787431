#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/record/mcap/records.hpp"

namespace swallowtail::mcap {

static_assert(std::endian::native == std::endian::little, "MCAP integers are copied as they are");

/// Appends MCAP's primitive types to a buffer.
class ByteSink {
 public:
  template <std::unsigned_integral T>
  void put(T value) {
    put_bytes({reinterpret_cast<const std::byte*>(&value), sizeof value});
  }
  void put(Op op) { put(static_cast<std::uint8_t>(op)); }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    put_bytes(std::as_bytes(std::span(text)));
  }
  void put(const StringMap& map) {
    const std::size_t start = begin_sized<std::uint32_t>();
    for (const auto& [key, value] : map) {
      put(std::string_view(key));
      put(std::string_view(value));
    }
    end_sized<std::uint32_t>(start);
  }
  template <std::unsigned_integral K, std::unsigned_integral V>
  void put(const std::map<K, V>& map) {
    put(static_cast<std::uint32_t>(map.size() * (sizeof(K) + sizeof(V))));
    for (const auto& [key, value] : map) {
      put(key);
      put(value);
    }
  }
  void put_bytes(std::span<const std::byte> data) { bytes_.insert(bytes_.end(), data.begin(), data.end()); }

  /// Leaves room for a size of type T; end_sized() fills it in with the bytes put since.
  template <std::unsigned_integral T>
  std::size_t begin_sized() {
    put(T{0});
    return bytes_.size();
  }
  template <std::unsigned_integral T>
  void end_sized(std::size_t start) {
    const T size = static_cast<T>(bytes_.size() - start);
    std::memcpy(bytes_.data() + start - sizeof(T), &size, sizeof size);
  }
  std::size_t begin_record(Op op) {
    put(op);
    return begin_sized<std::uint64_t>();
  }
  void end_record(std::size_t start) { end_sized<std::uint64_t>(start); }

  std::span<const std::byte> bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes MCAP's primitive types off untrusted bytes. Every take past the end gives an empty value and sets
/// failed(); nothing is allocated that the bytes at hand do not hold.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  T take() {
    T value{0};
    const auto raw = take_bytes(sizeof value);
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  /// `size` bytes, or none and failed() where fewer are left.
  std::span<const std::byte> take_bytes(std::uint64_t size) {
    if (failed_ || size > bytes_.size() - at_) {
      failed_ = true;
      return {};
    }
    const auto taken = bytes_.subspan(at_, static_cast<std::size_t>(size));
    at_ += taken.size();
    return taken;
  }
  std::string take_string() {
    const auto raw = take_bytes(take<std::uint32_t>());
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }
  StringMap take_string_map() {
    ByteSource inner(take_bytes(take<std::uint32_t>()));
    StringMap map;
    while (!inner.failed() && !inner.at_end()) {
      std::string key = inner.take_string();
      map.insert_or_assign(std::move(key), inner.take_string());
    }
    failed_ = failed_ || inner.failed();
    return map;
  }
  template <std::unsigned_integral K, std::unsigned_integral V>
  std::map<K, V> take_map() {
    ByteSource inner(take_bytes(take<std::uint32_t>()));
    std::map<K, V> map;
    while (!inner.failed() && !inner.at_end()) {
      const K key = inner.take<K>();
      map.insert_or_assign(key, inner.take<V>());
    }
    failed_ = failed_ || inner.failed();
    return map;
  }

  bool failed() const { return failed_; }
  bool at_end() const { return at_ == bytes_.size(); }
  std::size_t position() const { return at_; }
  std::size_t left() const { return bytes_.size() - at_; }
  std::span<const std::byte> rest() { return take_bytes(left()); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace swallowtail::mcap
