#include "tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "selection.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;
using planning::CellState;

Settings figures() {
  Settings s;
  s.speed_mps = 3.0;
  s.acceleration_mps2 = s.braking_mps2 = 4.0;
  s.greatest_acceleration_mps2 = 5.4;
  s.climb_mps2 = 0.5;
  s.jerk_mps3 = 20.0;
  s.robot_length_m = 0.8;
  s.robot_height_m = 0.4;
  s.primitive_s = 0.9;
  s.substep_s = 0.15;
  s.min_edge_substeps = 3;
  s.levels = 7;
  s.branch_levels = 4;
  s.root_samples = 15;
  s.child_samples = 2;
  s.max_tries = 30;
  s.cone_rad = 1.7;
  s.vertex_separation_m = 0.25;
  s.goal_bias = 0.4;
  s.evasive_arcs = 8;
  s.time_weight = 0.25;
  s.clearance_weight_m = 1.5;
  s.deviation_weight = 0.4;
  s.similarity_m = 0.5;
  s.max_traverse_m = 10.0;
  return s;
}

Limits limits_of(const Settings& s) { return {s.speed_mps, s.acceleration_mps2, s.jerk_mps3}; }

/// A grid of 0.2 m, known where a box says so; obstacles come from made-up images.
class Place {
 public:
  Place() : grid_(spec()) { grid_.reset({0.0, 0.0, 1.0}); }

  void make_free(const Vector3d& low, const Vector3d& high) {
    grid_.clear_box(0.5 * (low + high), high - low);
  }

  /// A wall of one cell across x, as wide as the grid is known, seen from the origin.
  void add_wall(double x) {
    const float depth = static_cast<float>(x);
    const std::vector<float> pixels(160 * 120, depth);
    ab_depth_image image{};
    image.struct_size = sizeof image;
    image.width_px = 160;
    image.height_px = 120;
    image.fx_px = image.fy_px = 80.0;
    image.cx_px = 79.5;
    image.cy_px = 59.5;
    image.position_world_m[2] = 1.0;
    const double half[] = {0.5, -0.5, 0.5, -0.5};  // RDF seen from FLU
    std::copy(std::begin(half), std::end(half), image.q_world_camera);
    image.depth_m = pixels.data();
    for (int i = 0; i < 8; ++i) grid_.integrate(image);
  }

  Space space(double length_m = 0.8, double height_m = 0.4) const {
    Space space;
    space.grid = &grid_;
    space.box_m = {length_m, length_m, height_m};
    space.lowest_m = 0.3;
    space.highest_m = 3.0;
    return space;
  }

 private:
  static planning::RollingGridSpec spec() {
    planning::RollingGridSpec spec;
    spec.resolution_m = 0.2;
    spec.half_size_m = 10.0;
    spec.longest_ray_m = 12.0;
    spec.inflation_m = 0.0;
    return spec;
  }
  planning::RollingGrid grid_;
};

Task task_in(const Place& place) {
  Task task;
  task.root.position = {0.0, 0.0, 1.0};
  task.goal = {30.0, 0.0, 1.0};
  task.goal_radius_m = 0.8;
  task.limits = limits_of(figures());
  task.space = place.space();
  return task;
}

TEST(PredictHit, RejectsALeafNearAWallAndAcceptsOneFarther) {
  Place place;
  place.make_free({-2.0, -4.0, 0.0}, {5.9, 4.0, 2.5});
  place.add_wall(6.1);
  // The authors' figures: 1.75 m/s, brakes with 2 m/s², a stop of 0.77 m and half a box of 1.4 m.
  Settings settings = figures();
  settings.braking_mps2 = settings.acceleration_mps2 = 2.0;
  settings.evasive_arcs = 0;
  const Space space = place.space(1.4, 0.8);
  const auto leaf = [](double before_m) {
    return Motion{Vector3d(6.1 - before_m, 0, 1.2), Vector3d(1.75, 0, 0), Vector3d::Zero()};
  };
  const Limits limits{1.75, 2.0, 20.0};
  EXPECT_FALSE(safe_path(leaf(1.0), space, limits, settings));
  EXPECT_TRUE(safe_path(leaf(3.0), space, limits, settings));
}

TEST(PredictHit, FindsAnEvasiveArcWhereBrakingIsTooLong) {
  Place place;
  place.make_free({-2.0, -4.0, 0.0}, {5.9, 4.0, 2.5});
  place.add_wall(6.1);
  Settings settings = figures();
  const Motion leaf{Vector3d(3.9, 0, 1.2), Vector3d(3.0, 0, 0), Vector3d::Zero()};
  const Limits limits = limits_of(settings);
  settings.braking_mps2 = 2.8;  // 2.4 m to stop
  const auto arc = safe_path(leaf, place.space(), limits, settings);
  settings.evasive_arcs = 0;
  EXPECT_FALSE(safe_path(leaf, place.space(), limits, settings));
  ASSERT_TRUE(arc);
  EXPECT_TRUE(are_free(*arc, place.space()));
  EXPECT_EQ(arc->back().velocity.norm(), 0.0);
}

