#include "tools/record/cyclone/raw_type.hpp"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace swallowtail::record::cyclone {
namespace {

constexpr std::size_t kHeaderBytes = 4;
constexpr std::uint32_t kMaxSampleBytes = 1u << 28;

struct RawType : ddsi_sertype {
  std::size_t key_fields = 0;
};

struct RawData : ddsi_serdata {
  InstanceKey key{};
  std::vector<std::byte> bytes;  ///< header included; whole multiples of 4 are not needed
};

const RawType& raw(const ddsi_sertype* type) { return *static_cast<const RawType*>(type); }
const RawData& raw(const ddsi_serdata* data) { return *static_cast<const RawData*>(data); }

std::uint32_t hash_of(const InstanceKey& key) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::uint32_t field : key) hash = (hash ^ field) * 0x100000001b3u;
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

std::uint32_t big_endian(std::uint32_t value) {
  return std::endian::native == std::endian::big ? value : __builtin_bswap32(value);
}

/// Reads the leading `unsigned long` members of a payload; false where it is too short or of an unknown
/// representation.
bool read_key(const std::vector<std::byte>& bytes, std::size_t fields, InstanceKey& key) {
  if (bytes.size() < kHeaderBytes + 4 * fields) return false;
  const auto representation = static_cast<unsigned>(bytes[1]);
  if (static_cast<unsigned>(bytes[0]) != 0 ||
      (representation != 0 && representation != 1 && representation != 6 && representation != 7)) {
    return fields == 0;  // only plain CDR and plain CDR2 put the key where we look for it
  }
  const bool is_little = (representation & 1u) != 0;
  for (std::size_t i = 0; i < fields; ++i) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + kHeaderBytes + 4 * i, sizeof value);
    key[i] = is_little == (std::endian::native == std::endian::little) ? value : __builtin_bswap32(value);
  }
  return true;
}

/// Null when the bytes have no key that we understand: Cyclone then discards the sample.
ddsi_serdata* finish(const ddsi_sertype* type, ddsi_serdata_kind kind, std::unique_ptr<RawData> data) {
  if (!read_key(data->bytes, raw(type).key_fields, data->key)) return nullptr;
  ddsi_serdata_init(data.get(), type, kind);
  data->hash = hash_of(data->key) ^ type->serdata_basehash;
  return data.release();
}

bool eqkey(const ddsi_serdata* a, const ddsi_serdata* b) { return raw(a).key == raw(b).key; }

std::uint32_t get_size(const ddsi_serdata* data) {
  return static_cast<std::uint32_t>(raw(data).bytes.size());
}

/// A sample of up to 64 kB is one fragment, a larger one a chain of them in order, possibly overlapping.
ddsi_serdata* from_ser(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragments,
                       std::size_t size) {
  if (size < kHeaderBytes || size > kMaxSampleBytes) return nullptr;
  auto data = std::make_unique<RawData>();
  data->bytes.resize(size);
  std::size_t filled = 0;
  for (const nn_rdata* fragment = fragments; fragment != nullptr; fragment = fragment->nextfrag) {
    if (fragment->maxp1 <= filled) continue;
    if (fragment->min > filled || filled >= size) break;
    const unsigned char* payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    const std::size_t end = std::min<std::size_t>(fragment->maxp1, size);
    std::memcpy(data->bytes.data() + filled, payload + (filled - fragment->min), end - filled);
    filled = end;
  }
  if (filled != size) return nullptr;
  return finish(type, kind, std::move(data));
}

ddsi_serdata* from_ser_iov(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                           const ddsrt_iovec_t* parts, std::size_t size) {
  if (size < kHeaderBytes || size > kMaxSampleBytes) return nullptr;
  auto data = std::make_unique<RawData>();
  for (std::size_t i = 0; i < count && data->bytes.size() < size; ++i) {
    const auto* begin = static_cast<const std::byte*>(parts[i].iov_base);
    data->bytes.insert(data->bytes.end(), begin,
                       begin + std::min<std::size_t>(parts[i].iov_len, size - data->bytes.size()));
  }
  if (data->bytes.size() != size) return nullptr;
  return finish(type, kind, std::move(data));
}

/// A dispose may carry nothing but the key hash: the key in big-endian CDR, padded to 16 bytes.
ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash* hash) {
  auto data = std::make_unique<RawData>();
  data->bytes.assign(kHeaderBytes, std::byte{0});
  const std::size_t key_bytes = 4 * raw(type).key_fields;
  const auto* begin = reinterpret_cast<const std::byte*>(hash->value);
  data->bytes.insert(data->bytes.end(), begin, begin + key_bytes);
  return finish(type, SDK_KEY, std::move(data));
}

ddsi_serdata* from_sample(const ddsi_sertype*, ddsi_serdata_kind, const void*) { return nullptr; }

