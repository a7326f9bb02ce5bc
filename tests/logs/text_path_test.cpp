#include <gtest/gtest.h>

#include "support/input_error_message.hpp"
#include "support/log_bytes.hpp"

namespace avoidbench {
namespace {

using test::flight_of_bytes;
using test::has;
using test::message_of;

std::string text_refusal(const std::string& text) {
  return message_of([&] { flight_of_bytes(text); });
}

std::int64_t time_of_line(const std::string& seconds) {
  return flight_of_bytes(seconds + " 1 2 3 0 0 0 1\n").poses.at(0).time_ns;
}

TEST(TextPath, SecondsAreNanosecondsExactly) {
  EXPECT_EQ(time_of_line("1403636579.758555392"), 1403636579758555392);
  EXPECT_EQ(time_of_line("1403636579.7585553927"), 1403636579758555392);
  EXPECT_EQ(time_of_line("1403636579"), 1403636579000000000);
  EXPECT_EQ(time_of_line("0.5"), 500000000);
  EXPECT_EQ(time_of_line("-0.25"), -250000000);
  EXPECT_EQ(time_of_line("-1.25"), -1250000000);
  EXPECT_EQ(time_of_line("7."), 7000000000);
  EXPECT_EQ(time_of_line("1.403636579758555412e+09"), 1403636579758555412);
  EXPECT_EQ(flight_of_bytes("1403636579758555392,1,2,3,1,0,0,0\n").poses.at(0).time_ns,
            1403636579758555392);
  for (const std::string bad : {"1e300", "nan", "10000000000000000000", "1.2.3", "1.-2", "x"}) {
    EXPECT_TRUE(has(text_refusal(bad + " 1 2 3 0 0 0 1\n"), "log:1: expected a time, got '" + bad))
        << bad;
  }
}

TEST(TextPath, ColumnsAreInTheOrderOfTheirFormats) {
  const RecordedFlight tum = flight_of_bytes("1 1 2 3 0.6 0 0 0.8\n");
  EXPECT_EQ(tum.poses.at(0).q.coeffs(), Eigen::Vector4d(0.6, 0, 0, 0.8));
  const RecordedFlight euroc =
      flight_of_bytes("1, 1, 2, 3, 0.8, 0.6, 0, 0\r\n\r\n2,1,2,3,0,1,0,0\n");
  EXPECT_EQ(euroc.poses.at(0).q.coeffs(), Eigen::Vector4d(0.6, 0, 0, 0.8));
  EXPECT_EQ(euroc.poses.size(), 2U);
  EXPECT_TRUE(euroc.velocities.empty());
  const std::string names = "timestamp,px,py,pz,qx,qy,qz,qw\n";
  EXPECT_TRUE(has(text_refusal(names), "log:1: expected the attitude's w in column 5, got qx"));
  EXPECT_TRUE(has(text_refusal("#" + names), "log:1: expected the attitude's w in column 5"));
  EXPECT_EQ(flight_of_bytes("t,px,py,pz,qw,qx,qy,qz\n1,1,2,3,1,0,0,0\n").poses.size(), 1U);
}

TEST(TextPath, BadLinesAreNamed) {
  EXPECT_EQ(text_refusal("# a\n\n1 2 3\n"),
            "log:3: expected 8 columns (time in s, x, y, z, qx, qy, qz, qw), got 3");
  EXPECT_EQ(text_refusal("1,2,3\n"),
            "log:1: expected at least 8 columns (time in ns, x, y, z, qw, qx, qy, qz), got 3");
  EXPECT_EQ(text_refusal("1 2 3 4 0 0 0 1\n2 2 3 4 0 y 0 1\n"),
            "log:2: expected a number, got 'y'");
  EXPECT_EQ(text_refusal("1,2,3,4,1,0,0,0,1,2,3\n2,2,3,4,1,0,0,0\n"),
            "log:2: has no velocity in columns 9 to 11, as the lines before have");
  EXPECT_TRUE(
      has(text_refusal("1 " + std::string(5000, 'x')), "damaged at byte 0: a line without"));
}

TEST(TextPath, ALastLineWithoutItsEndIsACutFile) {
  const RecordedFlight flight = flight_of_bytes("1 2 3 4 0 0 0 1\n2 2 3");
  EXPECT_EQ(flight.poses.size(), 1U);
  ASSERT_EQ(flight.warnings.size(), 1U);
  EXPECT_TRUE(has(flight.warnings[0], "log is cut off at byte 16,"));
  const RecordedFlight whole = flight_of_bytes("1 2 3 4 0 0 0 1\n2 2 3 4 0 0 0 1");
  EXPECT_EQ(whole.poses.size(), 2U);
  ASSERT_EQ(whole.warnings.size(), 1U);
  EXPECT_TRUE(has(whole.warnings[0], "the last line of log has no end"));
}

}  // namespace
}  // namespace avoidbench
