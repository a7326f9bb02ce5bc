#include "export/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <concepts>

#include "base/check.hpp"

namespace avoidbench {
namespace {

// Depth images are mostly noise to it: higher levels take several times as long for a few percent.
constexpr int kZstdLevel = 1;

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

/// Opcodes of records.
enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

/// The content of a record. Numbers are little-endian, as this machine's are.
class Content {
 public:
  static_assert(std::endian::native == std::endian::little);

  template <std::unsigned_integral T>
  Content& number(T value) {
    return raw(std::as_bytes(std::span(&value, 1)));
  }
  Content& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return raw(std::as_bytes(std::span(text)));
  }
  /// An array or a map, which begins with its length in bytes.
  Content& list(const Content& content) {
    number(static_cast<std::uint32_t>(content.bytes_.size()));
    return raw(content.bytes_);
  }
  Content& raw(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  std::vector<std::byte> take() { return std::move(bytes_); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

std::uint32_t crc_of(std::span<const std::byte> bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void add_record(std::uint8_t opcode, std::span<const std::byte> content,
                std::vector<std::byte>& records) {
  Content head;
  head.number(opcode).number(std::uint64_t{content.size()});
  records.insert(records.end(), head.bytes().begin(), head.bytes().end());
  records.insert(records.end(), content.begin(), content.end());
}

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
  std::vector<std::byte> packed(::ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ::ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  AB_CHECK(::ZSTD_isError(size) == 0, ::ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

Content texts_content(const McapTexts& texts) {
  Content content;
  for (const auto& [name, value] : texts) content.text(name).text(value);
  return content;
}

}  // namespace

McapWriter::McapWriter(std::ostream& stream, const std::string& profile, const std::string& library)
    : stream_(stream) {
  put(std::as_bytes(std::span(kMagic)));
  put_record(kHeader, Content().text(profile).text(library).bytes());
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const McapSchema& schema,
                                      const std::string& message_encoding) {
  const auto known = std::find_if(schemas_.begin(), schemas_.end(), [&](const McapSchema& s) {
    return s.name == schema.name && s.encoding == schema.encoding;
  });
  const auto index = static_cast<std::uint16_t>(known - schemas_.begin());
  if (known == schemas_.end()) {
    schemas_.push_back(schema);
    is_schema_written_.push_back(false);
  }
  channels_.push_back({.schema = static_cast<std::uint16_t>(index + 1),  // 0 means: none
                       .topic = topic,
                       .message_encoding = message_encoding});
  return static_cast<std::uint16_t>(channels_.size() - 1);
}

void McapWriter::write(std::uint16_t channel, McapTime time, std::span<const std::byte> data) {
  Channel& its = channels_[channel];
  if (its.count == 0) {
    const auto schema = static_cast<std::size_t>(its.schema - 1);
    if (!is_schema_written_[schema]) add_record(kSchema, schema_content(schema), chunk_);
    is_schema_written_[schema] = true;
    add_record(kChannel, channel_content(channel), chunk_);
  }
  const bool is_first = chunk_index_.empty();
  chunk_first_ = is_first ? time : std::min(chunk_first_, time);
  chunk_last_ = is_first ? time : std::max(chunk_last_, time);
  first_ = message_count_ == 0 ? time : std::min(first_, time);
  last_ = std::max(last_, time);
  chunk_index_[channel].emplace_back(time, chunk_.size());
  // Published when logged: there is one clock, the simulation's.
  add_record(
      kMessage,
      Content().number(channel).number(its.count).number(time).number(time).raw(data).bytes(),
      chunk_);
  ++its.count;
  ++message_count_;
  if (chunk_.size() >= kMcapChunkBytes) close_chunk();
}

void McapWriter::write_metadata(const std::string& name, const McapTexts& texts) {
  const std::uint64_t begin = offset_;
  put_record(kMetadata, Content().text(name).list(texts_content(texts)).bytes());
  metadata_.push_back({.begin = begin, .length = offset_ - begin, .name = name});
}

void McapWriter::finish() {
  close_chunk();
  put_record(kDataEnd, Content().number(crc_).bytes());
  put_summary();
  put(std::as_bytes(std::span(kMagic)));
}

void McapWriter::put(std::span<const std::byte> bytes) {
  crc_ = crc_of(bytes, crc_);
  offset_ += bytes.size();
  stream_.write(reinterpret_cast<const char*>(bytes.data()),
                static_cast<std::streamsize>(bytes.size()));
}

void McapWriter::put_record(std::uint8_t opcode, std::span<const std::byte> content) {
  Content head;
  put(head.number(opcode).number(std::uint64_t{content.size()}).bytes());
  put(content);
}

std::vector<std::byte> McapWriter::schema_content(std::size_t index) const {
  const McapSchema& schema = schemas_[index];
  return Content()
      .number(static_cast<std::uint16_t>(index + 1))
      .text(schema.name)
      .text(schema.encoding)
      .text(schema.definition)
      .take();
}

std::vector<std::byte> McapWriter::channel_content(std::size_t index) const {
  const Channel& channel = channels_[index];
  return Content()
      .number(static_cast<std::uint16_t>(index))
      .number(channel.schema)
      .text(channel.topic)
      .text(channel.message_encoding)
      .list(Content())  // without metadata
      .take();
}

void McapWriter::close_chunk() {
  if (chunk_.empty()) return;
  ChunkPlace place{.first = chunk_first_,
                   .last = chunk_last_,
                   .begin = offset_,
                   .compression = "zstd",
                   .bytes = chunk_.size()};
  const std::vector<std::byte> packed = compressed(chunk_);
  place.compressed_bytes = packed.size();
  put_record(kChunk, Content()
                         .number(place.first)
                         .number(place.last)
                         .number(place.bytes)
                         .number(crc_of(chunk_))
                         .text(place.compression)
                         .number(place.compressed_bytes)
                         .raw(packed)
                         .bytes());
  place.length = offset_ - place.begin;
  put_chunk_indexes(place);
  chunks_.push_back(std::move(place));
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::put_chunk_indexes(ChunkPlace& place) {
  const std::uint64_t begin = offset_;
  for (const auto& [channel, messages] : chunk_index_) {
    place.indexes[channel] = offset_;
    Content places;
    for (const auto& [time, offset] : messages) places.number(time).number(offset);
    put_record(kMessageIndex, Content().number(channel).list(places).bytes());
  }
  place.index_length = offset_ - begin;
}

std::vector<std::byte> McapWriter::statistics_content() const {
  Content counts;
  std::uint32_t channel_count = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].count == 0) continue;
    counts.number(static_cast<std::uint16_t>(i)).number(std::uint64_t{channels_[i].count});
    ++channel_count;
  }
  const auto schema_count = std::count(is_schema_written_.begin(), is_schema_written_.end(), true);
  return Content()
      .number(message_count_)
      .number(static_cast<std::uint16_t>(schema_count))
      .number(channel_count)
      .number(std::uint32_t{0})  // attachments
      .number(static_cast<std::uint32_t>(metadata_.size()))
      .number(static_cast<std::uint32_t>(chunks_.size()))
      .number(first_)
      .number(last_)
      .list(counts)
      .take();
}

void McapWriter::put_summary() {
  const std::uint64_t summary = offset_;
  crc_ = 0;
  std::vector<std::byte> groups;  // SummaryOffset records
  const auto put_group = [&](Opcode opcode, const std::vector<std::vector<std::byte>>& contents) {
    const std::uint64_t begin = offset_;
    for (const std::vector<std::byte>& content : contents) put_record(opcode, content);
    if (offset_ == begin) return;
    add_record(kSummaryOffset,
               Content()
                   .number(static_cast<std::uint8_t>(opcode))
                   .number(begin)
                   .number(offset_ - begin)
                   .bytes(),
               groups);
  };
  std::vector<std::vector<std::byte>> schemas, channels, chunks, metadata;
  for (std::size_t i = 0; i < schemas_.size(); ++i) {
    if (is_schema_written_[i]) schemas.push_back(schema_content(i));
  }
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].count > 0) channels.push_back(channel_content(i));
  }
  for (const ChunkPlace& place : chunks_) {
    Content indexes;
    for (const auto& [channel, offset] : place.indexes) indexes.number(channel).number(offset);
    chunks.push_back(Content()
                         .number(place.first)
                         .number(place.last)
                         .number(place.begin)
                         .number(place.length)
                         .list(indexes)
                         .number(place.index_length)
                         .text(place.compression)
                         .number(place.compressed_bytes)
                         .number(place.bytes)
                         .take());
  }
  for (const MetadataPlace& place : metadata_) {
    metadata.push_back(Content().number(place.begin).number(place.length).text(place.name).take());
  }
  put_group(kSchema, schemas);
  put_group(kChannel, channels);
  put_group(kStatistics, {statistics_content()});
  put_group(kChunkIndex, chunks);
  put_group(kMetadataIndex, metadata);
  const std::uint64_t summary_offsets = offset_;
  put(groups);
  // The checksum is over all of the summary up to itself, the footer's beginning included.
  constexpr std::uint64_t kFooterBytes = 20;
  Content footer;
  put(footer.number(std::uint8_t{kFooter})
          .number(kFooterBytes)
          .number(summary)
          .number(summary_offsets)
          .bytes());
  put(Content().number(crc_).bytes());
}

}  // namespace avoidbench