TEST(Tree, KeepsOutOfWhatIsOccupiedOrUnknown) {
  Place place;
  place.make_free({-1.0, -1.5, 0.2}, {6.0, 3.0, 2.2});
  place.add_wall(5.3);
  const Task task = task_in(place);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    planning::Random random(seed);
    Tree tree(figures());
    tree.grow(task, random);
    ASSERT_GT(tree.vertices().size(), 20U);
    for (std::size_t i = 1; i < tree.vertices().size(); ++i) {
      const Vertex& vertex = tree.vertices()[i];
      EXPECT_TRUE(task.space.is_free(vertex.motion.position));
      EXPECT_LT(vertex.motion.position.x(), 5.3 - 0.4);
      const std::vector<Motion> path = tree.path_to(static_cast<int>(i));
      ASSERT_LT((path.back().position - vertex.motion.position).norm(), 1e-12);
      const auto before_edge = path.size() - static_cast<std::size_t>(vertex.steps);
      const std::vector<Motion> edge(path.begin() + static_cast<std::ptrdiff_t>(before_edge),
                                     path.end());
      for (std::size_t k = 2; k < edge.size(); k += 3) {  // each substep
        EXPECT_TRUE(task.space.is_free(edge[k].position));
      }
    }
  }
}

TEST(Tree, KeepsItsLimitsAndItsShape) {
  Place place;
  place.make_free({-9.0, -9.0, 0.2}, {9.0, 9.0, 3.2});
  const Task task = task_in(place);
  const Settings settings = figures();
  planning::Random random(1);
  Tree tree(settings);
  tree.grow(task, random);
  int roots = 0;
  for (const Vertex& vertex : tree.vertices()) {
    EXPECT_LE(vertex.motion.velocity.norm(), settings.speed_mps);
    EXPECT_LE(vertex.motion.acceleration.norm(), settings.greatest_acceleration_mps2);
    EXPECT_LE(std::abs(vertex.pull.z()), settings.climb_mps2);
    EXPECT_LT(vertex.level, settings.levels);
    if (vertex.level == 0) ++roots;
    const int most = vertex.level < 0 ? 15 : vertex.level < 4 ? 2 : 1;
    EXPECT_LE(vertex.children, most);
  }
  EXPECT_EQ(roots, 15);
  EXPECT_GT(tree.vertices().size(), 150U);
}

/// 0.9 s in steps of 0.05 s.
TEST(Tree, HasWholePrimitivesWhereAllIsFree) {
  Place place;
  place.make_free({-9.0, -9.0, -1.0}, {9.0, 9.0, 4.0});
  Task task = task_in(place);
  task.space.lowest_m = -0.5;
  task.space.highest_m = 3.5;
  Settings settings = figures();
  settings.levels = 3;  // none leads out of what is free
  planning::Random random(2);
  Tree tree(settings);
  tree.grow(task, random);
  ASSERT_GT(tree.vertices().size(), 15U);
  for (std::size_t i = 1; i < tree.vertices().size(); ++i) {
    const Vertex& vertex = tree.vertices()[i];
    EXPECT_EQ(vertex.steps, 18) << i;
    EXPECT_NEAR(vertex.time_s, 0.9 * (vertex.level + 1), 1e-9) << i;
  }
}

TEST(Tree, IsTheSameForTheSameSeed) {
  Place place;
  place.make_free({-3.0, -5.0, 0.2}, {7.0, 5.0, 3.0});
  const Task task = task_in(place);
  std::optional<double> sum;
  for (int i = 0; i < 2; ++i) {
    planning::Random random(9);
    Tree tree(figures());
    tree.grow(task, random);
    double now = 0.0;
    for (const Vertex& vertex : tree.vertices()) now += vertex.motion.position.x();
    EXPECT_EQ(sum.value_or(now), now);
    sum = now;
  }
}

TEST(Choose, GoesToTheGoalAndStopsInKnownSpace) {
  Place place;
  place.make_free({-3.0, -4.0, 0.2}, {7.0, 4.0, 3.0});
  Task task = task_in(place);
  planning::Random random(3);
  Tree tree(figures());
  tree.grow(task, random);
  const Potential potential{task.goal, {}};
  const auto far = choose(tree, task, potential, figures(), {}, 0.15);
  ASSERT_TRUE(far);
  EXPECT_GT(far->progress_m, 4.5);
  EXPECT_TRUE(are_free(far->path, task.space));
  EXPECT_TRUE(are_free(far->safe_path, task.space));
  EXPECT_EQ(far->safe_path.back().velocity.norm(), 0.0);
}

TEST(Choose, LeavesATrap) {
  Potential potential{{10.0, 0.0, 1.0}, {}};
  EXPECT_NEAR(potential.at({0.0, 0.0, 1.0}), 10.0, 1e-12);
  potential.traps.push_back({{0.0, 0.0, 1.0}, 3.0, 3.0});
  EXPECT_NEAR(potential.at({0.0, 0.0, 1.0}), 13.0, 1e-12);
  EXPECT_LT(potential.at({0.0, 3.0, 1.0}), 10.5);
}

TEST(Dissimilarity, IsTheDistanceOfParallelPaths) {
  std::vector<Motion> a, b;
  for (int i = 0; i < 30; ++i) {
    a.push_back({Vector3d(0.1 * i, 0.0, 1.0), Vector3d::Zero(), Vector3d::Zero()});
    b.push_back({Vector3d(0.1 * i, 0.7, 1.0), Vector3d::Zero(), Vector3d::Zero()});
  }
  EXPECT_NEAR(dissimilarity_m(a, a), 0.0, 1e-12);
  EXPECT_NEAR(dissimilarity_m(a, b), 0.7, 1e-9);
}

}  // namespace
}  // namespace mbplanner
