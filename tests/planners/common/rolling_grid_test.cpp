#include "planning/rolling_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace planning {
namespace {

using Eigen::Vector3d;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A level camera at `eye` that looks along +x.
struct Camera {
  std::vector<float> depth_m = std::vector<float>(std::size_t{64} * 48, 3.0F);
  ab_depth_image image{};

  explicit Camera(const Vector3d& eye) {
    image.struct_size = sizeof(image);
    image.width_px = 64;
    image.height_px = 48;
    image.fx_px = image.fy_px = 32.0;
    image.cx_px = 31.5;
    image.cy_px = 23.5;
    for (int k = 0; k < 3; ++k) image.position_world_m[k] = eye[k];
    const double q[4] = {0.5, -0.5, 0.5, -0.5};
    std::copy(q, q + 4, image.q_world_camera);
  }
  void fill(float depth) { depth_m.assign(depth_m.size(), depth); }
  const ab_depth_image& seen() {
    image.depth_m = depth_m.data();
    return image;
  }
};

RollingGridSpec small() {
  RollingGridSpec spec;
  spec.half_size_m = 4.0;
  spec.pixel_step = 1;
  return spec;
}

TEST(RollingGrid, AWallIsOccupiedAfterTwoImagesAndWhatIsBeforeItFree) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  const Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  EXPECT_EQ(grid.state(wall), CellState::unknown);
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::free);
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::occupied);
  for (double x = 0.15; x < 2.9; x += 0.1) {
    EXPECT_EQ(grid.state(grid.cell_of({x, 0.05, 2.05})), CellState::free) << x;
  }
  EXPECT_EQ(grid.state(grid.cell_of({3.5, 0.05, 2.05})), CellState::unknown);
  EXPECT_EQ(grid.state(grid.cell_of({-1.0, 0.0, 2.0})), CellState::unknown);
}

TEST(RollingGrid, NothingInRangeFreesUpToTheLongestRayAndNanSaysNothing) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  camera.fill(std::numeric_limits<float>::quiet_NaN());
  grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(grid.cell_of({1.0, 0.05, 2.05})), CellState::unknown);
  for (const float depth : {kInfinity, 100.0F}) {
    grid.reset({0, 0, 2});
    camera.fill(depth);
    for (int i = 0; i < 5; ++i) grid.integrate(camera.seen());
    EXPECT_EQ(grid.state(grid.cell_of({3.8, 0.05, 2.05})), CellState::free);
    EXPECT_TRUE(grid.occupied_centers().empty());
  }
}

/// Every third column of pixels ends 1 m ahead, the others go on: more than a third of the rays
/// through a cell end in it, and less than half.
TEST(RollingGrid, HowManyRaysMakeAHitIsSettled) {
  RollingGridSpec spec = small();
  Camera camera({0.0, 0.0, 2.0});
  for (std::size_t i = 0; i < camera.depth_m.size(); i += 3) camera.depth_m[i] = 1.05F;
  const auto occupied_near = [&] {
    RollingGrid grid(spec);
    grid.reset({0, 0, 2});
    for (int i = 0; i < 8; ++i) grid.integrate(camera.seen());
    const std::vector<Vector3d> centers = grid.occupied_centers();
    return std::count_if(centers.begin(), centers.end(),
                         [](const Vector3d& center) { return center.x() < 2.0; });
  };
  EXPECT_GT(occupied_near(), 100);
  spec.passes_per_hit = 1.0;
  EXPECT_GT(occupied_near(), 50);  // they are a surface that is grazed
  spec.keeps_grazed = 0;
  EXPECT_LT(occupied_near(), 5);
}

