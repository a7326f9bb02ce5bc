#include "logs/unpacked_bytes.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <new>
#include <string>

#include "base/check.hpp"

namespace avoidbench {
namespace {

/// Recorders write chunks of some MB; one has to hold the largest message.
constexpr std::uint64_t kMostUnpackedBytes = std::uint64_t{256} << 20U;
constexpr int kMostZstdWindow_log2 = 26;  // 64 MB: memory that unpacking takes

/// What one call of an unpacker did.
struct UnpackStep {
  std::size_t consumed = 0, produced = 0;
  bool is_good = true;
  bool is_whole = true;  ///< nothing has begun that has not ended
};

class UnpackedBytes : public ByteSource {
 public:
  UnpackedBytes(ByteReader& file, const PackedChunk& chunk)
      : file_(file),
        chunk_position_(chunk.position),
        packed_left_(chunk.packed_bytes),
        unpacked_left_(chunk.unpacked_bytes),
        wanted_crc_(chunk.crc32),
        buffer_(std::size_t{1} << 16U) {}

  std::size_t read(std::span<char> bytes) override {
    while (true) {
      if (packed_.empty() && packed_left_ > 0) refill();
      // A spare byte finds what unpacks to more than it says, and lets checksums at the end be
      // read.
      char spare[1];
      const std::span<char> room =
          unpacked_left_ > 0 ? bytes.first(std::min(bytes.size(), unpacked_left_)) : spare;
      const UnpackStep step = unpack(packed_, room);
      if (!step.is_good) damaged("can't be unpacked");
      const bool is_stuck = step.consumed == 0 && step.produced == 0;
      if (!is_stuck) is_whole_ = step.is_whole;
      packed_ = packed_.subspan(step.consumed);
      if (step.produced > 0) {
        if (unpacked_left_ == 0) damaged("unpacks to more bytes than it says");
        unpacked_left_ -= step.produced;
        update_crc(room.first(step.produced));
        return step.produced;
      }
      if (packed_.empty() && packed_left_ == 0) {
        check_end();
        return 0;
      }
      if (is_stuck && !packed_.empty()) damaged("bytes follow what is packed");
    }
  }

 private:
  /// Unpacks some of `in` into `out`, which is not empty. Without `in` it gives what it still has.
  virtual UnpackStep unpack(std::span<const char> in, std::span<char> out) = 0;

  void refill() {
    const std::size_t most = std::min(buffer_.size(), packed_left_);
    const std::size_t count = file_.read_some(std::span(buffer_).first(most));
    if (count == 0) file_.ended();
    packed_ = std::span(buffer_).first(count);
    packed_left_ -= count;
  }

  void update_crc(std::span<const char> bytes) {
    if (!wanted_crc_) return;
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    crc_ = static_cast<std::uint32_t>(crc32_z(crc_, data, bytes.size()));
  }

  void check_end() const {
    if (unpacked_left_ > 0 || !is_whole_) damaged("unpacks to fewer bytes than it says");
    if (wanted_crc_ && crc_ != *wanted_crc_) damaged("has another checksum (CRC-32) than it says");
  }

  [[noreturn]] void damaged(const std::string& what) const {
    file_.damaged(chunk_position_, "a chunk that " + what);
  }

