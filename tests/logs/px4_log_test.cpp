#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "logs/ulog_format.hpp"
#include "support/input_error_message.hpp"
#include "support/log_bytes.hpp"
#include "support/log_files.hpp"

namespace avoidbench {
namespace {

using test::flight_of_bytes;
using test::has;
using test::message_of;

std::string ulog_refusal(std::string_view bytes) {
  return message_of([&] { flight_of_bytes(bytes); });
}

std::string ulog_start() {
  return test::ulog_head() + test::ulog_flags(0) + test::ulog_definitions();
}

/// Forward, left and up in East-North-Up, of an attitude Forward-Right-Down in North-East-Down.
void expect_axes(const Eigen::Quaterniond& ned_from_frd, const Eigen::Vector3d& forward,
                 const Eigen::Vector3d& left, const Eigen::Vector3d& up) {
  const Eigen::Quaterniond q = enu_from_flu(ned_from_frd);
  EXPECT_LT((q * Eigen::Vector3d::UnitX() - forward).norm(), 1e-15);
  EXPECT_LT((q * Eigen::Vector3d::UnitY() - left).norm(), 1e-15);
  EXPECT_LT((q * Eigen::Vector3d::UnitZ() - up).norm(), 1e-15);
}

TEST(Px4Frames, AttitudesPointWhereTheyDid) {
  const double s = std::numbers::sqrt2 / 2.0;
  // Level, nose to the north: forward is north, left is west.
  expect_axes({1, 0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  // Turned by 90° about down: nose to the east.
  expect_axes({s, 0, 0, s}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  // Pitched up by 90°, from the north: forward is up, up is south.
  expect_axes({s, 0, s, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0});
  // Rolled to the right by 90°, nose to the north: left is up, up is east.
  expect_axes({s, s, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
}

TEST(Px4Frames, AWorldWithoutNorthKeepsItsForward) {
  const double s = std::numbers::sqrt2 / 2.0;
  LoggedPose pose;
  pose.position = {1, 2, 3};
  pose.q = {s, 0, 0, s};  // nose to the right
  pose.velocity = {4, 5, 6};
  const LoggedPose turned = with_z_up(pose, true, true);
  EXPECT_EQ(turned.position, Eigen::Vector3d(1, -2, -3));
  EXPECT_LT((turned.q * Eigen::Vector3d::UnitX() - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
  // In FRD of the world: forward (0, 1, 0), right (-1, 0, 0): (-5, 4, 6).
  EXPECT_LT((*turned.velocity - Eigen::Vector3d(-5, -4, -6)).norm(), 1e-14);
}

TEST(Ulog, AttitudesAreThoseOfThePosesTimes) {
  const double half_rad = std::numbers::pi / 8.0;  // half of 45°
  const auto cosine = static_cast<float>(std::cos(half_rad));
  const auto sine = static_cast<float>(std::sin(half_rad));
  std::string log = ulog_start();
  log += test::ulog_position(500'000, 0, 0, 0);  // before the first attitude
  log += test::ulog_attitude(1'000'000, 1, 0, 0, 0);
  log += test::ulog_position(25'000'000, 1, 0, 0);
  log += test::ulog_position(101'000'000, 2, 0, 0);
  log += test::ulog_attitude(101'000'000, cosine, 0, 0, sine);
  log += test::ulog_position(300'000'000, 3, 0, 0);  // where attitudes are missing
  log += test::ulog_attitude(700'000'000, 1, 0, 0, 0);
  log += test::ulog_position(800'000'000, 4, 0, 0);  // after the last
  const RecordedFlight flight = flight_of_bytes(log);
  ASSERT_EQ(flight.poses.size(), 2U);
  EXPECT_EQ(flight.warnings, std::vector<std::string>{"3 poses have no attitude and are left out"});
  // 24 % of 45° from north to east.
  const double heading = 0.24 * std::numbers::pi / 4.0;
  const Eigen::Vector3d forward = flight.poses[0].q * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(forward.x(), std::sin(heading), 1e-7);
  EXPECT_NEAR(forward.y(), std::cos(heading), 1e-7);
}

TEST(Ulog, WithoutAttitudesThePathIsStillRead) {
  std::string log = ulog_start();
  for (int i = 0; i < 3; ++i) log += test::ulog_position(1000 * (i + 1), 1, 2, 3);
  const RecordedFlight flight = flight_of_bytes(log);
  EXPECT_EQ(flight.poses.size(), 3U);
  EXPECT_FALSE(flight.has_attitude);
  ASSERT_EQ(flight.warnings.size(), 1U);
  EXPECT_TRUE(has(flight.warnings[0], "the log has no vehicle_attitude"));
}

TEST(Ulog, PositionsThatPx4CallsInvalidAreLeftOut) {
  std::string log = test::sample_ulog();
  log[log.size() - 2] = '\0';  // xy_valid of the last
  const RecordedFlight flight = flight_of_bytes(log);
  EXPECT_EQ(flight.poses.size(), static_cast<std::size_t>(test::kLogPoses - 1));
  EXPECT_EQ(flight.warnings,
            std::vector<std::string>{"1 pose is not finite or not valid and is left out"});
}

TEST(Ulog, OdometryWithoutPositionsOfTheControllerIsRead) {
  std::string log = test::ulog_head() + test::ulog_flags(0);
  // Before PX4 1.14.
  log +=
      test::ulog_record('F',
                        "vehicle_odometry:uint64_t timestamp;float x;float y;float z;float[4] "
                        "q;float vx;float vy;float vz;uint8_t local_frame;uint8_t[7] _padding0;");
  log += test::ulog_record('A', std::string("\0\7\0vehicle_odometry", 19));
  // Its padding at the end is not written.
  log += test::ulog_record('D', test::LogBytes()
                                    .number(std::uint16_t{7})
                                    .number(std::uint64_t{9})
                                    .numbers({1.F, 2.F, 3.F, 1.F, 0.F, 0.F, 0.F, 4.F, 5.F, 6.F})
                                    .bytes({"\1", 1})
                                    .text);
  const RecordedFlight flight = flight_of_bytes(log);
  ASSERT_EQ(flight.poses.size(), 1U);
  EXPECT_EQ(flight.topic, "vehicle_odometry");
  EXPECT_EQ(flight.poses[0].time_ns, 9000);
  EXPECT_EQ(flight.poses[0].position, Eigen::Vector3d(1, -2, -3));
  EXPECT_EQ(flight.velocities[0], Eigen::Vector3d(4, -5, -6));
}

TEST(Ulog, TheControllersPositionsGoBeforeOdometry) {
  const std::string type =
      "vehicle_odometry:uint64_t timestamp;float[3] position;float[4] q;uint8_t reset_counter;";
  const std::string id = test::LogBytes().bytes({"\0", 1}).number(std::uint16_t{7}).text;
  const std::string head = test::ulog_head() + test::ulog_flags(0) + test::ulog_record('F', type) +
                           test::ulog_record('A', id + "vehicle_odometry");
  std::string odometry;
  for (const char resets : {'\1', '\1', '\2'}) {
    odometry +=
        test::ulog_record('D', test::LogBytes()
                                   .number(std::uint16_t{7})
                                   .number(std::uint64_t{9} + static_cast<std::uint64_t>(resets))
                                   .numbers({1.F, 2.F, 3.F, 1.F, 0.F, 0.F, 0.F})
                                   .number(resets)
                                   .text);
  }
  const std::string start = test::ulog_head() + test::ulog_flags(0);
  const std::string positions = test::sample_ulog().substr(start.size());
  const RecordedFlight alone = flight_of_bytes(head + odometry);
  EXPECT_EQ(alone.topic, "vehicle_odometry");
  EXPECT_EQ(alone.poses.size(), 2U);
  ASSERT_EQ(alone.warnings.size(), 2U);
  EXPECT_TRUE(has(alone.warnings[0], "the estimate jumped 1 time (vehicle_odometry"));
  for (const std::string& log : {head + odometry + positions, head + positions + odometry}) {
    const RecordedFlight flight = flight_of_bytes(log);
    EXPECT_EQ(flight.topic, "vehicle_local_position");
    EXPECT_EQ(flight.poses.size(), static_cast<std::size_t>(test::kLogPoses));
    EXPECT_TRUE(flight.warnings.empty());
    const RecordedFlight named = flight_of_bytes(log, {.topic = "vehicle_odometry"});
    EXPECT_EQ(named.poses.size(), 2U);
  }
  // Formats that change on the way.
  const std::string again = test::ulog_record('F',
                                              "vehicle_odometry:uint64_t timestamp;float[3] "
                                              "position;float[4] q;float[3] velocity;");
  const std::string with_velocity =
      test::ulog_record('D', test::LogBytes()
                                 .number(std::uint16_t{7})
                                 .number(std::uint64_t{99})
                                 .numbers({1.F, 2.F, 3.F, 1.F, 0.F, 0.F, 0.F, 4.F, 5.F, 6.F})
                                 .text);
  EXPECT_TRUE(has(ulog_refusal(head + odometry + again +
                               test::ulog_record('A', id + "vehicle_odometry") + with_velocity),
                  "some messages have a velocity, others don't"));
}

TEST(Ulog, ReadsOnWhereDataWereAppended) {
  std::string log = test::sample_ulog();
  // The last message lost its end when the log was closed; then comes what was appended.
  log.resize(log.size() - 10);
  const std::string later = test::ulog_position(test::log_time_ns(9), 9, 18, 27) +
                            test::ulog_attitude(test::log_time_ns(9), 0.5F, 0.5F, 0.5F, 0.5F);
  const std::string flags = test::ulog_flags(log.size());
  log.replace(test::ulog_head().size(), flags.size(), flags);
  const RecordedFlight flight = flight_of_bytes(log + later);
  ASSERT_EQ(flight.poses.size(), static_cast<std::size_t>(test::kLogPoses));
  EXPECT_EQ(flight.poses.back().position, Eigen::Vector3d(18, 9, -27));
}

TEST(Ulog, FormatsThatCantBeAreRefused) {
  const auto with = [](const std::string& definition) {
    const std::string id = test::LogBytes().bytes({"\0", 1}).number(std::uint16_t{1}).text;
    return test::ulog_head() + test::ulog_record('F', definition) +
           test::ulog_record('A', id + "vehicle_odometry");
  };
  const std::string start = "vehicle_odometry:";
  EXPECT_TRUE(has(ulog_refusal(with("x")), "log: damaged at byte 16: a format without a name"));
  EXPECT_TRUE(has(ulog_refusal(with("a:bool b;")), "vehicle_odometry, which is not defined"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "other o;")), "the type other is not defined"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "vehicle_odometry[2] o;")), "contains itself"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "double[65535] o;")), "larger than any message"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "bool[-1] o;")), "a format's field of no size"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "bool[9 o;")), "a format's field of no size"));
  EXPECT_TRUE(has(ulog_refusal(with(start + "bool;")), "a format's field without a name"));
  // Types of types, each twice as large: their sizes are found once each.
  std::string deep = test::ulog_head();
  for (int i = 0; i < 14; ++i) {
    const std::string next = i == 13 ? "bool" : "t" + std::to_string(i + 1);
    deep += test::ulog_record('F', "t" + std::to_string(i) + ":" + next + " a;" + next + " b;");
  }
  deep += with(start + "t0 t;").substr(test::ulog_head().size());
  EXPECT_TRUE(has(ulog_refusal(deep), "no topic has poses of a supported type"))
      << ulog_refusal(deep);
}

TEST(Ulog, MessagesOfUnknownKindsAndTopicsAreDamage) {
  const std::string start = ulog_start();
  const std::string place = "log: damaged at byte " + std::to_string(start.size());
  EXPECT_EQ(ulog_refusal(start + test::ulog_record('z', "abc")),
            place + ": a message of an unknown kind");
  EXPECT_EQ(ulog_refusal(start + test::ulog_record('D', std::string(2, '\x63'))),
            place + ": a message of a topic that is not known");
  std::string flags = test::ulog_flags(0);
  flags[3 + 8] = 2;
  EXPECT_TRUE(has(ulog_refusal(test::ulog_head() + flags),
                  "uses features that this program does not know"));
}

}  // namespace
}  // namespace avoidbench
