#include "wind/wind_field.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/random.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

Vector3d linear(const Vector3d& p) {
  return {1 + 0.5 * p.x() - 0.25 * p.y() + 2 * p.z(), 3 - p.x() + p.y(), 0.1 * p.z() - 4};
}

/// 4 × 3 columns of three layers from (-2, 1), 5 and 4 m apart, over bottom(x, y).
std::string field_text(const std::function<double(double, double)>& bottom) {
  std::ostringstream text;
  text.precision(17);
  text << "# a linear wind\nmin_x: -2\nmin_y: 1\nn_x: 4\nn_y: 3\nres_x: 5\nres_y: 4\n"
       << "vertical_spacing_factors: 0 0.25 1\n";
  const double layers[] = {0, 0.25, 1};
  constexpr double kDepth = 8.0;
  std::ostringstream parts[5];
  for (auto& part : parts) part.precision(17);
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 4; ++ix) {
      parts[0] << ' ' << bottom(-2 + 5 * ix, 1 + 4 * iy);
      parts[1] << ' ' << bottom(-2 + 5 * ix, 1 + 4 * iy) + kDepth;
    }
  }
  for (const double layer : layers) {
    for (int iy = 0; iy < 3; ++iy) {
      for (int ix = 0; ix < 4; ++ix) {
        const double x = -2 + 5 * ix, y = 1 + 4 * iy;
        const Vector3d wind = linear({x, y, bottom(x, y) + kDepth * layer});
        for (int axis = 0; axis < 3; ++axis) parts[2 + axis] << ' ' << wind[axis];
      }
    }
  }
  const char* keys[] = {"bottom_z", "top_z", "u", "v", "w"};
  for (int i = 0; i < 5; ++i) text << keys[i] << ':' << parts[i].str() << '\n';
  return text.str();
}

TEST(WindField, ALinearFieldIsExactBetweenTheKnots) {
  const WindField field = parse_wind_field(field_text([](double, double) { return 1.0; }), "f");
  EXPECT_EQ(field.count_x, 4U);
  EXPECT_EQ(field.wind_mps.size(), 36U);
  RandomStream random(4);
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(-2, 13);
    const double y = random.uniform(1, 9);
    const double z = random.uniform(1, 9);
    EXPECT_LT((wind_at(field, {x, y, z}) - linear({x, y, z})).norm(), 1e-12);
  }
}

TEST(WindField, ColumnsMayFollowTheGround) {
  const auto slope = [](double x, double y) { return 0.2 * x - 0.1 * y; };
  const WindField field = parse_wind_field(field_text(slope), "f");
  for (int i = 0; i <= 10; ++i) {  // within a column linear in z
    const double z = slope(8, 5) + 0.8 * i;
    EXPECT_LT((wind_at(field, {8, 5, z}) - linear({8, 5, z})).norm(), 1e-12);
  }
}

TEST(WindField, OutsideItIsThatOfTheNearestPlace) {
  const WindField field = parse_wind_field(field_text([](double, double) { return 1.0; }), "f");
  EXPECT_LT((wind_at(field, {-50, 5, 4}) - linear({-2, 5, 4})).norm(), 1e-12);
  EXPECT_LT((wind_at(field, {99, 99, 99}) - linear({13, 9, 9})).norm(), 1e-12);
  EXPECT_LT((wind_at(field, {3, -7, -7}) - linear({3, 1, 1})).norm(), 1e-12);
  EXPECT_LT((wind_at(field, {1e300, 5, 4}) - linear({13, 5, 4})).norm(), 1e-12);
}

TEST(WindField, OneColumnOfOneLayerIsAConstantWind) {
  const WindField field = parse_wind_field(
      "min_x: 0 min_y: 0 n_x: 1 n_y: 1 res_x: 1 res_y: 1 vertical_spacing_factors: 0\n"
      "bottom_z: 0 top_z: 1 u: 1 v: 2 w: 3",
      "f");
  EXPECT_EQ(wind_at(field, {5, -5, 0.5}), Vector3d(1, 2, 3));
}

std::string complaint(std::string text, const std::string& from, const std::string& to) {
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return test::message_of([&] { parse_wind_field(text, "f.txt"); });
}

TEST(WindField, WhatIsWrongIsToldWithItsPlace) {
  const std::string good = field_text([](double, double) { return 1.0; });
  EXPECT_EQ(complaint(good, "", ""), "");
  EXPECT_EQ(complaint(good, "n_x: 4", "n_x: 4.5"),
            "f.txt:4:6: n_x: not a whole number from 1 to 10000");
  EXPECT_EQ(complaint(good, "n_x: 4", "n_x: 5"), "f.txt:9:1: bottom_z: 12 numbers, not 15");
  EXPECT_EQ(complaint(good, "res_x: 5", "res_x: 0"), "f.txt:6:8: res_x: not above 0");
  EXPECT_EQ(complaint(good, "min_y: 1\n", ""), "f.txt: lacks 'min_y:'");
  EXPECT_EQ(complaint(good, "min_y:", "min_z:"),
            "f.txt:3:1: 'min_z' is not a key (did you mean min_x?)");
  EXPECT_EQ(complaint(good, "min_y: 1", "min_x: 1"), "f.txt:3:1: min_x: is given twice");
  EXPECT_EQ(complaint(good, "0 0.25 1", "0 0.25 0.2"),
            "f.txt:8:34: vertical_spacing_factors: not above the one before");
  EXPECT_EQ(complaint(good, "top_z: 9", "top_z: 1"),
            "f.txt:10:8: top_z: not above the same column's bottom_z");
  EXPECT_EQ(complaint(good, "min_y: 1", "min_y: nan"),
            "f.txt:3:8: min_y: 'nan' is not a finite number");
  EXPECT_EQ(complaint(good, "min_y: 1", "min_y: 1m"),
            "f.txt:3:8: min_y: '1m' is not a finite number");
  EXPECT_EQ(complaint("3", "", ""), "f.txt:1:1: a number before the first 'key:'");
  EXPECT_EQ(complaint("", "", ""), "f.txt: lacks 'min_x:'");
}

TEST(WindField, AFileMustHaveItsDigest) {
  const std::string file =
      (std::filesystem::temp_directory_path() / "avoidbench_wind_field_test.txt").string();
  std::ofstream(file) << field_text([](double, double) { return 1.0; });
  EXPECT_EQ(read_wind_field(file, "").wind_mps.size(), 36U);
  EXPECT_EQ(read_wind_field(file, file_digest(file)).count_y, 3U);
  EXPECT_THROW(read_wind_field(file, "00"), InputError);
  std::filesystem::remove(file);
  EXPECT_THROW(read_wind_field(file, ""), InputError);
}

}  // namespace
}  // namespace avoidbench
