#include <map>
#include <set>

#include "logs/log_readers.hpp"
#include "logs/unpacked_bytes.hpp"

// The format: https://mcap.dev/spec. Records are read one after another; the index at the end is
// not needed.
namespace avoidbench {
namespace {

constexpr std::uint64_t kMostMcapRecordBytes = std::uint64_t{4} << 20U;   // of those looked into
constexpr std::uint64_t kMostMcapMessageBytes = std::uint64_t{1} << 20U;  // of one that has poses
constexpr std::size_t kMostMcapNameBytes = 1024;

namespace mcap_op {
constexpr unsigned char kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6,
                        kDataEnd = 15, kFirstPrivate = 128;
}

struct McapRecord {
  std::uint64_t position = 0;
  unsigned char kind = 0;
  std::uint64_t bytes = 0;  ///< which follow
};

McapRecord read_mcap_record(ByteReader& in) {
  McapRecord record{.position = in.position(), .kind = in.number<unsigned char>()};
  if (record.kind == 0) in.damaged_unless_zeros(record.position, "a record of the kind 0");
  record.bytes = in.number<std::uint64_t>();
  if (record.kind > mcap_op::kDataEnd && record.kind < mcap_op::kFirstPrivate) {
    in.damaged(record.position, "a record of the unknown kind " + std::to_string(record.kind));
  }
  return record;
}

/// The fields of a record that was read whole.
class McapFields {
 public:
  explicit McapFields(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }

 private:
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throw BadMessage("a record that is too short for its fields");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
};

struct McapChannel {
  std::size_t topic = 0;
  std::string encoding;  ///< of its messages
};

class McapReader {
 public:
  McapReader(ByteReader& in, FlightBuilder& flight) : in_(in), flight_(flight) {}

  void read() {
    in_.skip(kMcapMagic.size());
    while (!in_.at_end()) {
      const McapRecord record = read_mcap_record(in_);
      if (record.kind == mcap_op::kDataEnd || record.kind == mcap_op::kFooter) return;
      if (record.kind == mcap_op::kChunk) {
        read_chunk(record);
      } else {
        read_record(in_, record);
      }
    }
    in_.ended();
  }

 private:
  void read_chunk(const McapRecord& record) {
    constexpr std::uint64_t kMostPackingBytes = 64;
    PackedChunk chunk{.position = record.position, .packing = {}, .crc32 = {}};
    in_.skip(2 * sizeof(std::uint64_t));  // times of its first and last message
    chunk.unpacked_bytes = in_.number<std::uint64_t>();
    // 0: it has none.
    if (const auto crc = in_.number<std::uint32_t>(); crc != 0) chunk.crc32 = crc;
    const auto name_bytes = in_.number<std::uint32_t>();
    if (name_bytes > kMostPackingBytes)
      in_.damaged(record.position, "a chunk with an unknown compression");
    const std::string packing = in_.text(name_bytes);
    chunk.packing = packing;
    chunk.packed_bytes = in_.number<std::uint64_t>();
    const std::uint64_t head_bytes = in_.position() - record.position - 9;
    if (chunk.packed_bytes > record.bytes || head_bytes + chunk.packed_bytes != record.bytes) {
      in_.damaged(record.position, "a chunk whose sizes contradict each other");
    }
    const std::unique_ptr<ByteSource> source = unpacked(in_, chunk);
    ByteReader records(*source, in_, record.position);
    while (!records.at_end()) {
      const McapRecord inner = read_mcap_record(records);
      if (inner.kind == mcap_op::kChunk) records.damaged(inner.position, "a chunk in a chunk");
      read_record(records, inner);
    }
  }

  void read_record(ByteReader& in, const McapRecord& record) {
    try {
      if (record.kind == mcap_op::kMessage) return read_mcap_message(in, record);
      if (record.kind != mcap_op::kSchema && record.kind != mcap_op::kChannel) {
        return in.skip(record.bytes);
      }
      if (record.bytes > kMostMcapRecordBytes) throw BadMessage("a record that is too large");
      const std::string bytes = in.text(record.bytes);
      record.kind == mcap_op::kSchema ? read_schema(McapFields(bytes))
                                      : read_channel(McapFields(bytes));
    } catch (const BadMessage& bad) {
      in.damaged(record.position, bad.what());
    }
  }

  void read_schema(McapFields fields) {
    const auto id = fields.number<std::uint16_t>();
    const std::string_view name = fields.text();
    if (name.size() > kMostMcapNameBytes) throw BadMessage("a schema's name that is too long");
    types_.insert_or_assign(id, std::string(name));
  }

  void read_channel(McapFields fields) {
    const auto id = fields.number<std::uint16_t>();
    const auto schema = fields.number<std::uint16_t>();
    const std::string_view topic = fields.text();
    const std::string_view encoding = fields.text();
    // Schema 0: none.
    const auto type = types_.find(schema);
    if (type == types_.end() && schema != 0) throw BadMessage("a channel without its schema");
    if (encoding.size() > kMostMcapNameBytes)
      throw BadMessage("an encoding's name that is too long");
    McapChannel& channel = channels_[id];
    channel.topic = flight_.topic(topic, type == types_.end() ? "" : type->second);
    channel.encoding = encoding;
  }

  void read_mcap_message(ByteReader& in, const McapRecord& record) {
    constexpr std::uint64_t kHeadBytes = 2 + 4 + 8 + 8;
    if (record.bytes < kHeadBytes) throw BadMessage("a message without its head");
    const auto channel = channels_.find(in.number<std::uint16_t>());
    if (channel == channels_.end()) throw BadMessage("a message of a channel that is not known");
    in.number<std::uint32_t>();  // how many came before it
    const auto logged_ns = static_cast<std::int64_t>(in.number<std::uint64_t>());
    in.number<std::uint64_t>();  // when it was published
    const std::uint64_t size = record.bytes - kHeadBytes;
    const auto& [topic, encoding] = channel->second;
    if (!flight_.wants_message(topic)) return in.skip(size);
    if (size > kMostMcapMessageBytes) throw BadMessage("it is longer than its type");
    if (logged_ns < 0) throw BadMessage("its time is beyond all bounds");
    if (encoding != "cdr" && encoding != "ros1") {
      throw BadMessage("messages of the encoding '" + encoding +
                       "'; only cdr and ros1 are supported");
    }
    const std::string bytes = in.text(size);
    flight_.read_message(topic,
                         {bytes, encoding == "cdr" ? MessageEncoding::cdr : MessageEncoding::ros1},
                         logged_ns);
  }

  ByteReader& in_;
  FlightBuilder& flight_;
  std::map<std::uint16_t, std::string> types_;  ///< names of schemas
  std::map<std::uint16_t, McapChannel> channels_;
};

}  // namespace

void read_mcap(ByteReader& in, FlightBuilder& flight) {
  flight.set_format("MCAP");
  McapReader(in, flight).read();
}

}  // namespace avoidbench
