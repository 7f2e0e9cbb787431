#include "tools/record/mcap/compression.hpp"

#include <zstd.h>

#include <string>

#ifdef SWALLOWTAIL_HAVE_LZ4
#include <lz4frame.h>
#endif

namespace swallowtail::mcap {
namespace {

#ifdef SWALLOWTAIL_HAVE_LZ4
Status pack_lz4(std::span<const std::byte> records, std::vector<std::byte>& packed) {
  packed.resize(LZ4F_compressFrameBound(records.size(), nullptr));
  const std::size_t size =
      LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr);
  if (LZ4F_isError(size) != 0)
    return internal_error(std::string("LZ4 cannot compress a chunk: ") + LZ4F_getErrorName(size) + ".");
  packed.resize(size);
  return {};
}

Result<std::vector<std::byte>> unpack_lz4(std::span<const std::byte> packed, std::size_t uncompressed_size) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0)
    return internal_error("LZ4 has no memory.");
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, &LZ4F_freeDecompressionContext);
  std::vector<std::byte> records(uncompressed_size);
  std::size_t written = 0;
  std::size_t read = 0;
  std::size_t hint = 1;
  while (hint != 0) {
    std::size_t out = records.size() - written;
    std::size_t in = packed.size() - read;
    hint = LZ4F_decompress(context.get(), records.data() + written, &out, packed.data() + read, &in, nullptr);
    if (LZ4F_isError(hint) != 0)
      return bad_input(std::string("LZ4 refuses a chunk: ") + LZ4F_getErrorName(hint) + ".");
    if (out == 0 && in == 0) break;
    written += out;
    read += in;
  }
  if (hint != 0 || written != uncompressed_size)
    return bad_input("An LZ4 chunk does not hold the bytes that it says it holds.");
  return records;
}
#endif

Result<std::vector<std::byte>> unpack_zstd(std::span<const std::byte> packed, std::size_t uncompressed_size) {
  std::vector<std::byte> records(uncompressed_size);
  const std::size_t size = ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0)
    return bad_input(std::string("zstd refuses a chunk: ") + ZSTD_getErrorName(size) + ".");
  if (size != uncompressed_size)
    return bad_input("A zstd chunk does not hold the bytes that it says it holds.");
  return records;
}

}  // namespace

std::string_view compression_name(Compression compression) {
  switch (compression) {
    case Compression::kZstd:
      return "zstd";
    case Compression::kLz4:
      return "lz4";
    case Compression::kNone:
      break;
  }
  return "";
}

bool is_supported(Compression compression) {
#ifdef SWALLOWTAIL_HAVE_LZ4
  return compression == Compression::kNone || compression == Compression::kZstd ||
         compression == Compression::kLz4;
#else
  return compression == Compression::kNone || compression == Compression::kZstd;
#endif
}

struct Compressor::State {
  Compression compression;
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{nullptr, &ZSTD_freeCCtx};
};

Compressor::Compressor(Compression compression, int zstd_level) : state_(std::make_unique<State>()) {
  state_->compression = compression;
  if (compression == Compression::kZstd) {
    state_->zstd.reset(ZSTD_createCCtx());
    if (state_->zstd) ZSTD_CCtx_setParameter(state_->zstd.get(), ZSTD_c_compressionLevel, zstd_level);
  }
}
Compressor::~Compressor() = default;
Compressor::Compressor(Compressor&&) noexcept = default;
Compressor& Compressor::operator=(Compressor&&) noexcept = default;

Status Compressor::pack(std::span<const std::byte> records, std::vector<std::byte>& packed) {
#ifdef SWALLOWTAIL_HAVE_LZ4
  if (state_->compression == Compression::kLz4) return pack_lz4(records, packed);
#endif
  if (state_->compression != Compression::kZstd) {
    packed.assign(records.begin(), records.end());
    return {};
  }
  if (!state_->zstd) return internal_error("zstd has no memory.");
  packed.resize(ZSTD_compressBound(records.size()));
  const std::size_t size =
      ZSTD_compress2(state_->zstd.get(), packed.data(), packed.size(), records.data(), records.size());
  if (ZSTD_isError(size) != 0)
    return internal_error(std::string("zstd cannot compress a chunk: ") + ZSTD_getErrorName(size) + ".");
  packed.resize(size);
  return {};
}

Result<std::vector<std::byte>> unpack(std::string_view compression, std::span<const std::byte> packed,
                                      std::size_t uncompressed_size) {
  if (compression.empty()) {
    if (packed.size() != uncompressed_size)
      return bad_input("A chunk does not hold the bytes that it says it holds.");
    return std::vector<std::byte>(packed.begin(), packed.end());
  }
  if (compression == "zstd") return unpack_zstd(packed, uncompressed_size);
#ifdef SWALLOWTAIL_HAVE_LZ4
  if (compression == "lz4") return unpack_lz4(packed, uncompressed_size);
#endif
  return bad_input("A chunk is compressed by \"" + std::string(compression.substr(0, 32)) +
                   "\", which this build cannot read.");
}

}  // namespace swallowtail::mcap
