#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace avoidbench {

/// Time of a message, ns.
using McapTime = std::uint64_t;

/// Bytes of records before they are compressed; a longer message has a chunk of its own.
inline constexpr std::size_t kMcapChunkBytes = std::size_t{4} << 20U;

/// What the messages of some channels are.
struct McapSchema {
  std::string name, encoding, definition;
};

/// Texts by their names, as MCAP's records have them.
using McapTexts = std::map<std::string, std::string>;

/// Writes an MCAP file, version 0 (mcap.dev/spec), from its first byte to its last: messages in
/// chunks that are compressed by zstd, with all indexes and checksums. Memory is that of one chunk
/// and of the indexes. The same calls give the same bytes with the same version of libzstd. Whether
/// the stream took it all is the caller's to look at.
class McapWriter {
 public:
  /// `profile`: "ros2"; `library`: what writes it. The stream must outlive the writer.
  McapWriter(std::ostream& stream, const std::string& profile, const std::string& library);

  /// The number of a new channel. Schemas of the same name and encoding are one. Both are written
  /// with the channel's first message; a channel without messages is not in the file.
  std::uint16_t add_channel(const std::string& topic, const McapSchema& schema,
                            const std::string& message_encoding);
  void write(std::uint16_t channel, McapTime time, std::span<const std::byte> data);
  void write_metadata(const std::string& name, const McapTexts& texts);
  /// Writes what is left, and the summary. Nothing may be written after it.
  void finish();

  std::uint64_t message_count() const { return message_count_; }

 private:
  struct Channel {
    std::uint16_t schema = 0;  ///< from 1 on, as schemas are numbered
    std::string topic, message_encoding;
    std::uint32_t count = 0;  ///< of messages
  };
  /// Where a chunk is, for the summary.
  struct ChunkPlace {
    McapTime first = 0, last = 0;
    std::uint64_t begin = 0, length = 0, index_length = 0;
    std::string compression = {};
    std::uint64_t compressed_bytes = 0, bytes = 0;
    std::map<std::uint16_t, std::uint64_t> indexes = {};  ///< offset by channel
  };
  struct MetadataPlace {
    std::uint64_t begin = 0, length = 0;
    std::string name;
  };

  void put(std::span<const std::byte> bytes);
  void put_record(std::uint8_t opcode, std::span<const std::byte> content);
  std::vector<std::byte> schema_content(std::size_t index) const;
  std::vector<std::byte> channel_content(std::size_t index) const;
  std::vector<std::byte> statistics_content() const;
  void close_chunk();
  void put_chunk_indexes(ChunkPlace& place);
  void put_summary();

  std::ostream& stream_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;  ///< of all bytes since it was last set to 0
  std::vector<McapSchema> schemas_;
  std::vector<bool> is_schema_written_;
  std::vector<Channel> channels_;
  std::vector<std::byte> chunk_;  ///< records
  McapTime chunk_first_ = 0, chunk_last_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<McapTime, std::uint64_t>>> chunk_index_;
  std::vector<ChunkPlace> chunks_;
  std::vector<MetadataPlace> metadata_;
  std::uint64_t message_count_ = 0;
  McapTime first_ = 0, last_ = 0;
};

}  // namespace avoidbench
