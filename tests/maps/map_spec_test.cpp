#include "maps/map_spec.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

// The same bits from every compiler. A change of these is a change of results: announce it.
constexpr const char* kForestDigest =
    "dc863f9ff77b95979a4eacf9b7b6562fc2b41599eca12bc84a17580f91ec109b";
constexpr const char* kHallDigest =
    "e0406f1f073d1ac3eb45428a6449d81bb774de13dd8d2a056e48bedc4027a1af";
constexpr const char* kAvoidbenchForestDigest =
    "f860c0487f50bd3221eeedfbf828cb090b7ab92631aed8eca13291bca6512d1f";
constexpr const char* kAvoidbenchIndoorDigest =
    "0a7a92fbcf7837b68c329ef6493f19552ba898c7edba670b19c1c1b8f939b7d5";

std::string error_of(const MapSpec& spec) {
  try {
    make_world(spec, 1);
  } catch (const InputError& error) {
    std::string all;
    for (const InputProblem& problem : error.problems()) all += problem.message + '\n';
    return all;
  }
  return {};
}

TEST(MapSpec, DigestsAreThoseOfEveryMachine) {
  EXPECT_EQ(make_world(ForestSpec{}, 42).digest, kForestDigest);
  EXPECT_EQ(make_world(HallSpec{}, 42).digest, kHallDigest);
  EXPECT_EQ(make_world(AvoidbenchForestSpec{}, 42).digest, kAvoidbenchForestDigest);
  EXPECT_EQ(make_world(AvoidbenchIndoorSpec{}, 42).digest, kAvoidbenchIndoorDigest);
  const HallSpec furnished{.crates_ratio = 0.3, .shelf_ratio = 0.3, .pillar_ratio = 0.2};
  const std::pair<MapSpec, std::string_view> others[] = {
      {furnished, "da5649e4d132ba85f16ddcc76084da605347886c1e0ff5ba774206d2a1f132e4"},
      {MazeSpec{}, "dc2102f61bc06313c7229a28a839cedba157e3631250a5b919b2664f47c7f924"},
      {GapWallsSpec{}, "9f6e1136f020fdc833648fefc455c545190c78596fc438d9099a584acbd19cd5"},
      {DeadEndsSpec{}, "1c27ba05109a25d21739012774198a283504798c294419277f079ffecc47a8a4"},
      {PolesSpec{}, "65c5175c5ef889b4d276f0b0dd0a17b20c6ee9bc100efe106f466c82c6ab239c"},
      {OverhangsSpec{}, "396348013663b8c93b3d802b3f7a33740a7a07bd190fac2b1eb582ab1df3f06b"}};
  for (const auto& [spec, digest] : others) {
    EXPECT_EQ(make_world(spec, 42).digest, digest) << kind(spec);
  }
}

TEST(MapSpec, OtherSeedsGiveOtherMapsAndTheSameSeedTheSame) {
  for (const MapSpec& spec : {MapSpec(ForestSpec{}), MapSpec(HallSpec{})}) {
    EXPECT_EQ(make_world(spec, 1).digest, make_world(spec, 1).digest);
    EXPECT_NE(make_world(spec, 1).digest, make_world(spec, 2).digest);
  }
}

TEST(MapSpec, DigestSeesEveryPart) {
  const World world = make_world(HallSpec{}, 1);
  const auto changed = [&](auto change) {
    World other = world;
    change(other);
    return world_digest(other) != world.digest;
  };
  EXPECT_EQ(world_digest(world), world.digest);
  EXPECT_TRUE(changed([](World& w) { w.prototypes[0].mesh.vertices[0].x() += 1e-3F; }));
  EXPECT_TRUE(changed([](World& w) {
    std::swap(w.prototypes[0].mesh.triangles[0][0], w.prototypes[0].mesh.triangles[0][1]);
  }));
  EXPECT_TRUE(changed([](World& w) { w.prototypes[0].triangle_materials[0] = Material::leaf; }));
  EXPECT_TRUE(
      changed([](World& w) { w.instances[1].T_world_prototype.translation().y() += 1.0F; }));
  EXPECT_TRUE(changed([](World& w) { w.obstacles[2].kind = "tree"; }));
  EXPECT_TRUE(changed([](World& w) { w.obstacles[2].texture_opacity = 0.5; }));
  EXPECT_TRUE(changed([](World& w) { w.bounds.extend(Eigen::Vector3d(100, 0, 0)); }));
  EXPECT_TRUE(changed([](World& w) { w.goal_region.lowest.x() += 1.0; }));
  EXPECT_TRUE(changed([](World& w) { w.heights_above_ground = true; }));
  EXPECT_TRUE(changed([](World& w) { w.mean_obstacle_width_m += 1.0; }));
  EXPECT_TRUE(changed([](World& w) { w.ground.heights_m.push_back(0.0F); }));
}

TEST(MapSpec, TrianglesAreCountedPerInstance) {
  World world = make_world(HallSpec{}, 1);
  const std::size_t before = triangle_count(world);
  world.instances.push_back(world.instances[0]);
  EXPECT_EQ(triangle_count(world), before + 12);
  EXPECT_GT(memory_bytes(world), 1000U);
}

TEST(MapSpec, ContradictionsAreTheUsersErrors) {
  ForestSpec high;
  high.flight_height_m = 6.0;
  EXPECT_NE(error_of(high).find("flight_height_m"), std::string::npos);
  ForestSpec small;
  small.area_m = {15.0, 40.0};
  small.poisson_radius_m = 10.0;
  EXPECT_NE(error_of(small).find("area_m"), std::string::npos);
  HallSpec hall;
  hall.flight_height_m = 7.0;
  hall.cylinder_diameter_m = {1.0, 0.5};
  EXPECT_NE(error_of(hall).find("flight_height_m"), std::string::npos);
  EXPECT_NE(error_of(hall).find("cylinder_diameter_m"), std::string::npos);
  HallSpec crowded;
  crowded.poisson_radius_m = 1.0;
  EXPECT_NE(error_of(crowded).find("cylinder_diameter_m"), std::string::npos);
}

TEST(MapSpec, NumbersOutsideTheirRangesAreTheUsersErrors) {
  ForestSpec tiny;
  tiny.area_m = {40.0, 1.0};
  EXPECT_NE(error_of(tiny).find("area_m: 1 is outside [15, 200]"), std::string::npos);
  HallSpec nan;
  nan.height_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(nan).find("height_m"), std::string::npos);
  EXPECT_EQ(error_of(ForestSpec{}), "");
  EXPECT_EQ(error_of(HallSpec{}), "");
}

}  // namespace
}  // namespace avoidbench
