#include "logs/recorded_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/input_error_message.hpp"
#include "support/log_bytes.hpp"
#include "support/log_files.hpp"
#include "support/temporary_folder.hpp"

namespace avoidbench {
namespace {

using test::flight_of_bytes;
using test::has;
using test::message_of;
using Kind = test::RosMessage::Kind;

std::string refusal(std::string_view bytes, const RecordedFlightChoice& choice = {}) {
  return message_of([&] { flight_of_bytes(bytes, choice); });
}

/// What the sample logs say, up to pose `count`.
void expect_sample(const RecordedFlight& flight, const std::string& name, int count) {
  const bool is_ned = flight.format == "ULog";
  ASSERT_EQ(flight.poses.size(), static_cast<std::size_t>(count)) << name;
  EXPECT_TRUE(flight.has_attitude) << name;
  for (int i = 0; i < count; ++i) {
    const RecordedPose& pose = flight.poses[static_cast<std::size_t>(i)];
    EXPECT_EQ(pose.time_ns, test::log_time_ns(i)) << name;
    const Eigen::Vector3d position(1.0 * i, 2.0 * i, 3.0 * i);
    EXPECT_EQ(pose.position, is_ned ? enu_from_ned(position) : position) << name;
    // The turn that takes x to y, y to z and z to x; for a ULog of the body's axes in NED.
    const Eigen::Quaterniond turn(0.5, 0.5, 0.5, 0.5);
    const Eigen::Vector3d forward = pose.q * Eigen::Vector3d::UnitX();
    EXPECT_LT((forward - (is_ned ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, 1, 0))).norm(),
              1e-15)
        << name;
    if (!is_ned) {
      EXPECT_LT(pose.q.angularDistance(turn), 1e-7) << name;
    }
    if (flight.velocities.empty()) continue;
    const Eigen::Vector3d velocity = is_ned ? Eigen::Vector3d(2, 1, -3) : Eigen::Vector3d(3, 1, 2);
    EXPECT_LT((flight.velocities[static_cast<std::size_t>(i)] - velocity).norm(), 1e-14) << name;
  }
}

TEST(RecordedFlight, EveryFormatIsReadAsItIsWritten) {
  const test::TemporaryFolder folder;
  for (const auto& [name, bytes] : test::all_logs()) {
    const RecordedFlight flight = read_recorded_flight({.file = folder.write(name, bytes)});
    expect_sample(flight, name, test::kLogPoses);
    EXPECT_TRUE(flight.warnings.empty()) << name << ": " << flight.warnings[0];
    const bool is_text = flight.format == "TUM" || flight.format == "EuRoC CSV";
    EXPECT_EQ(flight.topic.empty(), is_text) << name;
    EXPECT_EQ(flight.velocities.empty(), flight.format == "TUM") << name;
  }
  test::write_sample_db3(folder / "a ?#%.db3");
  const RecordedFlight flight = read_recorded_flight({.file = (folder / "a ?#%.db3").string()});
  expect_sample(flight, "db3", test::kLogPoses);
  EXPECT_EQ(flight.format, "rosbag2 (SQLite)");
  EXPECT_EQ(flight.type, "nav_msgs/msg/Odometry");
}

TEST(RecordedFlight, ALogCutAtAnyByteIsReadAsFarAsItGoesAndSaysSo) {
  for (const auto& [name, bytes] : test::all_logs()) {
    std::size_t most = 0;
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
      RecordedFlight flight;
      const std::string_view begun = std::string_view(bytes).substr(0, size);
      const std::string message = message_of([&] { flight = flight_of_bytes(begun); });
      if (!message.empty()) {
        EXPECT_EQ(most, 0U) << name << " at " << size << ": " << message;
        continue;
      }
      EXPECT_GE(flight.poses.size(), most) << name << " at " << size;
      most = flight.poses.size();
      // At the end of a record of a ULog or a line, nothing shows that more was to come; and of a
      // text's last number digits may be missing.
      const bool may_end = flight.format == "ULog" || flight.topic.empty();
      if (!may_end)
        expect_sample(flight, name + " at " + std::to_string(size), static_cast<int>(most));
      if (most < test::kLogPoses && !may_end) {
        ASSERT_EQ(flight.warnings.size(), 1U) << name << " at " << size;
        EXPECT_TRUE(has(flight.warnings[0], "is cut off at byte " + std::to_string(size)))
            << flight.warnings[0];
      }
    }
    EXPECT_EQ(most, static_cast<std::size_t>(test::kLogPoses)) << name;
  }
}

