#include "export/mcap_writer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <cstring>
#include <sstream>

#include "export/cdr_writer.hpp"
#include "export/ros2_messages.hpp"
#include "export/ros2_schema.hpp"

namespace avoidbench {
namespace {

using namespace std::string_literals;

std::string as_string(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::byte> as_bytes(const std::string& text) {
  const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, bytes.substr(at).data(), sizeof number);
  return number;
}

std::uint32_t crc(const std::string& bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// A number of each size after one that leaves a gap.
struct Gaps {
  static constexpr const char* kName = "test_msgs/msg/Gaps";
  std::uint8_t a = 1;
  double b = 1.0;
  bool c = true;
  std::string d = "xy";
  std::uint8_t e = 2;
  std::vector<double> f = {};
  std::uint8_t g = 3;
  std::array<float, 2> h{1.0F, -2.0F};
};
template <class Visitor, ConstOr<Gaps> M>
void visit(Visitor& v, M& m) {
  v.field("a", m.a);
  v.field("b", m.b);
  v.field("c", m.c);
  v.field("d", m.d);
  v.field("e", m.e);
  v.field("f", m.f);
  v.field("g", m.g);
  v.field("h", m.h);
}

TEST(Cdr, PutsNumbersAtMultiplesOfTheirSize) {
  const std::string expected =
      "\0\1\0\0"s                         // CDR, little-endian
      "\1\0\0\0\0\0\0\0"s                 // a, and a gap to 8
      "\0\0\0\0\0\0\xF0\x3F"s             // b
      "\1\0\0\0\3\0\0\0xy\0"s             // c, a gap to 20; the text with its zero
      "\2"s                               // e at 27
      "\0\0\0\0"s                         // f at 28: none, and so no gap to 32
      "\3\0\0\0\0\0\x80\x3F\0\0\0\xC0"s;  // g at 32, h at 36
  EXPECT_EQ(as_string(cdr_bytes(Gaps{})), expected);
}

TEST(Cdr, ASequenceOfNumbersBeginsAtAMultipleOfTheirSize) {
  const std::string bytes = as_string(cdr_bytes(Gaps{.f = {1.0}}));
  // Its length at 28, its number at 32.
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 4 + 28), 1U);
  EXPECT_EQ(number_at<double>(bytes, 4 + 32), 1.0);
}

TEST(Ros2Schema, HasEachMessageOnce) {
  EXPECT_EQ(ros2_definition<Gaps>(),
            "uint8 a\nfloat64 b\nbool c\nstring d\nuint8 e\nfloat64[] f\nuint8 g\nfloat32[2] h\n");
  const std::string line = std::string(80, '=') + "\nMSG: ";
  EXPECT_EQ(ros2_definition<RosPath>(),
            "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n" + line +
                "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "geometry_msgs/PoseStamped\nstd_msgs/Header header\ngeometry_msgs/Pose pose\n" +
                line +
                "geometry_msgs/Pose\ngeometry_msgs/Point position\n"
                "geometry_msgs/Quaternion orientation\n" +
                line + "geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + line +
                "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n");
}

/// A record: opcode, length, content.
std::string record(char opcode, const std::string& content) {
  std::string bytes(1, opcode);
  const std::uint64_t size = content.size();
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  return bytes + content;
}

const std::string kMagic = "\x89MCAP0\r\n"s;
const std::string kHeader = record(1, "\1\0\0\0p\1\0\0\0l"s);
const std::string kSchemaRecord = record(3, "\1\0\1\0\0\0s\1\0\0\0e\2\0\0\0df"s);
const std::string kChannelRecord = record(4, "\0\0\1\0\2\0\0\0/t\3\0\0\0cdr\0\0\0\0"s);
const std::string kFirstMessage =
    record(5, "\0\0\0\0\0\0"s + "\5\0\0\0\0\0\0\0"s + "\5\0\0\0\0\0\0\0"s + "hello"s);
const std::string kSecondMessage =
    record(5, "\0\0\1\0\0\0"s + "\7\0\0\0\0\0\0\0"s + "\7\0\0\0\0\0\0\0"s + "you"s);

std::string small_file() {
  std::ostringstream stream;
  McapWriter writer(stream, "p", "l");
  const std::uint16_t channel =
      writer.add_channel("/t", {.name = "s", .encoding = "e", .definition = "df"}, "cdr");
  writer.add_channel("/silent", {.name = "other", .encoding = "e", .definition = ""}, "cdr");
  writer.write(channel, 5, as_bytes("hello"));
  writer.write(channel, 7, as_bytes("you"));
  writer.finish();
  return stream.str();
}

/// A record of a file at an offset.
struct Read {
  Read(const std::string& file, std::size_t at)
      : opcode(file[at]),
        content(file.substr(at + 9, number_at<std::uint64_t>(file, at + 1))),
        end(at + 9 + content.size()) {}
  char opcode;
  std::string content;
  std::size_t end;
};

TEST(McapWriter, WritesTheBytesThatTheSpecificationSays) {
  const std::string file = small_file();
  ASSERT_TRUE(file.starts_with(kMagic + kHeader));
  // The chunk: first and last time, size, checksum, compression, records.
  const std::size_t chunk_at = (kMagic + kHeader).size();
  const Read chunk(file, chunk_at);
  const std::string records = kSchemaRecord + kChannelRecord + kFirstMessage + kSecondMessage;
  ASSERT_EQ(chunk.opcode, 6);
  EXPECT_EQ(number_at<std::uint64_t>(chunk.content, 0), 5U);
  EXPECT_EQ(number_at<std::uint64_t>(chunk.content, 8), 7U);
  EXPECT_EQ(number_at<std::uint64_t>(chunk.content, 16), records.size());
  EXPECT_EQ(number_at<std::uint32_t>(chunk.content, 24), crc(records));
  EXPECT_EQ(chunk.content.substr(28, 8), "\4\0\0\0zstd"s);
  const std::string packed = chunk.content.substr(44);
  EXPECT_EQ(number_at<std::uint64_t>(chunk.content, 36), packed.size());
  std::string unpacked(records.size(), '\0');
  ASSERT_EQ(::ZSTD_decompress(unpacked.data(), unpacked.size(), packed.data(), packed.size()),
            records.size());
  EXPECT_EQ(unpacked, records);
  // The index: where each message begins within the records.
  const Read index(file, chunk.end);
  ASSERT_EQ(index.opcode, 7);
  EXPECT_EQ(index.content.substr(0, 6), "\0\0\x20\0\0\0"s);
  EXPECT_EQ(number_at<std::uint64_t>(index.content, 6), 5U);
  EXPECT_EQ(records.substr(number_at<std::uint64_t>(index.content, 14), kFirstMessage.size()),
            kFirstMessage);
  EXPECT_EQ(number_at<std::uint64_t>(index.content, 22), 7U);
  EXPECT_EQ(records.substr(number_at<std::uint64_t>(index.content, 30)), kSecondMessage);
  // The end of the data.
  const Read data_end(file, index.end);
  ASSERT_EQ(data_end.opcode, 15);
  EXPECT_EQ(number_at<std::uint32_t>(data_end.content, 0), crc(file.substr(0, index.end)));
}

TEST(McapWriter, TheSummarySaysWhereAllIs) {
  const std::string file = small_file();
  ASSERT_TRUE(file.ends_with(kMagic));
  constexpr std::size_t kFooterBytes = 9 + 20;
  const std::size_t footer_at = file.size() - kMagic.size() - kFooterBytes;
  const Read footer(file, footer_at);
  ASSERT_EQ(footer.opcode, 2);
  const auto summary_at = number_at<std::uint64_t>(footer.content, 0);
  const auto offsets_at = number_at<std::uint64_t>(footer.content, 8);
  EXPECT_EQ(number_at<std::uint32_t>(footer.content, 16),
            crc(file.substr(summary_at, footer_at + 9 + 16 - summary_at)));
  // What has no messages is not there.
  EXPECT_EQ(file.substr(summary_at, (kSchemaRecord + kChannelRecord).size()),
            kSchemaRecord + kChannelRecord);
  const Read statistics(file, summary_at + (kSchemaRecord + kChannelRecord).size());
  ASSERT_EQ(statistics.opcode, 11);
  EXPECT_EQ(number_at<std::uint64_t>(statistics.content, 0), 2U);   // messages
  EXPECT_EQ(number_at<std::uint16_t>(statistics.content, 8), 1U);   // schemas
  EXPECT_EQ(number_at<std::uint32_t>(statistics.content, 10), 1U);  // channels
  EXPECT_EQ(number_at<std::uint32_t>(statistics.content, 22), 1U);  // chunks
  const Read place(file, statistics.end);
  ASSERT_EQ(place.opcode, 8);
  const auto chunk_at = number_at<std::uint64_t>(place.content, 16);
  const Read chunk(file, chunk_at);
  EXPECT_EQ(chunk.opcode, 6);
  EXPECT_EQ(number_at<std::uint64_t>(place.content, 24), chunk.end - chunk_at);
  // One channel's index: it lies behind the chunk.
  EXPECT_EQ(place.content.substr(32, 6), "\x0A\0\0\0\0\0"s);
  EXPECT_EQ(number_at<std::uint64_t>(place.content, 38), chunk.end);
  EXPECT_EQ(number_at<std::uint64_t>(place.content, 46), Read(file, chunk.end).end - chunk.end);
  // Each group has its offset.
  std::size_t at = offsets_at;
  std::string opcodes;
  while (at < footer_at) {
    const Read offset(file, at);
    ASSERT_EQ(offset.opcode, 14);
    opcodes += offset.content[0];
    EXPECT_EQ(file[number_at<std::uint64_t>(offset.content, 1)], offset.content[0]);
    at = offset.end;
  }
  EXPECT_EQ(opcodes, "\3\4\x0B\x08"s);
}

TEST(McapWriter, BeginsAChunkWhereOneIsFull) {
  std::ostringstream stream;
  McapWriter writer(stream, "", "");
  const std::uint16_t channel = writer.add_channel("/t", {"s", "e", ""}, "cdr");
  const std::vector<std::byte> message(kMcapChunkBytes / 4, std::byte{7});
  for (McapTime time = 0; time < 9; ++time) writer.write(channel, time, message);
  writer.finish();
  EXPECT_EQ(writer.message_count(), 9U);
  const std::string file = stream.str();
  int chunks = 0;
  for (std::size_t at = 8; file[at] != 15;) {
    const Read read(file, at);
    chunks += read.opcode == 6 ? 1 : 0;
    at = read.end;
  }
  EXPECT_EQ(chunks, 3);
}

}  // namespace
}  // namespace avoidbench
