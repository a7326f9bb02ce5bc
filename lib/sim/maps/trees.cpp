#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/math.hpp"
#include "maps/plants.hpp"
#include "maps/stems.hpp"

namespace avoidbench {
namespace {

/// The trunk begins below the ground, which is uneven.
constexpr double kRootDepth_m = 0.35;
/// Above it foliage is coarse: vehicles fly lower.
constexpr double kFineFoliageBelow_m = 3.8;
constexpr int kLowTuftCount = 3;
constexpr double kHighTuftRatio = 1.15;  // a few large tufts fill the crown
constexpr double kHighLeafyRatio = 0.72;

/// The habit of a kind of tree. Angles are from the vertical.
struct Species {
  std::string_view name;
  std::uint64_t seed = 0;
  double height_m = 7.0, trunk_radius_m = 0.17, trunk_wander_m = 0.1;
  int leader_count =
      0;  ///< stems the trunk forks into at the first bough; 0: it goes on to the top
  double first_bough_m = 2.4;
  int bough_count = 12;
  double lowest_angle_deg = 75.0, highest_angle_deg = 30.0;
  double rise = 0.4, wander = 0.12;
  double crown_radius_m = 2.0;
  double widest_ratio = 0.4;  ///< where in the crown's height it is widest
  int side_bough_count = 2;
  double leafy_ratio = 1.0;  ///< fraction of the tips that bear foliage
  double cluster_radius_m = 0.65;
  double cluster_stretch = 1.0;  ///< along the bough
  double cluster_flatness = 0.75;
  double along_ratio = 0.0;  ///< where on a bough a second cluster sits; 0: none
  int dead_twig_count = 4;   ///< below the first bough
};

constexpr std::array<Species, 6> kSpecies{
    Species{.name = "tree_broad",
            .seed = 11,
            .height_m = 6.8,
            .trunk_radius_m = 0.2,
            .trunk_wander_m = 0.16,
            .first_bough_m = 2.2,
            .bough_count = 11,
            .lowest_angle_deg = 78.0,
            .highest_angle_deg = 28.0,
            .rise = 0.45,
            .wander = 0.16,
            .crown_radius_m = 2.3,
            .widest_ratio = 0.35,
            .side_bough_count = 2,
            .leafy_ratio = 0.92,
            .cluster_radius_m = 0.6,
            .dead_twig_count = 3},
    Species{.name = "tree_slender",
            .seed = 22,
            .height_m = 8.2,
            .trunk_radius_m = 0.13,
            .trunk_wander_m = 0.12,
            .first_bough_m = 2.6,
            .bough_count = 15,
            .lowest_angle_deg = 58.0,
            .highest_angle_deg = 22.0,
            .rise = 0.2,
            .wander = 0.1,
            .crown_radius_m = 1.25,
            .widest_ratio = 0.35,
            .side_bough_count = 1,
            .leafy_ratio = 0.85,
            .cluster_radius_m = 0.44,
            .cluster_stretch = 1.25,
            .dead_twig_count = 4},
    Species{.name = "tree_conifer",
            .seed = 33,
            .height_m = 8.6,
            .trunk_radius_m = 0.17,
            .trunk_wander_m = 0.05,
            .first_bough_m = 2.1,
            .bough_count = 26,
            .lowest_angle_deg = 98.0,
            .highest_angle_deg = 72.0,
            .rise = 0.06,
            .wander = 0.05,
            .crown_radius_m = 1.75,
            .widest_ratio = 0.0,
            .side_bough_count = 0,
            .cluster_radius_m = 0.4,
            .cluster_stretch = 2.1,
            .cluster_flatness = 0.55,
            .dead_twig_count = 7},
    Species{.name = "tree_forked",
            .seed = 44,
            .height_m = 7.2,
            .trunk_radius_m = 0.19,
            .trunk_wander_m = 0.1,
            .leader_count = 3,
            .first_bough_m = 1.7,
            .bough_count = 13,
            .lowest_angle_deg = 70.0,
            .highest_angle_deg = 35.0,
            .rise = 0.3,
            .wander = 0.14,
            .crown_radius_m = 1.5,
            .widest_ratio = 0.5,
            .side_bough_count = 1,
            .leafy_ratio = 0.95,
            .cluster_radius_m = 0.6,
            .dead_twig_count = 1},
    Species{.name = "tree_crooked",
            .seed = 55,
            .height_m = 5.6,
            .trunk_radius_m = 0.17,
            .trunk_wander_m = 0.45,
            .first_bough_m = 1.5,
            .bough_count = 10,
            .lowest_angle_deg = 85.0,
            .highest_angle_deg = 40.0,
            .rise = -0.15,
            .wander = 0.2,
            .crown_radius_m = 2.1,
            .widest_ratio = 0.45,
            .side_bough_count = 2,
            .leafy_ratio = 0.66,
            .cluster_radius_m = 0.52,
            .dead_twig_count = 2},
    Species{.name = "tree_half_dead",
            .seed = 66,
            .height_m = 6.4,
            .trunk_radius_m = 0.15,
            .trunk_wander_m = 0.25,
            .first_bough_m = 1.3,
            .bough_count = 15,
            .lowest_angle_deg = 82.0,
            .highest_angle_deg = 30.0,
            .rise = 0.25,
            .wander = 0.24,
            .crown_radius_m = 1.7,
            .widest_ratio = 0.3,
            .side_bough_count = 3,
            .leafy_ratio = 0.12,
            .cluster_radius_m = 0.42,
            .dead_twig_count = 5},
};

/// The trunk from below the ground to where it ends, with flared roots.
Stem grow_trunk(const Species& species, RandomStream& random) {
  const double top_m =
      species.leader_count > 0 ? species.first_bough_m + 0.4 : 0.97 * species.height_m;
  const double first_turn = random.uniform(0.0, math::kTau);
  const double second_turn = random.uniform(0.0, math::kTau);
  Stem trunk;
  // Rings are close where the roots flare, and farther apart above. The last one is moved to the
  // trunk's top.
  for (double z :
       {-kRootDepth_m, 0.0, 0.12, 0.35, 0.8, 1.5, 2.2, 3.0, 3.9, 4.8, 5.8, 6.8, 7.6, 20.0}) {
    const bool last = z > top_m - 0.3;
    if (last) z = top_m;
    const double rise_ratio = std::max(z, 0.0) / species.height_m;
    const double sway = species.trunk_wander_m * std::sqrt(rise_ratio);
    // The sine at the foot is taken off: the trunk's foot is at the origin.
    const double x = sway * (math::sin(first_turn + 5.0 * rise_ratio) - math::sin(first_turn));
    const double y = sway * (math::sin(second_turn + 6.5 * rise_ratio) - math::sin(second_turn));
    const double flare = math::exp(-std::max(z, 0.0) / 0.25);
    const double taper = 1.0 - 0.88 * rise_ratio;
    const bool pointed = last && species.leader_count == 0;
    trunk.push_back(
        {.centre = {x, y, z},
         .radius_m = pointed ? 0.0 : species.trunk_radius_m * taper * (1.0 + 0.75 * flare),
         .lobe_ratio = 0.28 * flare});
    if (last) break;
  }
  return trunk;
}

/// The stems that bear the boughs: the trunk, or the leaders it forks into.
std::vector<Stem> grow_leaders(const Species& species, const Stem& trunk, RandomStream& random) {
  if (species.leader_count == 0) return {trunk};
  std::vector<Stem> leaders;
  for (int i = 0; i < species.leader_count; ++i) {
    const double lean = varied(24.0 * math::kDegree, 0.25, random);
    const double turn = varied(math::kTau * i / species.leader_count + 1.0, 0.06, random);
    // So long that its tip is about as high as the tree.
    const double length_m =
        varied((species.height_m - species.first_bough_m) / math::cos(lean), 0.1, random);
    const double root_ratio = 1.0 - 0.12 * i / species.leader_count;
    leaders.push_back(grow_stem({.root = stem_point(trunk, root_ratio - 0.02),
                                 .direction = turned_from(Eigen::Vector3d::UnitZ(), lean, turn),
                                 .length_m = length_m,
                                 .root_radius_m = 0.72 * stem_radius_m(trunk, 0.9),
                                 .segments = 6,
                                 .rise = 0.25,
                                 .wander = 0.09},
                                random));
  }
  return leaders;
}

/// Radius of the crown at this fraction of its height, of its greatest radius.
double crown_profile(const Species& species, double ratio) {
  const double widest = species.widest_ratio;
  if (ratio < widest) return 0.62 + 0.38 * ratio / widest;
  const double above = (ratio - widest) / (1.0 - widest);
  // A cone, as of conifers; others are round above their widest place.
  if (widest <= 0.0) return 1.0 - 0.9 * above;
  return std::sqrt(1.0 - 0.85 * above * above);
}

void add_leaf_tuft(Prototype& tree, const Species& species, const Eigen::Vector3d& centre,
                   const Eigen::Vector3d& along, double size, RandomStream& random) {
  const double radius_m = varied(species.cluster_radius_m * size, 0.22, random);
  const double flatness = varied(species.cluster_flatness, 0.15, random);
  // Less steep than the bough; the hair along x gives an upright one a direction.
  const Eigen::Vector3d ahead =
      (along - 0.5 * along.z() * Eigen::Vector3d::UnitZ() + Eigen::Vector3d(1e-6, 0, 0))
          .normalized();
  const Eigen::Vector3d sideways = Eigen::Vector3d::UnitZ().cross(ahead).normalized();
  TuftShape shape;
  shape.centre = centre;
  shape.axes.col(0) = ahead * (radius_m * species.cluster_stretch);
  shape.axes.col(1) = sideways * radius_m;
  shape.axes.col(2) = ahead.cross(sideways) * (radius_m * flatness);
  shape.lumps_ratio = 0.4;
  shape.tips_ratio = 0.5;
  shape.seed = random.bits();
  add_tuft(tree, shape, Material::leaf);
}

/// One tuft high up; where vehicles fly, three smaller ones, since they are seen from near.
void add_cluster(Prototype& tree, const Species& species, const Eigen::Vector3d& centre,
                 const Eigen::Vector3d& along, double size, RandomStream& random) {
  if (centre.z() > kFineFoliageBelow_m) {
    add_leaf_tuft(tree, species, centre, along, kHighTuftRatio * size, random);
    return;
  }
  const double spread_m = 0.55 * species.cluster_radius_m * size;
  const int count = species.cluster_stretch > 1.5 ? 2 : kLowTuftCount;
  for (int i = 0; i < count; ++i) {
    // Each by itself: compilers order the arguments of a call differently.
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    const double z = random.uniform(-0.5, 0.5);
    const double ahead = species.cluster_stretch * (i - 0.5 * (count - 1));
    const Eigen::Vector3d place =
        centre + spread_m * (ahead * along + 0.75 * Eigen::Vector3d(x, y, z));
    add_leaf_tuft(tree, species, place, along + Eigen::Vector3d(0.4 * x, 0.4 * y, 0.0), 0.62 * size,
                  random);
  }
}

/// Side boughs and foliage of one bough.
void dress_bough(Prototype& tree, const Species& species, const Stem& bough, double length_m,
                 RandomStream& random) {
  // A draw for each tip, whether it bears foliage or not.
  const auto add_foliage = [&](const Stem& stem, double ratio, double size) {
    const double draw = random.uniform();
    const Eigen::Vector3d place = stem_point(stem, ratio);
    const bool high = place.z() > kFineFoliageBelow_m && species.cluster_stretch < 1.5;
    if (draw >= species.leafy_ratio * (high ? kHighLeafyRatio : 1.0)) return;
    add_cluster(tree, species, place, stem_direction(stem, ratio), size, random);
  };
  const double cluster_at = species.cluster_stretch > 1.5 ? 0.62 : 0.92;
  add_foliage(bough, cluster_at, 0.5 + 0.5 * length_m / species.crown_radius_m);
  for (int i = 0; i < species.side_bough_count; ++i) {
    const double ratio =
        varied(0.45 + 0.35 * i / std::max(1, species.side_bough_count - 1), 0.12, random);
    const double angle = varied(48.0 * math::kDegree, 0.25, random);
    // By turns to either side.
    const double turn = varied(i % 2 == 0 ? 0.2 : math::kPi - 0.2, 0.5, random);
    const double side_length_m = varied(0.5 * length_m * (1.15 - 0.5 * ratio), 0.2, random);
    const Stem side =
        grow_stem({.root = stem_point(bough, ratio),
                   .direction = turned_from(stem_direction(bough, ratio), angle, turn),
                   .length_m = side_length_m,
                   .root_radius_m = 0.72 * stem_radius_m(bough, ratio),
                   .segments = 3,
                   .rise = 0.3 + species.rise,
                   .wander = 1.3 * species.wander},
                  random);
    add_tube(tree, side, 3, Material::bark);
    add_foliage(side, 0.85, 0.8);
  }
}

/// Boughs from the lowest to the top of their leaders, each as long as the crown is wide there;
/// then leaves at the leaders' tips.
void grow_boughs(Prototype& tree, const Species& species, const std::vector<Stem>& leaders,
                 RandomStream& random) {
  for (int i = 0; i < species.bough_count; ++i) {
    // Boughs go round the leaders by turns.
    const Stem& leader = leaders[static_cast<std::size_t>(i) % leaders.size()];
    const double top_m = leader.back().centre.z();
    const double crown_ratio = (i + 0.5) / species.bough_count;
    const double low_m = std::max(species.first_bough_m, leader.front().centre.z() + 0.5);
    const double height_m = low_m + (0.97 * top_m - low_m) * varied(crown_ratio, 0.08, random);
    // The place on the leader at this height.
    double ratio = 0.0;
    while (ratio < 0.98 && stem_point(leader, ratio).z() < height_m) ratio += 0.01;

    const double angle_deg = species.lowest_angle_deg +
                             (species.highest_angle_deg - species.lowest_angle_deg) * crown_ratio;
    const double angle = varied(angle_deg * math::kDegree, 0.12, random);
    // The golden angle: no bough stands right above another one.
    const double turn = kGoldenAngle_rad * i + varied(0.3, 1.0, random);
    const double reach_m = species.crown_radius_m * crown_profile(species, crown_ratio);
    const double length_m = varied(reach_m, 0.18, random);
    const double root_radius_m =
        // A bough is never thicker than the stem that bears it.
        std::clamp(0.03 * length_m, 0.012, 0.6 * stem_radius_m(leader, ratio) + 0.008);
    const Stem bough = grow_stem({.root = stem_point(leader, ratio),
                                  .direction = turned_from(Eigen::Vector3d::UnitZ(), angle, turn),
                                  .length_m = length_m,
                                  .root_radius_m = root_radius_m,
                                  .segments = species.side_bough_count == 0 ? 3 : 5,
                                  .rise = species.rise,
                                  .wander = species.wander},
                                 random);
    add_tube(tree, bough, species.side_bough_count == 0 ? 3 : 4, Material::bark);
    dress_bough(tree, species, bough, length_m, random);
  }
  for (const Stem& leader : leaders) {
    const double draw = random.uniform();
    if (draw >= species.leafy_ratio) continue;
    add_cluster(tree, species, stem_point(leader, 0.95), Eigen::Vector3d::UnitX(), 0.85, random);
  }
}

/// Bare twigs on the trunk below the crown.
void add_dead_twigs(Prototype& tree, const Species& species, const Stem& trunk,
                    RandomStream& random) {
  for (int i = 0; i < species.dead_twig_count; ++i) {
    const double height_m = random.uniform(0.9, species.first_bough_m + 0.2);
    const double turn = random.uniform(0.0, math::kTau);
    const double length_m = random.uniform(0.25, 0.9);
    const double angle = random.uniform(60.0, 105.0) * math::kDegree;
    double ratio = 0.0;
    while (ratio < 0.98 && stem_point(trunk, ratio).z() < height_m) ratio += 0.01;
    const Stem twig = grow_stem({.root = stem_point(trunk, ratio),
                                 .direction = turned_from(Eigen::Vector3d::UnitZ(), angle, turn),
                                 .length_m = length_m + stem_radius_m(trunk, ratio),
                                 .root_radius_m = 0.016,
                                 .segments = 3,
                                 .rise = -0.1,
                                 .wander = 0.2},
                                random);
    add_tube(tree, twig, 3, Material::bark);
  }
}

PlantModel grow_tree(const Species& species) {
  // By the species' own seed: the same six trees in all maps.
  RandomStream random = stream(species.seed, "tree");
  PlantModel model;
  Prototype& tree = model.prototype;
  tree.name = species.name;
  const Stem trunk = grow_trunk(species, random);
  for (const TubeRing& ring : trunk) {
    model.trunk_heights_m.push_back(ring.centre.z());
    model.trunk_radii_m.push_back(ring.radius_m);
  }
  add_tube(tree, trunk, 10, Material::bark);
  const std::vector<Stem> leaders = grow_leaders(species, trunk, random);
  if (species.leader_count > 0) {
    for (const Stem& leader : leaders) add_tube(tree, leader, 6, Material::bark);
  }
  add_dead_twigs(tree, species, trunk, random);
  grow_boughs(tree, species, leaders, random);
  return model;
}

}  // namespace

std::vector<PlantModel> tree_models() {
  std::vector<PlantModel> models;
  for (const Species& species : kSpecies) models.push_back(grow_tree(species));
  return models;
}

}  // namespace avoidbench
