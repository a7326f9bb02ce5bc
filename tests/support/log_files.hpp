#pragma once

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Small logs of one flight in every format, byte by byte as their formats say: pose i is at
/// (i, 2i, 3i) m, 20 ms after the one before, with the attitude (½, ½, ½, ½) and, where the format
/// has it, the velocity (1, 2, 3) m/s in the body's frame, which is (3, 1, 2) in the log's.
namespace avoidbench::test {

inline constexpr int kLogPoses = 6;
inline std::int64_t log_time_ns(int i) { return 1'700'000'000'000'000'000 + i * 20'000'000LL; }

/// Numbers and texts one after another, as their formats write them.
class LogBytes {
 public:
  template <class T>
  LogBytes& number(T value, bool is_big_endian = false) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (is_big_endian) std::reverse(bytes, bytes + sizeof value);
    text.append(bytes, sizeof value);
    return *this;
  }
  template <class T>
  LogBytes& numbers(std::initializer_list<T> values) {
    for (const T value : values) number(value);
    return *this;
  }
  LogBytes& bytes(std::string_view value) {
    text += value;
    return *this;
  }
  /// Behind its size.
  LogBytes& sized(std::string_view value) {
    return number(static_cast<std::uint32_t>(value.size())).bytes(value);
  }
  std::string text;
};

/// A message as ROS 1 writes it, or ROS 2 in either order of bytes.
class RosMessage {
 public:
  enum class Kind { ros1, cdr, cdr_big };