/// By the numbers of EGO-Planner's launch file.
TEST(RollingGrid, UnknownSpaceBelowFreeTakesSixImagesToo) {
  RollingGridSpec spec = small();
  spec.hit = 0.619;
  spec.miss = -0.619;
  spec.lowest_log_odds = -1.992;
  spec.unknown_log_odds = -2.002;
  RollingGrid grid(spec);
  Camera camera({0.0, 0.0, 2.0});
  const Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  const auto images_until_occupied = [&] {
    int images = 0;
    for (; images < 20 && grid.state(wall) != CellState::occupied; ++images) {
      grid.integrate(camera.seen());
    }
    return images;
  };
  grid.reset({0, 0, 2});
  EXPECT_EQ(images_until_occupied(), 6);
  camera.fill(kInfinity);
  for (int i = 0; i < 10; ++i) grid.integrate(camera.seen());
  ASSERT_EQ(grid.state(wall), CellState::free);
  camera.fill(3.0F);
  EXPECT_EQ(images_until_occupied(), 6);
  grid.move_to({100, 0, 2});
  grid.move_to({0, 0, 2});
  EXPECT_EQ(images_until_occupied(), 6);
}

TEST(RollingGrid, WhatWentAwayIsFreedAgain) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 10; ++i) grid.integrate(camera.seen());
  const Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  ASSERT_EQ(grid.state(wall), CellState::occupied);
  camera.fill(kInfinity);
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  EXPECT_EQ(grid.state(wall), CellState::free);
  EXPECT_FALSE(grid.is_inflated(wall));
}

TEST(RollingGrid, InflationIsTheCubeAroundOccupiedCells) {
  RollingGridSpec spec = small();
  spec.inflation_m = 0.3;
  RollingGrid grid(spec);
  grid.reset({0, 0, 2});
  std::mt19937 random(3);
  Camera camera({0.0, 0.0, 2.0});
  for (int k = 0; k < 4; ++k) {
    for (float& depth : camera.depth_m) depth = 1.0F + static_cast<float>(random() % 300) / 100.0F;
    for (int i = 0; i < 2; ++i) grid.integrate(camera.seen());
    grid.move_to({0.3 * k, -0.2 * k, 2.0});
  }
  const std::vector<Vector3d> occupied = grid.occupied_centers();
  ASSERT_GT(occupied.size(), 100U);
  int inflated = 0;
  for (int i = 0; i < 3000; ++i) {
    const Cell cell(static_cast<int>(random() % 70) - 30, static_cast<int>(random() % 70) - 35,
                    static_cast<int>(random() % 60) - 4);
    if (!grid.contains(cell)) continue;
    bool expected = false;
    for (const Vector3d& center : occupied) {
      expected = expected || ((grid.cell_of(center) - cell).cwiseAbs().maxCoeff() <= 3);
    }
    EXPECT_EQ(grid.is_inflated(cell), expected);
    inflated += expected ? 1 : 0;
  }
  EXPECT_GT(inflated, 100);
}

TEST(RollingGrid, RollingKeepsWhatStaysAndForgetsWhatLeaves) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  const std::vector<Vector3d> before = grid.occupied_centers();
  ASSERT_FALSE(before.empty());
  grid.move_to({1.5, -0.7, 2.0});
  for (const Vector3d& center : before) {
    const Cell cell = grid.cell_of(center);
    EXPECT_EQ(grid.state(cell), grid.contains(cell) ? CellState::occupied : CellState::unknown);
  }
  grid.move_to({7.5, 0.0, 2.0});  // the wall at x = 3 is out now
  grid.move_to({0.0, 0.0, 2.0});
  EXPECT_TRUE(grid.occupied_centers().empty());
  grid.move_to({100.0, 50.0, 2.0});
  EXPECT_EQ(grid.state(grid.cell_of({100.0, 50.0, 2.0})), CellState::unknown);
}

TEST(RollingGrid, TheVehiclesOwnPlaceIsFree) {
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0.0, 0.0, 2.0});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  grid.clear_box({3.0, 0.0, 2.0}, {0.6, 0.6, 0.4});
  EXPECT_EQ(grid.state(grid.cell_of({3.05, 0.05, 2.05})), CellState::free);
  EXPECT_EQ(grid.state(grid.cell_of({3.05, 0.55, 2.05})), CellState::occupied);
}

