#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "planner/base/result.hpp"

namespace swallowtail::mcap {

/// A file being written from its start, whole records at a time; errors name the file and the system's
/// reason.
class OutputFile {
 public:
  static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Appends all of `bytes`. On failure (disk full, …) the file is cut back to what it was before.
  Status append(std::span<const std::byte> bytes);
  /// Returns once the file's content is on the disk itself.
  Status sync();
  Status close();
  bool is_open() const { return descriptor_ >= 0; }
  std::uint64_t size() const { return size_; }

 private:
  OutputFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
  Status fail(const char* what, int reason) const;
  int descriptor_ = -1;
  std::string name_;
  std::uint64_t size_ = 0;
};

/// A file read at any offset; nothing outside it is ever touched.
class InputFile {
 public:
  static Result<InputFile> open(const std::filesystem::path& path);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// Fills all of `into` from `offset` on, or fails.
  Status read(std::uint64_t offset, std::span<std::byte> into) const;
  std::uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }

 private:
  InputFile(int descriptor, std::string name, std::uint64_t size)
      : descriptor_(descriptor), name_(std::move(name)), size_(size) {}
  int descriptor_ = -1;
  std::string name_;
  std::uint64_t size_ = 0;
};

}  // namespace swallowtail::mcap
