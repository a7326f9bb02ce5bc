#include "sensing/lidar.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

#include "base/math.hpp"
#include "sensing/lidar_scan.hpp"
#include "support/test_worlds.hpp"
#include "world/solids.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Without noise, sees everything up to 200 m.
LidarSpec plain(const LidarSpec& noisy) {
  LidarSpec lidar = noisy;
  lidar.range_sigma_m = lidar.angle_sigma_deg = lidar.dropout_ratio = 0.0;
  lidar.min_range_m = 0.0;
  lidar.max_range_m = 200.0;
  lidar.range_at_10_percent_m = 1000.0;
  return lidar;
}

LidarSpec lidar_preset(const std::string& name) {
  for (const LidarSpec& lidar : lidar_presets()) {
    if (lidar.name == name) return lidar;
  }
  ADD_FAILURE() << "no lidar " << name;
  return {};
}

World world_of(Prototype prototype, const Eigen::Affine3f& where = Eigen::Affine3f::Identity()) {
  World world;
  world.prototypes.push_back(std::move(prototype));
  test::place(world, 0, where);
  return world;
}

/// The plane x = distance_m, seen by a lidar at the origin.
World wall_at(double distance_m) {
  Prototype slab;
  add_box(slab, {distance_m, -80.0, -80.0}, {distance_m + 1.0, 80.0, 80.0}, Material::concrete);
  return world_of(std::move(slab));
}

/// A whole sweep in steps of a ms. `pose_at` gives where the lidar is, from the sweep's start.
template <class PoseAt>
LidarSweep swept(const LidarSpec& spec, const World& world, const PoseAt& pose_at,
                 std::int64_t index = 0, std::uint64_t seed = 1, Tick step = 36) {
  const Scene scene(world);
  Lidar lidar(spec);
  lidar.begin_sweep(index, seed);
  const Tick period = required_period(spec.rate_hz);
  for (Tick from = 0; from < period; from += step) {
    const Tick to = std::min(from + step, period);
    const Pose T_from = pose_at(seconds(from)), T_to = pose_at(seconds(to));
    lidar.fire(scene, {.from = from,
                       .to = to,
                       .T_world_from = T_from,
                       .T_world_to = T_to,
                       .T_believed_from = T_from,
                       .T_believed_to = T_to});
  }
  LidarSweep sweep;
  lidar.end_sweep(pose_at(seconds(period)), sweep);
  return sweep;
}

LidarSweep swept_at_rest(const LidarSpec& spec, const World& world, std::int64_t index = 0,
                         std::uint64_t seed = 1) {
  return swept(
      spec, world, [](double) { return Pose::Identity(); }, index, seed);
}

Vector3d place(const LidarPoint& point) { return point.position_lidar.cast<double>(); }

TEST(Lidar, MeetsAPlaneWhereItIs) {
  for (const LidarSpec& lidar : lidar_presets()) {
    const LidarSweep sweep = swept_at_rest(plain(lidar), wall_at(7.0));
    ASSERT_GT(sweep.points.size(), 1000U) << lidar.name;
    for (const LidarPoint& point : sweep.points) {
      ASSERT_NEAR(place(point).x(), 7.0, 1e-3);
    }
  }
}