/// 320 x 240 pixels, 90 degrees wide, level and looking along +x, of what `depth` says of each
/// direction: (left, up) at 1 m.
template <class Depth>
Camera forest_camera(const Vector3d& eye, Depth depth) {
  Camera camera(eye);
  camera.image.width_px = 320;
  camera.image.height_px = 240;
  camera.image.fx_px = camera.image.fy_px = 160.0;
  camera.image.cx_px = 159.5;
  camera.image.cy_px = 119.5;
  camera.depth_m.clear();
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      camera.depth_m.push_back(static_cast<float>(depth((159.5 - u) / 160.0, (119.5 - v) / 160.0)));
    }
  }
  return camera;
}

/// The states of all cells around the origin, the inflation of each with it.
std::vector<int> states(const RollingGrid& grid) {
  std::vector<int> all;
  for (int x = -90; x < 90; ++x) {
    for (int y = -90; y < 90; ++y) {
      for (int z = -8; z < 64; ++z) {
        const Cell cell(x, y, z);
        all.push_back(2 * static_cast<int>(grid.state(cell)) + (grid.is_inflated(cell) ? 1 : 0));
      }
    }
  }
  return all;
}

void expect_inflation_as_by_brute_force(const RollingGrid& grid) {
  const int reach = 3;
  std::vector<Cell> occupied;
  for (const Vector3d& center : grid.occupied_centers()) occupied.push_back(grid.cell_of(center));
  std::vector<char> inflated(std::size_t{200} * 200 * 90, 0);
  const auto at = [&](const Cell& c) -> char& {
    return inflated[static_cast<std::size_t>(((c.x() + 100) * 200 + c.y() + 100) * 90 + c.z() +
                                             12)];
  };
  for (const Cell& cell : occupied) {
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) at(cell + Cell(x, y, z)) = 1;
      }
    }
  }
  int wrong = 0;
  for (int x = -90; x < 90; ++x) {
    for (int y = -90; y < 90; ++y) {
      for (int z = -8; z < 64; ++z) {
        const Cell cell(x, y, z);
        if (grid.contains(cell)) wrong += grid.is_inflated(cell) != (at(cell) != 0) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(RollingGridImages, AWallIsOnePlaneOfCellsAndAllCellsBeforeItAreFree) {
  RollingGrid grid{RollingGridSpec{}};
  grid.reset({0.02, 0.03, 3.0});
  const Vector3d eye(0.02, 0.03, 3.0);
  Camera camera = forest_camera(eye, [](double, double) { return 3.43; });  // x = 3.45
  for (int i = 0; i < 2; ++i) grid.integrate(camera.seen());
  int walls = 0, before = 0;
  for (int x = -59; x < 59; ++x) {
    for (int y = -59; y < 59; ++y) {
      for (int z = 0; z < 60; ++z) {
        const Vector3d way = grid.center_of({x, y, z}) - eye;
        const bool is_seen = way.x() > 0.3 && std::abs(way.y()) < 0.98 * way.x() - 0.1 &&
                             std::abs(way.z()) < 0.735 * way.x() - 0.1 && way.norm() < 4.9;
        if (x != 34) {
          EXPECT_NE(grid.state({x, y, z}), CellState::occupied) << x << " " << y << " " << z;
        }
        if (x > 34) {
          EXPECT_EQ(grid.state({x, y, z}), CellState::unknown);
        }
        if (!is_seen || x > 34) continue;
        EXPECT_EQ(grid.state({x, y, z}), x == 34 ? CellState::occupied : CellState::free)
            << x << " " << y << " " << z;
        ++(x == 34 ? walls : before);
      }
    }
  }
  EXPECT_GT(walls, 2000);
  EXPECT_GT(before, 15000);
}

TEST(RollingGridImages, APoleOfAPixelOrTwoIsKept) {
  for (const double width_px : {1.0, 1.5, 2.0}) {
    for (double left_m = -1.0; left_m < 1.0; left_m += 0.0317) {
      RollingGrid grid{RollingGridSpec{}};
      grid.reset({0.0, 0.0, 2.0});
      Camera camera = forest_camera({0.0, 0.0, 2.0}, [&](double left, double) {
        return std::abs(left * 4.05 - left_m) * 160.0 / 4.05 <= 0.5 * width_px ? 4.05 : 20.0;
      });
      for (int i = 0; i < 2; ++i) grid.integrate(camera.seen());
      for (int z = 10; z < 30; ++z) {
        bool is_kept = false;
        for (int y = grid.cell_of({0, left_m - 0.05, 0}).y(); y * 0.1 < left_m + 0.05; ++y) {
          is_kept = is_kept || grid.state({40, y, z}) == CellState::occupied;
        }
        EXPECT_TRUE(is_kept) << width_px << " pixels at " << left_m << " m, cell " << z;
      }
    }
  }
}

/// The rays beside a twig go on behind its cells when it is too near to be seen itself.
TEST(RollingGridImages, ATwigIsNotForgottenOnTheWayPastIt) {
  RollingGridSpec spec;
  spec.resolution_m = 0.15;
  spec.least_ray_m = 0.8;
  RollingGrid grid(spec);
  grid.reset({0.0, 0.0, 2.0});
  for (double x = 0.0; x < 1.9; x += 0.05) {
    const double away_m = 2.02 - x;
    Camera camera = forest_camera({x, 0.0, 2.0}, [&](double left, double up) {
      const bool is_twig = std::abs(up * away_m - 0.07) < 0.01 && std::abs(left * away_m) < 0.3;
      return is_twig ? away_m : static_cast<double>(kInfinity);
    });
    grid.integrate(camera.seen());
    if (x < 0.1) continue;  // two images make it occupied
    EXPECT_EQ(grid.state(grid.cell_of({2.02, 0.05, 2.07})), CellState::occupied) << x;
  }
}

TEST(RollingGridImages, AGrazedFloorStaysOccupiedWhateverItsHeightInItsCells) {
  for (const double floor_m : {0.01, 0.03, 0.05, 0.08}) {
    RollingGrid grid{RollingGridSpec{}};
    grid.reset({0.0, 0.0, 1.0});
    const auto floor_from = [&](const Vector3d& eye) {
      return forest_camera(eye, [&, eye](double, double up) {
        return up < 0.0 ? (eye.z() - floor_m) / -up : std::numeric_limits<double>::infinity();
      });
    };
    Camera near = floor_from({1.5, 0.0, 2.5});  // steep enough to see each cell
    for (int i = 0; i < 6; ++i) grid.integrate(near.seen());
    std::vector<Cell> floor;
    for (int x = 0; x < 55; ++x) {
      for (int y = -10; y < 10; ++y) {
        if (grid.state({x, y, 0}) == CellState::occupied) floor.emplace_back(x, y, 0);
      }
    }
    ASSERT_GT(floor.size(), 100U) << floor_m;
    Camera low = floor_from({0.0, 0.0, floor_m + 0.6});
    for (int i = 0; i < 20; ++i) grid.integrate(low.seen());
    int lost = 0;
    for (const Cell& cell : floor) lost += grid.state(cell) == CellState::occupied ? 0 : 1;
    EXPECT_EQ(lost, 0) << floor_m << " of " << floor.size();
  }
}

TEST(RollingGridImages, AWrongSurfaceIsClearedByRaysThroughItBesideATrunkToo) {
  RollingGrid grid{RollingGridSpec{}};
  grid.reset({0.0, 0.0, 2.0});
  const auto trunk = [](double left) { return left * 2.0 > 0.0 && left * 2.0 < 0.4; };
  Camera wrong = forest_camera({0, 0, 2}, [&](double left, double up) {
    if (trunk(left)) return 2.05;
    return std::abs(left + 0.12) < 0.02 && std::abs(up) < 0.02 ? 3.05 : 8.0;
  });
  for (int i = 0; i < 6; ++i) grid.integrate(wrong.seen());
  const Cell ghost = grid.cell_of({3.05, -0.12 * 3.05, 2.0});
  ASSERT_EQ(grid.state(ghost), CellState::occupied);
  Camera right =
      forest_camera({0, 0, 2}, [&](double left, double) { return trunk(left) ? 2.05 : 8.0; });
  for (int i = 0; i < 3; ++i) grid.integrate(right.seen());
  EXPECT_EQ(grid.state(ghost), CellState::free);
  EXPECT_EQ(grid.state(grid.cell_of({2.05, 0.2, 2.0})), CellState::occupied);
}

TEST(RollingGridImages, PixelsThatSayNothingChangeNothingAndOddImagesAreSurvived) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<int> unknown = [] {
    RollingGrid grid(small());
    return states(grid);
  }();
  for (const float depth :
       {std::nanf(""), 0.0F, -1.0F, -kInfinity, 1e-40F, 0.05F, -std::nanf("")}) {
    RollingGrid grid(small());
    Camera camera({0, 0, 2});
    camera.fill(depth);
    camera.depth_m.back() = depth;
    grid.integrate(camera.seen());
    EXPECT_EQ(states(grid), unknown) << depth;
  }
  const auto expect_left_out = [&](auto spoil) {
    RollingGrid grid(small());
    Camera camera({0, 0, 2});
    camera.seen();
    spoil(camera.image);
    grid.integrate(camera.image);
    EXPECT_EQ(states(grid), unknown);
  };
  for (const double bad : {kNan, HUGE_VAL, 1e300}) {
    expect_left_out([&](ab_depth_image& image) { image.position_world_m[1] = bad; });
    expect_left_out([&](ab_depth_image& image) { image.q_world_camera[2] = bad; });
  }
  expect_left_out([&](ab_depth_image& image) { image.fx_px = kNan; });
  expect_left_out([&](ab_depth_image& image) { image.fy_px = 0.0; });
  expect_left_out([&](ab_depth_image& image) { image.cx_px = HUGE_VAL; });
  expect_left_out([&](ab_depth_image& image) { image.width_px = image.height_px = 0; });
  expect_left_out([&](ab_depth_image& image) { std::fill_n(image.q_world_camera, 4, 0.0); });
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera pixel({0, 0, 2});
  pixel.image.width_px = pixel.image.height_px = 1;
  pixel.image.cx_px = pixel.image.cy_px = 0.0;
  for (int i = 0; i < 2; ++i) grid.integrate(pixel.seen());
  ASSERT_EQ(grid.occupied_centers().size(), 1U);
  grid.move_to({kNan, 0, 0});
  EXPECT_EQ(grid.occupied_centers().size(), 1U);
  EXPECT_EQ(grid.box_state({kNan, 0, 2}, {1, 1, 1}), CellState::unknown);
  EXPECT_FALSE(grid.is_inflated(Vector3d(1e300, kNan, 0)));
}

/// Random depths of 0.3 to 6 m, one in ten NaN or +inf.
void randomize(Camera& camera, std::mt19937& random) {
  for (float& depth : camera.depth_m) {
    const auto kind = random() % 20;
    depth = 0.3F + static_cast<float>(random() % 570) / 100.0F;
    if (kind == 0) depth = std::nanf("");
    if (kind == 1) depth = kInfinity;
  }
}

TEST(RollingGridImages, SameImagesGiveTheSameCellsWhereverTheRingStarts) {
  std::mt19937 random(7);
  RollingGrid grid(small()), again(small());
  grid.reset({0, 0, 2});
  again.reset({3.1, -2.3, 2});
  again.move_to({0, 0, 2});
  RollingGrid twice = grid;
  Camera camera({0.03, 0.01, 2.02});
  for (int i = 0; i < 6; ++i) {
    randomize(camera, random);
    for (RollingGrid* each : {&grid, &again, &twice}) {
      each->move_to({0.1 * i, -0.2 * i, 2});
      each->integrate(camera.seen());
    }
  }
  ASSERT_GT(grid.occupied_centers().size(), 10U);
  EXPECT_EQ(states(grid), states(again));
  EXPECT_EQ(states(grid), states(twice));
}

TEST(RollingGridImages, InflationIsThatOfBruteForceAfterEachMove) {
  std::mt19937 random(11);
  RollingGrid grid(small());
  grid.reset({0, 0, 2});
  Camera camera({0, 0, 2});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());  // a wall that moves go through
  for (const Vector3d& center :
       {Vector3d(1.0, 0.4, 2), Vector3d(-1.02, 0.7, 2), Vector3d(-0.3, -2.2, 2),
        Vector3d(2.5, 1.5, 2), Vector3d(4.5, 1.5, 2), Vector3d(1.0, 0.0, 2)}) {
    grid.move_to(center);
    expect_inflation_as_by_brute_force(grid);
    randomize(camera, random);
    for (int i = 0; i < 2; ++i) grid.integrate(camera.seen());
    expect_inflation_as_by_brute_force(grid);
    grid.clear_box(center, {1.0, 0.6, 0.5});
    expect_inflation_as_by_brute_force(grid);
  }
}

TEST(RollingGridImages, BoxStateIsThatOfAllCellsItTouches) {
  std::mt19937 random(5);
  RollingGrid grid{small()};
  grid.reset({1.3, -0.9, 2});
  Camera camera({0, 0, 2});
  for (int i = 0; i < 3; ++i) grid.integrate(camera.seen());
  camera.fill(kInfinity);
  grid.clear_box({0.0, 0.0, 5.5}, {2.0, 2.0, 1.0});  // across two words of a column
  const auto uniform = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random()) / 4294967295.0;
  };
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < 6000; ++i) {
    const Vector3d center(uniform(-3.5, 5.5), uniform(-5.5, 3.5), uniform(-0.8, 6.3));
    const Vector3d size(uniform(0.0, 0.7), uniform(0.0, 0.7), uniform(0.0, 0.9));
    const Cell from = grid.cell_of(center - 0.5 * size), to = grid.cell_of(center + 0.5 * size);
    CellState expected = CellState::free;
    for (int x = from.x(); x <= to.x(); ++x) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int z = from.z(); z <= to.z(); ++z) {
          const CellState here = grid.state({x, y, z});
          EXPECT_EQ(grid.is_known({x, y, z}), here != CellState::unknown);
          if (here == CellState::occupied) expected = here;
          if (here == CellState::unknown && expected == CellState::free) expected = here;
        }
      }
    }
    EXPECT_EQ(grid.box_state(center, size), expected);
    ++counts[static_cast<int>(expected)];
  }
  for (const int count : counts) EXPECT_GT(count, 100);
}

TEST(WithoutBorder, LeavesTheSameRaysInTheMiddle) {
  std::vector<float> depth_m(40 * 20);
  for (std::size_t i = 0; i < depth_m.size(); ++i) depth_m[i] = static_cast<float>(i);
  ab_depth_image image{};
  image.width_px = 40;
  image.height_px = 20;
  image.cy_px = 9.5;
  image.depth_m = depth_m.data();
  const ab_depth_image inner = without_border(image, 0.1);
  EXPECT_EQ(inner.height_px, 16);
  EXPECT_EQ(inner.depth_m[0], 80.0F);  // two rows further
  EXPECT_EQ(inner.cy_px, 7.5);         // so that its rows look where they did
  EXPECT_EQ(without_border(image, 0.0).height_px, 20);
  image.height_px = 0;
  EXPECT_EQ(without_border(image, 0.3).height_px, 0);
}

}  // namespace
}  // namespace planning