  ByteReader& file_;
  std::uint64_t chunk_position_, packed_left_, unpacked_left_;
  std::optional<std::uint32_t> wanted_crc_;
  std::uint32_t crc_ = 0;
  bool is_whole_ = true;
  std::vector<char> buffer_;
  std::span<const char> packed_;  ///< of the buffer, not yet unpacked
};

class CopiedBytes final : public UnpackedBytes {
  using UnpackedBytes::UnpackedBytes;
  UnpackStep unpack(std::span<const char> in, std::span<char> out) override {
    const std::size_t count = std::min(in.size(), out.size());
    std::copy_n(in.data(), count, out.data());
    return {.consumed = count, .produced = count};
  }
};

class Bzip2Bytes final : public UnpackedBytes {
 public:
  Bzip2Bytes(ByteReader& file, const PackedChunk& chunk) : UnpackedBytes(file, chunk) {
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  Bzip2Bytes(const Bzip2Bytes&) = delete;
  Bzip2Bytes& operator=(const Bzip2Bytes&) = delete;
  ~Bzip2Bytes() override { BZ2_bzDecompressEnd(&stream_); }

 private:
  UnpackStep unpack(std::span<const char> in, std::span<char> out) override {
    if (has_ended_) return {};
    // Its pointer is not const, but it writes nothing there. Both sizes are those of buffers.
    stream_.next_in = const_cast<char*>(in.data());
    stream_.avail_in = static_cast<unsigned>(in.size());
    stream_.next_out = out.data();
    stream_.avail_out = static_cast<unsigned>(out.size());
    const int code = BZ2_bzDecompress(&stream_);
    has_ended_ = code == BZ_STREAM_END;
    return {.consumed = in.size() - stream_.avail_in,
            .produced = out.size() - stream_.avail_out,
            .is_good = code == BZ_OK || has_ended_,
            .is_whole = has_ended_};
  }

  bz_stream stream_{};
  bool has_ended_ = false;
};

class Lz4Bytes final : public UnpackedBytes {
 public:
  Lz4Bytes(ByteReader& file, const PackedChunk& chunk) : UnpackedBytes(file, chunk) {
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context_, LZ4F_VERSION)) != 0) {
      throw std::bad_alloc();
    }
  }
  Lz4Bytes(const Lz4Bytes&) = delete;
  Lz4Bytes& operator=(const Lz4Bytes&) = delete;
  ~Lz4Bytes() override { LZ4F_freeDecompressionContext(context_); }

 private:
  UnpackStep unpack(std::span<const char> in, std::span<char> out) override {
    std::size_t consumed = in.size(), produced = out.size();
    const std::size_t code =
        LZ4F_decompress(context_, out.data(), &produced, in.data(), &consumed, nullptr);
    if (LZ4F_isError(code) != 0) return {.is_good = false};
    return {.consumed = consumed, .produced = produced, .is_whole = code == 0};
  }

  LZ4F_dctx* context_ = nullptr;
};

class ZstdBytes final : public UnpackedBytes {
 public:
  ZstdBytes(ByteReader& file, const PackedChunk& chunk)
      : UnpackedBytes(file, chunk), context_(ZSTD_createDCtx()) {
    if (context_ == nullptr) throw std::bad_alloc();
    ZSTD_DCtx_setParameter(context_, ZSTD_d_windowLogMax, kMostZstdWindow_log2);
  }
  ZstdBytes(const ZstdBytes&) = delete;
  ZstdBytes& operator=(const ZstdBytes&) = delete;
  ~ZstdBytes() override { ZSTD_freeDCtx(context_); }

 private:
  UnpackStep unpack(std::span<const char> in, std::span<char> out) override {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer to{out.data(), out.size(), 0};
    const std::size_t code = ZSTD_decompressStream(context_, &to, &from);
    if (ZSTD_isError(code) != 0) return {.is_good = false};
    return {.consumed = from.pos, .produced = to.pos, .is_whole = code == 0};
  }

  ZSTD_DCtx* context_;
};

}  // namespace

std::unique_ptr<ByteSource> unpacked(ByteReader& file, const PackedChunk& chunk) {
  if (chunk.unpacked_bytes > kMostUnpackedBytes) {
    file.damaged(chunk.position, "a chunk that says to unpack to " +
                                     std::to_string(chunk.unpacked_bytes) + " bytes; at most " +
                                     std::to_string(kMostUnpackedBytes) + " are read");
  }
  if (chunk.packing.empty() || chunk.packing == "none") {
    return std::make_unique<CopiedBytes>(file, chunk);
  }
  if (chunk.packing == "bz2") return std::make_unique<Bzip2Bytes>(file, chunk);
  if (chunk.packing == "lz4") return std::make_unique<Lz4Bytes>(file, chunk);
  if (chunk.packing == "zstd") return std::make_unique<ZstdBytes>(file, chunk);
  file.damaged(chunk.position,
               "a chunk with the unknown compression " + std::string(chunk.packing));
}

}  // namespace avoidbench