/// A ball and a column of so many sides that they are round to 0.2 mm.
TEST(Lidar, MeetsABallAndACylinderWhereTheyAre) {
  constexpr int kSides = 360;
  const Vector3d centre(6.0, 1.0, 0.5);
  Prototype ball;
  std::vector<TubeRing> rings;
  for (int i = 0; i <= kSides / 2; ++i) {
    const double angle = math::kPi * i / (kSides / 2);
    rings.push_back({.centre = {0.0, 0.0, -math::cos(angle)}, .radius_m = math::sin(angle)});
  }
  add_tube(ball, rings, kSides, Material::brick);
  Prototype column;
  const std::array<TubeRing, 2> ends{TubeRing{.centre = {0.0, 0.0, -30.0}, .radius_m = 1.0},
                                     TubeRing{.centre = {0.0, 0.0, 30.0}, .radius_m = 1.0}};
  add_tube(column, ends, kSides, Material::brick);
  const Eigen::Affine3f there(Eigen::Translation3f(centre.cast<float>()));
  const LidarSpec lidar = plain(lidar_preset("mid360_like"));
  const LidarSweep of_ball = swept_at_rest(lidar, world_of(std::move(ball), there));
  const LidarSweep of_column = swept_at_rest(lidar, world_of(std::move(column), there));
  EXPECT_GT(of_ball.points.size(), 100U);
  EXPECT_GT(of_column.points.size(), 500U);
  for (const LidarPoint& point : of_ball.points) {
    ASSERT_NEAR((place(point) - centre).norm(), 1.0, 1e-3);
  }
  for (const LidarPoint& point : of_column.points) {
    ASSERT_NEAR((place(point) - centre).head<2>().norm(), 1.0, 1e-3);
  }
  // Each shot meets something or nothing.
  EXPECT_EQ(static_cast<std::int64_t>(of_ball.points.size() + of_ball.misses.size()),
            shots_per_sweep(lidar));
}

/// A turning lidar that flies toward a wall: what it tells raw is seen from where it was, in closed
/// form; de-skewed it is the wall.
TEST(Lidar, SkewIsThatOfTheMotion) {
  constexpr double kSpeed_mps = 6.0, kTurn_radps = 2.0, kWall_m = 12.0;
  const auto pose_at = [](double time_s) {
    return make_pose({kSpeed_mps * time_s, 0.4 * time_s, 0.1}, yaw_rotation(kTurn_radps * time_s));
  };
  for (const char* name : {"velodyne_16", "mid360_like"}) {
    LidarSpec lidar = plain(lidar_preset(name));
    const LidarSweep straight = swept(lidar, wall_at(kWall_m), pose_at);
    lidar.deskewed = false;
    const LidarSweep raw = swept(lidar, wall_at(kWall_m), pose_at);
    ASSERT_EQ(raw.points.size(), straight.points.size());
    const double period_s = 1.0 / lidar.rate_hz;
    const Pose T_world_end = pose_at(period_s);
    double most_skew_m = 0.0;
    for (std::size_t i = 0; i < raw.points.size(); ++i) {
      const auto time_s = period_s + static_cast<double>(raw.points[i].time_s);
      const double way_m = kWall_m - kSpeed_mps * time_s;
      const Vector3d direction = place(raw.points[i]).normalized();
      const double along =
          math::cos(math::atan2(direction.y(), direction.x()) + kTurn_radps * time_s) *
          direction.head<2>().norm();
      const bool is_front = along > 0.3;
      if (!is_front) continue;
      ASSERT_NEAR(place(raw.points[i]).norm(), way_m / along, 1e-3) << name << i;
      const Vector3d world = T_world_end * place(straight.points[i]);
      ASSERT_NEAR(world.x(), kWall_m, 1e-3) << name << i;
      most_skew_m =
          std::max(most_skew_m, std::abs((T_world_end * place(raw.points[i])).x() - kWall_m));
    }
    EXPECT_GT(most_skew_m, 0.5) << name;
  }
}

/// Whoever steps the flight more finely sees the same.
TEST(Lidar, StepsDoNotMatter) {
  const LidarSpec lidar = lidar_preset("mid360_like");
  const World world = wall_at(5.0);
  const auto still = [](double) { return Pose::Identity(); };
  const LidarSweep fine = swept(lidar, world, still, 3, 9, 7);
  const LidarSweep coarse = swept(lidar, world, still, 3, 9, 144);
  ASSERT_EQ(fine.points.size(), coarse.points.size());
  ASSERT_GT(fine.points.size(), 500U);
  for (std::size_t i = 0; i < fine.points.size(); ++i) {
    ASSERT_EQ(fine.points[i].position_lidar, coarse.points[i].position_lidar);
    ASSERT_EQ(fine.points[i].time_s, coarse.points[i].time_s);
  }
}