void to_ser(const ddsi_serdata* data, std::size_t offset, std::size_t size, void* into) {
  const auto& bytes = raw(data).bytes;
  const std::size_t there = offset < bytes.size() ? std::min(size, bytes.size() - offset) : 0;
  if (there > 0) std::memcpy(into, bytes.data() + offset, there);
  std::memset(static_cast<char*>(into) + there, 0, size - there);
}

ddsi_serdata* to_ser_ref(const ddsi_serdata* data, std::size_t offset, std::size_t size, ddsrt_iovec_t* ref) {
  ref->iov_base = const_cast<std::byte*>(raw(data).bytes.data() + offset);
  ref->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(data);
}

void to_ser_unref(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }

bool to_sample(const ddsi_serdata*, void*, void**, void*) { return false; }

ddsi_serdata* to_untyped(const ddsi_serdata* data) {
  auto untyped = std::make_unique<RawData>();
  ddsi_serdata_init(untyped.get(), data->type, SDK_KEY);
  untyped->hash = data->hash;
  untyped->key = raw(data).key;
  untyped->type = nullptr;
  return untyped.release();
}

bool untyped_to_sample(const ddsi_sertype*, const ddsi_serdata*, void*, void**, void*) { return false; }

void free_data(ddsi_serdata* data) { delete static_cast<RawData*>(data); }

std::size_t print(const ddsi_sertype*, const ddsi_serdata* data, char* into, std::size_t size) {
  const std::string text = "raw sample of " + std::to_string(raw(data).bytes.size()) + " bytes";
  const std::size_t length = std::min(text.size(), size - 1);
  std::memcpy(into, text.data(), length);
  into[length] = '\0';
  return length;
}

void get_keyhash(const ddsi_serdata* data, ddsi_keyhash* into, bool) {
  std::memset(into->value, 0, sizeof into->value);
  for (std::size_t i = 0; i < raw(data).key.size(); ++i) {
    const std::uint32_t field = big_endian(raw(data).key[i]);
    std::memcpy(into->value + 4 * i, &field, sizeof field);
  }
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<RawType*>(type);
}

void zero_samples(const ddsi_sertype*, void*, std::size_t) {}

// The reader's loans are never used (samples are taken as serdata), but Cyclone wants the operations to be
// there.
void realloc_samples(void** samples, const ddsi_sertype*, void*, std::size_t, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) samples[i] = nullptr;
}

void free_samples(const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {}

bool equal(const ddsi_sertype* a, const ddsi_sertype* b) { return raw(a).key_fields == raw(b).key_fields; }

std::uint32_t hash_type(const ddsi_sertype* type) { return static_cast<std::uint32_t>(raw(type).key_fields); }

ddsi_sertype_ops make_type_ops() {
  ddsi_sertype_ops ops{};
  ops.version = &ddsi_sertype_v0;
  ops.free = &free_type;
  ops.zero_samples = &zero_samples;
  ops.realloc_samples = &realloc_samples;
  ops.free_samples = &free_samples;
  ops.equal = &equal;
  ops.hash = &hash_type;
  return ops;  // no type_id: writers match by type name only; no derive_sertype: both CDR versions share the
               // type
}

ddsi_serdata_ops make_data_ops() {
  ddsi_serdata_ops ops{};
  ops.eqkey = &eqkey;
  ops.get_size = &get_size;
  ops.from_ser = &from_ser;
  ops.from_ser_iov = &from_ser_iov;
  ops.from_keyhash = &from_keyhash;
  ops.from_sample = &from_sample;
  ops.to_ser = &to_ser;
  ops.to_ser_ref = &to_ser_ref;
  ops.to_ser_unref = &to_ser_unref;
  ops.to_sample = &to_sample;
  ops.to_untyped = &to_untyped;
  ops.untyped_to_sample = &untyped_to_sample;
  ops.free = &free_data;
  ops.print = &print;
  ops.get_keyhash = &get_keyhash;
  return ops;
}

const ddsi_sertype_ops kTypeOps = make_type_ops();
const ddsi_serdata_ops kDataOps = make_data_ops();

}  // namespace

ddsi_sertype* make_raw_type(const TopicQos& topic) {
  auto type = std::make_unique<RawType>();
  std::memset(static_cast<ddsi_sertype*>(type.get()), 0, sizeof(ddsi_sertype));
  type->key_fields = static_cast<std::size_t>(topic.key_fields);
  const std::uint32_t flags = topic.key_fields == 0 ? DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY : 0u;
  ddsi_sertype_init_flags(type.get(), topic.type_name, &kTypeOps, &kDataOps, flags);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1 | DDS_DATA_REPRESENTATION_FLAG_XCDR2;
  return type.release();
}

std::span<const std::byte> payload_of(const ddsi_serdata& data) { return raw(&data).bytes; }

InstanceKey key_of(const ddsi_serdata& data) { return raw(&data).key; }

}  // namespace swallowtail::record::cyclone
