#include <array>
#include <map>
#include <optional>

#include "logs/log_readers.hpp"
#include "logs/unpacked_bytes.hpp"

// The format: https://wiki.ros.org/Bags/Format/2.0. The index is not needed: records are read one
// after another, so that bags which were never closed are read, too.
namespace avoidbench {
namespace {

constexpr std::uint32_t kMostBagHeaderBytes = 1U << 20U;
constexpr std::uint32_t kMostBagTextBytes = 4U << 20U;  // of a connection: the message's definition
constexpr std::uint32_t kMostBagMessageBytes = 1U << 20U;  // of one that has poses

namespace bag_op {
constexpr unsigned char kMessage = 2, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6,
                        kConnection = 7;
}

/// A record's header: its fields, of which only those known are looked at.
struct BagRecord {
  std::uint64_t position = 0;
  std::map<std::string, std::string, std::less<>> fields;
  std::uint32_t data_bytes = 0;  ///< which follow
};

/// name=value, each behind its size.
std::map<std::string, std::string, std::less<>> bag_fields(const ByteReader& in,
                                                           std::uint64_t position,
                                                           std::string_view bytes) {
  std::map<std::string, std::string, std::less<>> fields;
  while (!bytes.empty()) {
    std::uint32_t size = 0;
    if (bytes.size() < sizeof size) in.damaged(position, "a field that ends early");
    std::memcpy(&size, bytes.data(), sizeof size);
    bytes.remove_prefix(sizeof size);
    if (size > bytes.size())
      in.damaged(position, "a field that is longer than its record's header");
    const std::string_view field = bytes.substr(0, size);
    const std::size_t equals = field.find('=');
    if (equals == field.npos) in.damaged(position, "a field without a name");
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
    bytes.remove_prefix(size);
  }
  return fields;
}

BagRecord read_bag_record(ByteReader& in) {
  BagRecord record{.position = in.position(), .fields = {}};
  const auto header_bytes = in.number<std::uint32_t>();
  if (header_bytes == 0) in.damaged_unless_zeros(record.position, "a record without a header");
  if (header_bytes > kMostBagHeaderBytes) {
    in.damaged(record.position, "a record's header of " + std::to_string(header_bytes) + " bytes");
  }
  record.fields = bag_fields(in, record.position, in.text(header_bytes));
  record.data_bytes = in.number<std::uint32_t>();
  return record;
}

template <class T>
T bag_number(const ByteReader& in, const BagRecord& record, std::string_view name) {
  const auto field = record.fields.find(name);
  if (field == record.fields.end() || field->second.size() != sizeof(T)) {
    in.damaged(record.position, "a record without the field " + std::string(name));
  }
  T value;
  std::memcpy(&value, field->second.data(), sizeof value);
  return value;
}

std::string_view bag_text(const BagRecord& record, std::string_view name) {
  const auto field = record.fields.find(name);
  return field == record.fields.end() ? std::string_view() : std::string_view(field->second);
}

class BagReader {
 public:
  BagReader(ByteReader& in, FlightBuilder& flight) : in_(in), flight_(flight) {}

  void read() {
    in_.skip(kBagMagic.size());
    read_bag_header();
    while (!in_.at_end()) {
      // Behind it stands only what was written before.
      if (index_position_ != 0 && in_.position() >= index_position_) return;
      const BagRecord record = read_bag_record(in_);
      if (index_position_ != 0 && in_.position() + record.data_bytes > index_position_) {
        in_.damaged(record.position, "a record that reaches into the bag's index");
      }
      if (bag_number<unsigned char>(in_, record, "op") == bag_op::kChunk) {
        read_chunk(record);
      } else {
        read_record(in_, record);
      }
    }
    if (in_.position() < index_position_) in_.ended();
    if (index_position_ != 0) return;
    flight_.warn(in_.file().string() +
                 " was never closed, as after a crash: the flight's last seconds may be missing");
  }

 private:
  void read_bag_header() {
    const BagRecord record = read_bag_record(in_);
    if (bag_number<unsigned char>(in_, record, "op") != bag_op::kBagHeader) {
      in_.damaged(record.position, "the first record is not the bag's header");
    }
    index_position_ = bag_number<std::uint64_t>(in_, record, "index_pos");
    if (!bag_text(record, "encryptor").empty())
      in_.damaged(record.position, "the bag is encrypted");
    in_.skip(record.data_bytes);
  }

  void read_chunk(const BagRecord& record) {
    const PackedChunk chunk{.position = record.position,
                            .packing = bag_text(record, "compression"),
                            .packed_bytes = record.data_bytes,
                            .unpacked_bytes = bag_number<std::uint32_t>(in_, record, "size"),
                            .crc32 = {}};
    const std::unique_ptr<ByteSource> source = unpacked(in_, chunk);
    ByteReader records(*source, in_, record.position);
    while (!records.at_end()) {
      const BagRecord inner = read_bag_record(records);
      if (bag_number<unsigned char>(records, inner, "op") == bag_op::kChunk) {
        records.damaged(inner.position, "a chunk in a chunk");
      }
      read_record(records, inner);
    }
  }

  void read_record(ByteReader& in, const BagRecord& record) {
    try {
      switch (bag_number<unsigned char>(in, record, "op")) {
        case bag_op::kMessage:
          return read_bag_message(in, record);
        case bag_op::kConnection:
          return read_connection(in, record);
        case bag_op::kIndex:
        case bag_op::kChunkInfo:
          return in.skip(record.data_bytes);
        default:
          in.damaged(record.position, "a record of an unknown kind");
      }
    } catch (const BadMessage& bad) {
      in.damaged(record.position, bad.what());
    }
  }

  void read_connection(ByteReader& in, const BagRecord& record) {
    if (record.data_bytes > kMostBagTextBytes) throw BadMessage("a connection that is too large");
    const auto id = bag_number<std::uint32_t>(in, record, "conn");
    const auto data = bag_fields(in, record.position, in.text(record.data_bytes));
    const auto type = data.find("type");
    if (type == data.end()) throw BadMessage("a connection without a type");
    const std::size_t topic = flight_.topic(bag_text(record, "topic"), type->second);
    if (topics_.size() > 100'000) throw BadMessage("more than 100000 connections");
    topics_.insert_or_assign(id, topic);
  }

  void read_bag_message(ByteReader& in, const BagRecord& record) {
    const auto topic = topics_.find(bag_number<std::uint32_t>(in, record, "conn"));
    if (topic == topics_.end()) throw BadMessage("a message of a connection that is not known");
    const auto time = bag_number<std::array<std::uint32_t, 2>>(in, record, "time");
    if (!flight_.wants_message(topic->second)) return in.skip(record.data_bytes);
    if (record.data_bytes > kMostBagMessageBytes) throw BadMessage("it is longer than its type");
    const std::string bytes = in.text(record.data_bytes);
    flight_.read_message(topic->second, {bytes, MessageEncoding::ros1},
                         std::int64_t{time[0]} * 1'000'000'000 + time[1]);
  }

  ByteReader& in_;
  FlightBuilder& flight_;
  std::uint64_t index_position_ = 0;  ///< 0: the bag was not closed
  std::map<std::uint32_t, std::size_t> topics_;
};

}  // namespace

void read_bag(ByteReader& in, FlightBuilder& flight) {
  flight.set_format("ROS 1 bag");
  BagReader(in, flight).read();
}

}  // namespace avoidbench
