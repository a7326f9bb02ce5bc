#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "flight.hpp"

namespace ego {
namespace {

using Eigen::Vector3d;

/// The settings of `preset: published`, of what the host fills in what is asked for here.
Settings published() {
  Settings settings;
  const auto value = [](const char* name) {
    for (const ab_named_number& number : kPublished) {
      if (std::string(number.name) == name) return number.number;
    }
    ADD_FAILURE() << name;
    return 0.0;
  };
  settings.grid.longest_ray_m = value("ray_length_m");
  settings.grid.hit = value("hit_log_odds");
  settings.grid.miss = value("miss_log_odds");
  settings.grid.lowest_log_odds = value("least_log_odds");
  settings.grid.unknown_log_odds = value("unknown_log_odds");
  settings.grid.passes_per_hit = value("passes_per_hit");
  settings.grid.keeps_grazed = static_cast<int>(value("keeps_grazed"));
  settings.image_border_ratio = value("image_border_ratio");
  settings.map_period_s = value("map_period_s");
  settings.departure_m = value("departure_m");
  settings.least_height_m = value("least_height_m");
  settings.ceiling_m = value("ceiling_m");
  return settings;
}

/// A level camera 2 m high that looks along +x.
struct Eye {
  std::vector<float> depth_m = std::vector<float>(std::size_t{320} * 240, 3.0F);
  ab_depth_image image{};

  Eye() {
    image.struct_size = sizeof(image);
    image.width_px = 320;
    image.height_px = 240;
    image.fx_px = image.fy_px = 160.0;
    image.cx_px = 159.5;
    image.cy_px = 119.5;
    image.position_world_m[2] = 2.0;
    const double q[4] = {0.5, -0.5, 0.5, -0.5};
    std::copy(q, q + 4, image.q_world_camera);
  }
  const ab_depth_image& at(double time_s) {
    image.time_s = time_s;
    image.depth_m = depth_m.data();
    return image;
  }
};

ab_mission mission_of(const Vector3d& start, const Vector3d& goal) {
  ab_mission mission{};
  mission.struct_size = sizeof(mission);
  for (int k = 0; k < 3; ++k) {
    mission.start_world_m[k] = start[k];
    mission.goal_world_m[k] = goal[k];
  }
  return mission;
}

int images_until_occupied(const Settings& settings, double period_s) {
  Flight flight(settings);
  flight.reset(mission_of({0, 0, 2}, {20, 0, 2}));
  Eye eye;
  const planning::RollingGrid& grid = flight.surroundings().grid;
  const planning::Cell wall = grid.cell_of({3.0 + 1e-6, 0.05, 2.05});
  for (int i = 1; i <= 40; ++i) {
    flight.see(eye.at(i * period_s));
    if (grid.state(wall) == planning::CellState::occupied) return i;
  }
  return 0;
}

TEST(Published, ASurfaceCountsAfterSixImagesInUnknownSpaceToo) {
  EXPECT_EQ(images_until_occupied(published(), 0.05), 6);
  EXPECT_EQ(images_until_occupied(Settings{}, 0.05), 2);
}

/// Of 30 images a second 20 go into the map.
TEST(Published, TheMapTakesAnImageEachPeriod) {
  EXPECT_EQ(images_until_occupied(published(), 1.0 / 30.0), 8);
}

/// Each camera of a rig has periods of its own: all expose at the same moments.
TEST(Published, TheMapTakesAnImageOfEachCameraEachPeriod) {
  Flight flight(published());
  flight.reset(mission_of({0, 0, 2}, {20, 0, 2}));
  Eye ahead, left;
  left.image.camera = 1;
  const double q[4] = {0.7071067811865476, -0.7071067811865476, 0.0, 0.0};  // along +y
  std::copy(q, q + 4, left.image.q_world_camera);
  for (int i = 1; i <= 8; ++i) {
    flight.see(ahead.at(0.05 * i));
    flight.see(left.at(0.05 * i));
  }
  const planning::RollingGrid& grid = flight.surroundings().grid;
  EXPECT_EQ(grid.state(grid.cell_of({3.0 + 1e-6, 0.05, 2.05})), planning::CellState::occupied);
  EXPECT_EQ(grid.state(grid.cell_of({0.05, 3.0 + 1e-6, 2.05})), planning::CellState::occupied);
}

TEST(Published, HeightsEndAtGroundAndCeiling) {
  Flight flight(published());
  flight.reset(mission_of({0, 0, 1}, {20, 0, 1}));
  EXPECT_EQ(flight.surroundings().lowest_m, -0.01);
  EXPECT_EQ(flight.surroundings().highest_m, 2.5);
  flight.reset(mission_of({0, 0, 3}, {20, 0, 2}));  // a mission above the ceiling can be flown
  EXPECT_EQ(flight.surroundings().highest_m, 3.0);
  Flight tuned(Settings{});
  tuned.reset(mission_of({0, 0, 1}, {20, 0, 1.2}));
  EXPECT_EQ(tuned.surroundings().lowest_m, 0.5);
  EXPECT_EQ(tuned.surroundings().highest_m, 2.2);
}

}  // namespace
}  // namespace ego
