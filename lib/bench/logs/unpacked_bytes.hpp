#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "logs/byte_reader.hpp"

namespace avoidbench {

/// A chunk of a log: records packed together, which follow in the file.
struct PackedChunk {
  std::uint64_t position = 0;  ///< of its record in the file, bytes
  std::string_view
      packing;  ///< as the file names it: "" or none, bz2, lz4 (its frame format), zstd
  std::uint64_t packed_bytes = 0, unpacked_bytes = 0;  ///< as the file says
  std::optional<std::uint32_t> crc32;                  ///< of what it unpacks to
};

/// What the chunk that comes next in `file` unpacks to, piece by piece. Reading to its end takes
/// all of the chunk from the file and checks its size and checksums. Throws InputError for an
/// unknown packing, for a chunk that says to be larger than any that is written, and for damage;
/// CutOff where the file ends within.
std::unique_ptr<ByteSource> unpacked(ByteReader& file, const PackedChunk& chunk);

}  // namespace avoidbench