TEST(Lidar, NoiseIsThatOfTheSpec) {
  LidarSpec lidar = plain(lidar_preset("mid360_like"));
  lidar.range_sigma_m = 0.03;
  lidar.dropout_ratio = 0.1;
  const World world = wall_at(8.0);
  const LidarSweep clean = swept_at_rest(plain(lidar), world);
  const LidarSweep noisy = swept_at_rest(lidar, world);
  const double kept =
      static_cast<double>(noisy.points.size()) / static_cast<double>(clean.points.size());
  EXPECT_NEAR(kept, 0.9, 0.015);
  double square_sum = 0.0, sum = 0.0;
  for (const LidarPoint& point : noisy.points) {
    const double true_m = 8.0 / place(point).normalized().x();
    const double error_m = place(point).norm() - true_m;
    sum += error_m;
    square_sum += error_m * error_m;
  }
  const auto count = static_cast<double>(noisy.points.size());
  EXPECT_NEAR(sum / count, 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(square_sum / count), 0.03, 0.002);
}

/// Points of an error in angle lie on the wall no more: their distance is that of another
/// direction.
TEST(Lidar, AnglesErrAcrossTheBeam) {
  LidarSpec lidar = plain(lidar_preset("velodyne_16"));
  lidar.angle_sigma_deg = 0.1;
  const LidarSweep sweep = swept_at_rest(lidar, wall_at(10.0));
  double square_sum = 0.0;
  int count = 0;
  for (const LidarPoint& point : sweep.points) {
    const Vector3d direction = place(point).normalized();
    // At 45°: d = 10 / cos, whose change with the angle is 10 tan / cos.
    if (std::abs(std::abs(math::atan2(direction.y(), direction.x())) - math::kPi / 4) > 0.02)
      continue;
    const double tangent = std::abs(direction.y() / direction.x());
    const double sensitivity_m = 10.0 / direction.x() * tangent;
    square_sum += std::pow((place(point).norm() - 10.0 / direction.x()) / sensitivity_m, 2);
    ++count;
  }
  ASSERT_GT(count, 300);
  EXPECT_NEAR(std::sqrt(square_sum / count) / math::kDegree, 0.1, 0.015);
}

/// The farther a surface, the darker and the flatter it is seen, the less comes back.
TEST(Lidar, ReturnsFadeWithReflectanceAndIncidence) {
  LidarSpec lidar = plain(lidar_preset("velodyne_16"));
  lidar.range_at_10_percent_m = 10.0;
  // Concrete is at 0.35: head-on it is seen up to 18.7 m.
  const double head_on_m = 10.0 * std::sqrt(3.5);
  EXPECT_TRUE(swept_at_rest(lidar, wall_at(head_on_m + 0.1)).points.empty());
  const LidarSweep sweep = swept_at_rest(lidar, wall_at(12.0));
  ASSERT_GT(sweep.points.size(), 200U);
  double flattest = 1.0;
  for (const LidarPoint& point : sweep.points) {
    const double cosine = place(point).normalized().x();
    EXPECT_NEAR(static_cast<double>(point.intensity), 0.35 * cosine, 1e-5);
    EXPECT_LE(place(point).norm(), 10.0 * std::sqrt(3.5 * cosine) + 1e-3);
    flattest = std::min(flattest, cosine);
  }
  // 12 / cos = 10 sqrt(3.5 cos): cos³ = 144 / 350.
  EXPECT_NEAR(flattest, std::cbrt(144.0 / 350.0), 0.01);
  lidar.max_range_m = 11.0;
  EXPECT_TRUE(swept_at_rest(lidar, wall_at(12.0)).points.empty());
  lidar.min_range_m = 3.0;
  EXPECT_TRUE(swept_at_rest(lidar, wall_at(2.0)).points.size() <
              swept_at_rest(plain(lidar), wall_at(2.0)).points.size());
}