  explicit RosMessage(Kind kind) : kind_(kind) {
    if (kind != Kind::ros1) bytes_.bytes({"\0\1\0\0", 4});
    if (kind == Kind::cdr_big) bytes_.text[1] = '\0';
  }
  template <class T>
  RosMessage& number(T value) {
    while (kind_ != Kind::ros1 && (bytes_.text.size() - 4) % sizeof value != 0)
      bytes_.bytes({"", 1});
    bytes_.number(value, kind_ == Kind::cdr_big);
    return *this;
  }
  RosMessage& doubles(std::initializer_list<double> values) {
    for (const double value : values) number(value);
    return *this;
  }
  RosMessage& zeros(int count) {
    for (int i = 0; i < count; ++i) number(0.0);
    return *this;
  }
  RosMessage& name(std::string_view text) {
    const bool is_cdr = kind_ != Kind::ros1;
    number(static_cast<std::uint32_t>(text.size() + (is_cdr ? 1 : 0)));
    bytes_.bytes(text);
    if (is_cdr) bytes_.bytes({"", 1});
    return *this;
  }
  RosMessage& header(std::int64_t time_ns, std::string_view frame) {
    if (kind_ == Kind::ros1) number(std::uint32_t{7});
    number(static_cast<std::uint32_t>(time_ns / 1'000'000'000));
    number(static_cast<std::uint32_t>(time_ns % 1'000'000'000));
    return name(frame);
  }
  const std::string& bytes() const { return bytes_.text; }

 private:
  Kind kind_;
  LogBytes bytes_;
};

inline std::string odometry(RosMessage::Kind kind, int i) {
  return RosMessage(kind)
      .header(log_time_ns(i), "odom")
      .name("base")
      .doubles({1.0 * i, 2.0 * i, 3.0 * i, 0.5, 0.5, 0.5, 0.5})
      .zeros(36)
      .doubles({1, 2, 3, 0, 0, 0})
      .zeros(36)
      .bytes();
}

/// `bytes` compressed as chunks of logs are.
inline std::string packed(std::string_view packing, const std::string& bytes) {
  std::string out(2 * bytes.size() + 1'000'000, '\0');  // more than any needs
  std::size_t size = bytes.size();
  if (packing == "bz2") {
    auto count = static_cast<unsigned>(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &count, const_cast<char*>(bytes.data()),
                             static_cast<unsigned>(bytes.size()), 9, 0, 0);
    size = count;
  } else if (packing == "lz4") {
    size = LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr);
  } else if (packing == "zstd") {
    size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3);
  } else {
    return bytes;
  }
  return out.substr(0, size);
}

// ROS 1 bags.

using BagFields = std::vector<std::pair<std::string_view, std::string>>;

template <class T>
std::string field_bytes(T value) {
  return LogBytes().number(value).text;
}

inline std::string bag_record(char op, const BagFields& fields, const std::string& data) {
  LogBytes header;
  header.sized(std::string("op=") + op);
  for (const auto& [name, value] : fields) header.sized(std::string(name) + "=" + value);
  return LogBytes().sized(header.text).sized(data).text;
}

inline std::string bag_connection(std::uint32_t id, const std::string& topic,
                                  const std::string& type) {
  const std::string data = LogBytes().sized("topic=" + topic).sized("type=" + type).text;
  return bag_record(7, {{"conn", field_bytes(id)}, {"topic", topic}}, data);
}

inline std::string bag_message(std::uint32_t id, std::int64_t time_ns, const std::string& data) {
  const std::string time = LogBytes()
                               .number(static_cast<std::uint32_t>(time_ns / 1'000'000'000))
                               .number(static_cast<std::uint32_t>(time_ns % 1'000'000'000))
                               .text;
  return bag_record(2, {{"conn", field_bytes(id)}, {"time", time}}, data);
}

inline std::string bag_chunk(std::string_view packing, const std::string& records,
                             std::uint32_t size) {
  return bag_record(5, {{"compression", std::string(packing)}, {"size", field_bytes(size)}},
                    packed(packing, records));
}

/// `index_position`: 0 for a bag that was never closed.
inline std::string bag_of(const std::string& records, bool is_closed = true) {
  const auto head = [](std::uint64_t index) {
    return std::string("#ROSBAG V2.0\n") +
           bag_record(3, {{"index_pos", field_bytes(index)}, {"conn_count", field_bytes(1U)}},
                      std::string(20, ' '));
  };
  const std::uint64_t index = head(0).size() + records.size();
  return head(is_closed ? index : 0) + records;
}

/// "": no chunks.
inline std::string sample_bag(std::string_view packing) {
  std::string records = bag_connection(1, "/odom", "nav_msgs/Odometry");
  for (int i = 0; i < kLogPoses; ++i) {
    records += bag_message(1, log_time_ns(i), odometry(RosMessage::Kind::ros1, i));
  }
  if (packing.empty()) return bag_of(records);
  return bag_of(bag_chunk(packing, records, static_cast<std::uint32_t>(records.size())));
}

// MCAP.

inline std::string mcap_record(unsigned char kind, const std::string& content) {
  return LogBytes().number(kind).number(std::uint64_t{content.size()}).bytes(content).text;
}

inline std::string mcap_head(const std::string& topic, const std::string& type,
                             const std::string& encoding) {
  const std::uint16_t id = 1;
  return mcap_record(3, LogBytes().number(id).sized(type).sized("ros2msg").sized("text").text) +
         mcap_record(4, LogBytes().numbers({id, id}).sized(topic).sized(encoding).sized("").text);
}

inline std::string mcap_message(std::int64_t time_ns, const std::string& data) {
  const auto time = static_cast<std::uint64_t>(time_ns);
  return mcap_record(
      5, LogBytes().number(std::uint16_t{1}).number(0U).numbers({time, time}).bytes(data).text);
}

inline std::string mcap_chunk(const std::string& packing, const std::string& records,
                              std::uint64_t size, bool has_crc = true) {
  const auto* data = reinterpret_cast<const unsigned char*>(records.data());
  const auto crc = static_cast<std::uint32_t>(has_crc ? crc32_z(0, data, records.size()) : 0);
  const std::string content = packed(packing, records);
  return mcap_record(6, LogBytes()
                            .numbers<std::uint64_t>({0, 0, size})
                            .number(crc)
                            .sized(packing)
                            .number(std::uint64_t{content.size()})
                            .bytes(content)
                            .text);
}

inline std::string mcap_of(const std::string& records) {
  return std::string("\x89MCAP0\r\n") + mcap_record(1, LogBytes().sized("ros2").sized("").text) +
         records + mcap_record(15, std::string(4, '\0')) + mcap_record(2, std::string(20, '\0')) +
         "\x89MCAP0\r\n";
}

/// "unchunked": no chunks.
inline std::string sample_mcap(const std::string& packing,
                               RosMessage::Kind kind = RosMessage::Kind::cdr) {
  const bool is_ros1 = kind == RosMessage::Kind::ros1;
  std::string records = mcap_head("/odom", "nav_msgs/msg/Odometry", is_ros1 ? "ros1" : "cdr");
  for (int i = 0; i < kLogPoses; ++i) records += mcap_message(log_time_ns(i), odometry(kind, i));
  return mcap_of(packing == "unchunked" ? records : mcap_chunk(packing, records, records.size()));
}

// ULog.

inline std::string ulog_record(char kind, const std::string& data) {
  return LogBytes().number(static_cast<std::uint16_t>(data.size())).number(kind).bytes(data).text;
}

inline std::string ulog_head() {
  return LogBytes().bytes("ULog\x01\x12\x35\x01").number(std::uint64_t{5}).text;
}

inline std::string ulog_flags(std::uint64_t appended_position) {
  LogBytes flags;
  flags.numbers<std::uint64_t>({0, appended_position == 0 ? 0U : 1U, appended_position, 0, 0});
  return ulog_record('B', flags.text);
}

inline std::string ulog_definitions() {
  return ulog_record('F', "pad:bool b;uint8_t[2] c;") +
         ulog_record('F',
                     "vehicle_local_position:uint64_t timestamp;pad[2] p;float x;float y;float z;"
                     "float vx;float vy;float vz;bool xy_valid;bool z_valid;") +
         ulog_record('F', "vehicle_attitude:uint64_t timestamp;float[4] q;") +
         ulog_record('A', LogBytes().bytes({"\0", 1}).number(std::uint16_t{1}).text +
                              "vehicle_local_position") +
         ulog_record(
             'A', LogBytes().bytes({"\0", 1}).number(std::uint16_t{2}).text + "vehicle_attitude");
}

inline std::string ulog_position(std::int64_t time_ns, float x, float y, float z) {
  return ulog_record('D', LogBytes()
                              .number(std::uint16_t{1})
                              .number(time_ns / 1000)
                              .bytes(std::string(6, 'p'))
                              .numbers({x, y, z, 1.0F, 2.0F, 3.0F})
                              .bytes("\1\1")
                              .text);
}

inline std::string ulog_attitude(std::int64_t time_ns, float w, float x, float y, float z) {
  return ulog_record(
      'D', LogBytes().number(std::uint16_t{2}).number(time_ns / 1000).numbers({w, x, y, z}).text);
}

/// In North-East-Down, so that the path read is (2i, i, -3i) and the velocity (2, 1, -3).
inline std::string sample_ulog() {
  std::string log = ulog_head() + ulog_flags(0) + ulog_definitions();
  for (int i = 0; i < kLogPoses; ++i) {
    const auto at = static_cast<float>(i);
    log += ulog_attitude(log_time_ns(i), 0.5F, 0.5F, 0.5F, 0.5F);
    log += ulog_position(log_time_ns(i), at, 2 * at, 3 * at);
  }
  return log;
}

// Text.

inline std::string sample_tum() {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < kLogPoses; ++i) {
    const std::string n = std::to_string(i);
    text += "1700000000." + std::to_string(100 + 2 * i).substr(1) + " " + n + " " +
            std::to_string(2 * i) + " " + std::to_string(3 * i) + " 0.5 0.5 0.5 0.5\n";
  }
  return text;
}

inline std::string sample_euroc() {
  std::string text = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  for (int i = 0; i < kLogPoses; ++i) {
    text += std::to_string(log_time_ns(i)) + "," + std::to_string(i) + "," + std::to_string(2 * i) +
            "," + std::to_string(3 * i) + ",0.5,0.5,0.5,0.5,3,1,2,0,0,0\n";
  }
  return text;
}

/// Those of which any prefix can be read without a file, by name.
inline std::vector<std::pair<std::string, std::string>> all_logs() {
  return {{"unchunked.bag", sample_bag("")},
          {"none.bag", sample_bag("none")},
          {"bz2.bag", sample_bag("bz2")},
          {"lz4.bag", sample_bag("lz4")},
          {"unchunked.mcap", sample_mcap("unchunked")},
          {"none.mcap", sample_mcap("")},
          {"lz4.mcap", sample_mcap("lz4")},
          {"zstd.mcap", sample_mcap("zstd")},
          {"big.mcap", sample_mcap("zstd", RosMessage::Kind::cdr_big)},
          {"ros1.mcap", sample_mcap("zstd", RosMessage::Kind::ros1)},
          {"log.ulg", sample_ulog()},
          {"tum.txt", sample_tum()},
          {"data.csv", sample_euroc()}};
}

/// A recording of rosbag2's SQLite. The file must not be there yet.
inline void write_sample_db3(const std::filesystem::path& file) {
  sqlite3* handle = nullptr;
  if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) std::abort();
  std::string sql =
      "CREATE TABLE topics (id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format "
      "TEXT, offered_qos_profiles TEXT);"
      "CREATE TABLE messages (id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data "
      "BLOB);"
      "INSERT INTO topics VALUES (1, '/odom', 'nav_msgs/msg/Odometry', 'cdr', '');";
  for (int i = 0; i < kLogPoses; ++i) {
    sql += "INSERT INTO messages VALUES (" + std::to_string(i + 1) + ", 1, " +
           std::to_string(log_time_ns(i)) + ", x'";
    for (const char c : odometry(RosMessage::Kind::cdr, i)) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      sql += kDigits[byte >> 4U];
      sql += kDigits[byte & 15U];
    }
    sql += "');";
  }
  if (sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) std::abort();
  sqlite3_close(handle);
}

}  // namespace avoidbench::test