TEST(RecordedFlight, AnyByteMayBeWrong) {
  int refused = 0;
  for (const auto& [name, bytes] : test::all_logs()) {
    for (std::size_t place = 0; place < bytes.size(); ++place) {
      for (const char wrong : {'\xff', '\0', '\x7f', '\x01'}) {
        std::string damaged = bytes;
        damaged[place] = wrong;
        refused += refusal(damaged).empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(RecordedFlight, LengthsThatLieAreFoundBeforeTheyAreUsed) {
  const std::string connection = test::bag_connection(1, "/odom", "nav_msgs/Odometry");
  const std::string good = test::bag_message(1, 5, test::odometry(Kind::ros1, 0));
  // A header, and a field in it, longer than anything.
  const std::size_t start = test::bag_of("").size();
  EXPECT_TRUE(has(
      refusal(test::bag_of(std::string("\xff\xff\xff\xff", 4) + connection)),
      "log: damaged at byte " + std::to_string(start) + ": a record's header of 4294967295 bytes"));
  std::string field = connection;
  field[7] = '\x40';
  EXPECT_TRUE(has(refusal(test::bag_of(field)), "a field that is longer than its record's header"));
  // Data that reach beyond where the index begins.
  std::string data = good;
  data[data.size() - test::odometry(Kind::ros1, 0).size() - 1] = '\x10';
  EXPECT_TRUE(has(refusal(test::bag_of(connection + data)), "reaches into the bag's index"));
  const std::string head = test::mcap_head("/odom", "nav_msgs/msg/Odometry", "cdr");
  std::string schema = head;
  schema[8] = '\x7f';
  EXPECT_TRUE(has(refusal(test::mcap_of(schema)), "a record that is too large"));
  std::string name = head;
  name[14] = '\x7f';
  EXPECT_TRUE(has(refusal(test::mcap_of(name)), "a record that is too short for its fields"));
  std::string message = test::mcap_message(5, std::string(3'000'000, 'x'));
  EXPECT_TRUE(has(refusal(test::mcap_of(head + message)), "it is longer than its type"));
  std::string chunk = test::mcap_chunk("", head, head.size());
  chunk[9 + 8 + 8 + 8 + 4 + 4] = '\x01';
  EXPECT_TRUE(has(refusal(test::mcap_of(chunk)), "a chunk whose sizes contradict each other"));
  EXPECT_TRUE(has(refusal(test::ulog_head() + test::ulog_record('B', "x")), "flags are too short"));
}

TEST(RecordedFlight, ChunksThatUnpackToAnythingElseAreRefused) {
  const std::string records = test::mcap_head("/odom", "nav_msgs/msg/Odometry", "cdr") +
                              test::mcap_message(5, test::odometry(Kind::cdr, 0));
  const std::string zeros(5'000'000, '\0');
  for (const std::string packing : {"", "lz4", "zstd", "bz2"}) {
    const std::string more =
        test::mcap_of(test::mcap_chunk(packing, records, records.size() - 1, false));
    EXPECT_TRUE(has(refusal(more), "unpacks to more bytes than it says")) << refusal(more);
    const std::string fewer =
        test::mcap_of(test::mcap_chunk(packing, records, records.size() + 1, false));
    EXPECT_TRUE(has(refusal(fewer), "unpacks to fewer bytes than it says")) << refusal(fewer);
    const std::string huge = test::mcap_of(test::mcap_chunk(packing, records, ~std::uint64_t{0}));
    EXPECT_TRUE(has(refusal(huge), "at most 268435456 are read")) << refusal(huge);
    const std::string bomb =
        test::mcap_of(test::mcap_chunk(packing, records + zeros, records.size(), false));
    EXPECT_TRUE(has(refusal(bomb), "unpacks to more bytes than it says")) << refusal(bomb);
  }
  const std::string unknown = test::mcap_of(test::mcap_chunk("zip", records, records.size()));
  EXPECT_TRUE(has(refusal(unknown), "a chunk with the unknown compression zip"));
  std::string flipped = test::mcap_chunk("", records, records.size());
  flipped[flipped.size() - 1] ^= 1;
  EXPECT_TRUE(has(refusal(test::mcap_of(flipped)),
                  "a chunk that has another checksum (CRC-32) than it says"));
  const std::string nested = test::mcap_chunk("", records, records.size());
  EXPECT_TRUE(has(refusal(test::mcap_of(test::mcap_chunk("", nested, nested.size()))),
                  "log: damaged at byte 29, in the chunk there, at byte 0 of what it unpacks to: a "
                  "chunk in a chunk"));
  const std::string bag_chunk = test::bag_chunk("bz2", zeros, 0xffffffffU);
  EXPECT_TRUE(has(refusal(test::bag_of(bag_chunk)), "at most 268435456 are read"));
}

/// A bag with one PoseStamped for each row: time, position, attitude x, y, z, w.
struct PoseRow {
  std::int64_t time_ns = 0;
  Eigen::Vector3d position = {0, 0, 0};
  Eigen::Vector4d q = {0, 0, 0, 1};
  std::string frame = "map";
};

std::string bag_of_poses(const std::vector<PoseRow>& rows) {
  std::string records = test::bag_connection(1, "/pose", "geometry_msgs/PoseStamped");
  std::int64_t logged_ns = 70;
  for (const PoseRow& row : rows) {
    const auto& [time_ns, p, q, frame] = row;
    const std::string message = test::RosMessage(Kind::ros1)
                                    .header(time_ns, frame)
                                    .doubles({p[0], p[1], p[2], q[0], q[1], q[2], q[3]})
                                    .bytes();
    records += test::bag_message(1, logged_ns++, message);
  }
  return test::bag_of(records);
}

TEST(RecordedFlight, PosesThatCantBeUsedAreLeftOutAndCounted) {
  const double nan = std::nan("");
  const RecordedFlight flight =
      flight_of_bytes(bag_of_poses({{.time_ns = 10},
                                    {.time_ns = 20, .position = {1, nan, 0}},
                                    {.time_ns = 15},
                                    {.time_ns = 15},
                                    {.time_ns = 5},
                                    {.time_ns = 30, .q = {0, 0, 0, 0}},
                                    {.time_ns = 40, .q = {0, 0, 0, nan}},
                                    {.time_ns = 50, .q = {0, 0, 1.02, 0}}}));
  ASSERT_EQ(flight.poses.size(), 3U);
  EXPECT_EQ(flight.poses[1].time_ns, 15);
  EXPECT_EQ(flight.poses[2].time_ns, 50);
  EXPECT_EQ(flight.poses[2].q.coeffs(), Eigen::Vector4d(0, 0, 1, 0));
  const std::vector<std::string> wanted{
      "1 pose is not finite or not valid and is left out",
      "2 poses are not later than the one before and are left out",
      "2 poses have no attitude and are left out"};
  EXPECT_EQ(flight.warnings, wanted);
}

TEST(RecordedFlight, WithoutAnyAttitudeAllPosesStay) {
  const RecordedFlight flight = flight_of_bytes(
      bag_of_poses({{.time_ns = 10, .q = {0, 0, 0, 0}}, {.time_ns = 20, .q = {0, 0, 0, 0}}}));
  EXPECT_EQ(flight.poses.size(), 2U);
  EXPECT_FALSE(flight.has_attitude);
  EXPECT_EQ(flight.poses[0].q.coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(RecordedFlight, VelocitiesOfTheBodyAreNoneWithoutAnAttitude) {
  const auto message = [](double w) {
    return test::RosMessage(Kind::ros1)
        .header(5, "odom")
        .name("base")
        .doubles({0, 0, 0, 0, 0, 0, w})
        .zeros(36)
        .doubles({1, 2, 3, 0, 0, 0})
        .zeros(36)
        .bytes();
  };
  for (const double w : {1.0, 0.0}) {
    const RecordedFlight flight =
        flight_of_bytes(test::bag_of(test::bag_connection(1, "/odom", "nav_msgs/Odometry") +
                                     test::bag_message(1, 5, message(w))));
    EXPECT_EQ(flight.has_attitude, w == 1.0);
    EXPECT_EQ(flight.velocities.empty(), w == 0.0);
    EXPECT_EQ(flight.poses.size(), 1U);
  }
}

TEST(RecordedFlight, WithoutAStampTheTimeOfRecordingIsTaken) {
  const RecordedFlight flight = flight_of_bytes(bag_of_poses({{.time_ns = 0}, {.time_ns = 0}}));
  ASSERT_EQ(flight.poses.size(), 2U);
  EXPECT_EQ(flight.poses[0].time_ns, 70);
  EXPECT_EQ(flight.poses[1].time_ns, 71);
  EXPECT_EQ(flight.warnings,
            std::vector<std::string>{"2 poses have no time stamp; the time of recording is used"});
}

TEST(RecordedFlight, PosesInTwoFramesAreNoFlight) {
  const std::string message =
      refusal(bag_of_poses({{.time_ns = 1}, {.time_ns = 2, .frame = "odom"}}));
  EXPECT_TRUE(has(message, "in the frame 'odom', those before are in 'map'")) << message;
  EXPECT_TRUE(has(message, "log: damaged at byte ")) << message;
}

TEST(RecordedFlight, NothingThatCanBeUsedIsAnError) {
  EXPECT_EQ(refusal(""), "log: an empty file");
  EXPECT_TRUE(has(refusal({"\0\1\2", 3}), "no recorded flight: recorded flights are ROS 1 bags"));
  EXPECT_TRUE(has(refusal("\x28\xb5\x2f\xfd"), "zstd -d FILE"));
  EXPECT_TRUE(has(refusal("#ROSBAG V1.2\n"), "`rosbag fix`"));
  EXPECT_EQ(refusal(bag_of_poses({})),
            "log: no topic has poses of a supported type (poses of " +
                std::string(kPoseMessageNames) +
                "); it has /pose (geometry_msgs/PoseStamped, 0 messages)");
  const std::string message = refusal(bag_of_poses({{.position = {1, HUGE_VAL, 0}}}));
  EXPECT_EQ(message,
            "log: no usable pose; 1 pose is not finite or not valid and is left out; 1 pose has no "
            "time stamp; the time of recording is used");
  EXPECT_TRUE(has(refusal(test::sample_tum(), {.topic = "/a"}), "no topic /a; it has no topics"));
  const test::TemporaryFolder folder;
  EXPECT_TRUE(has(message_of([&] { read_recorded_flight({.file = folder.path().string()}); }),
                  "a folder without metadata.yaml"));
  folder.write("metadata.yaml",
               "rosbag2_bagfile_information: {relative_file_paths: [/etc/passwd, ..]}");
  EXPECT_TRUE(has(message_of([&] { read_recorded_flight({.file = folder.path().string()}); }),
                  "expected a file, got \"..\""));
}

TEST(RecordedFlight, MessagesThatAreNotTheirTypeAreRefusedWithTheirPlace) {
  const std::string odometry = test::odometry(Kind::ros1, 0);
  const auto bag_with = [](const std::string& message) {
    return test::bag_of(test::bag_connection(1, "/odom", "nav_msgs/Odometry") +
                        test::bag_message(1, 5, message));
  };
  for (std::size_t size = 0; size < odometry.size(); ++size) {
    const std::string message = refusal(bag_with(odometry.substr(0, size)));
    ASSERT_TRUE(has(message, ": it is too short for its type")) << size << message;
  }
  EXPECT_TRUE(has(refusal(bag_with(odometry + "x")), "it is longer than its type"));
  const std::string cdr = test::odometry(Kind::cdr, 0);
  const auto mcap_with = [](const std::string& message) {
    return test::mcap_of(test::mcap_head("/odom", "nav_msgs/msg/Odometry", "cdr") +
                         test::mcap_message(5, message));
  };
  EXPECT_TRUE(has(refusal(mcap_with("\2" + cdr.substr(1))), "not those of CDR"));
  EXPECT_TRUE(has(refusal(mcap_with("\x28\xb5\x2f\xfdxx")), "compressed one by one"));
  EXPECT_TRUE(has(refusal(test::mcap_of(test::mcap_head("/odom", "nav_msgs/msg/Odometry", "json") +
                                        test::mcap_message(5, "{}"))),
                  "messages of the encoding 'json'; only cdr and ros1 are supported"));
}

TEST(RecordedFlight, BagsWithoutAnIndexAreReadAndSaySo) {
  std::string records = test::bag_connection(1, "/odom", "nav_msgs/Odometry");
  records += test::bag_message(1, 5, test::odometry(Kind::ros1, 0));
  const RecordedFlight flight = flight_of_bytes(test::bag_of(records, false));
  EXPECT_EQ(flight.poses.size(), 1U);
  ASSERT_EQ(flight.warnings.size(), 1U);
  EXPECT_TRUE(has(flight.warnings[0], "was never closed"));
}

TEST(RecordedFlight, MoreThanTwoMillionPosesAreRefused) {
  class Lines : public ByteSource {
   public:
    std::size_t read(std::span<char> bytes) override {
      const std::string line = std::to_string(++count_) + " 0 0 0 0 0 0 1\n";
      std::copy(line.begin(), line.end(), bytes.data());
      return line.size();
    }

   private:
    int count_ = 0;
  };
  Lines lines;
  ByteReader in(lines, "log");
  FlightBuilder flight({});
  EXPECT_EQ(message_of([&] { read_log(in, flight); }), "log:2000001: more than 2000000 poses");
}

}  // namespace
}  // namespace avoidbench