/// A wide beam meets a twig beside its axis, and tells of what fills most of it.
TEST(Lidar, WideBeamsSeeWhatIsBesideTheirAxis) {
  Prototype twig;
  // Between two columns, which are 24.5 mm apart there.
  add_box(twig, {4.0, 0.008, -20.0}, {4.01, 0.012, 20.0}, Material::bark);
  const World world = world_of(std::move(twig));
  LidarSpec lidar = plain(lidar_preset("ouster_os0_32"));
  EXPECT_TRUE(swept_at_rest(lidar, world).points.empty());
  lidar.rays_per_beam = 16;
  lidar.divergence_mrad = 6.0;
  const LidarSweep wide = swept_at_rest(lidar, world);
  EXPECT_GT(wide.points.size(), 20U);
  for (const LidarPoint& point : wide.points) {
    EXPECT_LT(static_cast<double>(point.intensity), 0.35 * 0.6);  // most of the beam goes on
  }
}

TEST(LidarScan, PresetsFireAsTheirDataSheetsSay) {
  EXPECT_EQ(shots_per_sweep(lidar_preset("velodyne_16")), 28'800);
  EXPECT_EQ(shots_per_sweep(lidar_preset("ouster_os0_32")), 32'768);
  EXPECT_EQ(shots_per_sweep(lidar_preset("mid360_like")), 20'000);
  for (const LidarSpec& lidar : lidar_presets()) {
    double least = 10.0, most = -10.0;
    std::set<int> azimuths;
    for (std::int64_t i = 0; i < shots_per_sweep(lidar); ++i) {
      const Vector3d direction = shot_direction(lidar, 0, i);
      ASSERT_NEAR(direction.norm(), 1.0, 1e-12);
      const double elevation = math::asin(direction.z());
      least = std::min(least, elevation);
      most = std::max(most, elevation);
      azimuths.insert(
          static_cast<int>(std::floor(math::atan2(direction.y(), direction.x()) / math::kDegree)));
    }
    EXPECT_NEAR(least, elevations_rad(lidar)[0], 0.2 * math::kDegree) << lidar.name;
    EXPECT_NEAR(most, elevations_rad(lidar)[1], 0.2 * math::kDegree) << lidar.name;
    EXPECT_GE(azimuths.size(), 360U) << lidar.name;  // all around
  }
}

/// Share of the cells of 1° by 1° in view that n sweeps have fired into.
double coverage(const LidarSpec& lidar, std::int64_t sweeps) {
  std::set<std::pair<int, int>> cells;
  for (std::int64_t k = 0; k < sweeps; ++k) {
    for (std::int64_t i = 0; i < shots_per_sweep(lidar); ++i) {
      const Vector3d d = shot_direction(lidar, k, i);
      cells.emplace(static_cast<int>(std::floor(math::atan2(d.y(), d.x()) / math::kDegree)),
                    static_cast<int>(std::floor(math::asin(d.z()) / math::kDegree)));
    }
  }
  return static_cast<double>(cells.size()) / (360.0 * 59.0);
}

TEST(LidarScan, PatternsFillWhatTheyLeftOut) {
  const LidarSpec lidar = lidar_preset("mid360_like");
  // 20,000 shots over 21,240 cells: evenly at random they would meet 61 % of them.
  EXPECT_GT(coverage(lidar, 1), 0.7);
  EXPECT_GT(coverage(lidar, 2), 0.9);
  EXPECT_GT(coverage(lidar, 4), 0.98);
}

TEST(LidarScan, MountingsAreThoseOfCameras) {
  MountingSpec mounting{.position_body_m = {0.1, 0.2, 0.3}, .yaw_deg = 90.0, .pitch_deg = 30.0};
  const Pose T_body = T_body_lidar(mounting);
  // Forward is left and down; up is tilted forward, which is left.
  EXPECT_LT(
      (T_body.linear().col(0) - Vector3d(0.0, math::cos(math::kPi / 6), -math::sin(math::kPi / 6)))
          .norm(),
      1e-12);
  EXPECT_LT(
      (T_body.linear().col(2) - Vector3d(0.0, math::sin(math::kPi / 6), math::cos(math::kPi / 6)))
          .norm(),
      1e-12);
  EXPECT_EQ(T_body_lidar({.position_body_m = {0.0, 0.0, 0.1}}).linear(),
            Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace avoidbench
