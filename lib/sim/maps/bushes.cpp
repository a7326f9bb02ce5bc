#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/math.hpp"
#include "maps/plants.hpp"
#include "maps/stems.hpp"

namespace avoidbench {
namespace {

struct BushHabit {
  std::string_view name;
  std::uint64_t seed = 0;
  double height_m = 1.4;
  double radius_m = 0.8;
  int blob_count = 7;
  int twig_count = 6;
};

constexpr std::array<BushHabit, 4> kHabits{
    BushHabit{.name = "bush_low", .seed = 1, .height_m = 0.85, .radius_m = 0.62, .blob_count = 5},
    BushHabit{.name = "bush_round", .seed = 2, .height_m = 1.45, .radius_m = 0.66, .blob_count = 6},
    BushHabit{.name = "bush_tall", .seed = 3, .height_m = 1.85, .radius_m = 0.52, .blob_count = 7},
    BushHabit{
        .name = "bush_spread", .seed = 4, .height_m = 1.75, .radius_m = 0.85, .blob_count = 8},
};

PlantModel grow_bush(const BushHabit& habit) {
  // By its own seed: the same four bushes in all maps.
  RandomStream random = stream(habit.seed, "bush");
  PlantModel model;
  Prototype& bush = model.prototype;
  bush.name = habit.name;
  for (int i = 0; i < habit.blob_count; ++i) {
    // Blobs spiral outwards and down from the highest, in the middle.
    // The square root spreads the blobs evenly by area, and the golden angle around the middle.
    const double out = std::sqrt((i + 0.25) / habit.blob_count);
    const double turn = kGoldenAngle_rad * i + varied(0.4, 1.0, random);
    const double size_m = varied(0.52 * habit.radius_m * (1.15 - 0.35 * out), 0.12, random);
    const double tallness = varied(1.1, 0.12, random);
    const double top_m =
        varied(habit.height_m * (1.0 - 0.42 * out * out), i == 0 ? 0.0 : 0.1, random);
    const double away_m = std::max(0.0, habit.radius_m * out - 0.35 * size_m);
    const double half_height_m = std::max(0.5 * (top_m + 0.12), size_m * tallness);
    TuftShape shape;
    shape.centre = {away_m * math::cos(turn), away_m * math::sin(turn), top_m - half_height_m};
    shape.axes = Eigen::Vector3d(size_m, size_m, half_height_m).asDiagonal();
    shape.subdivisions = 1;
    shape.lumps_ratio = 0.3;
    shape.tips_ratio = 0.3;
    shape.seed = random.bits();
    add_tuft(bush, shape, Material::leaf);
  }
  for (int i = 0; i < habit.twig_count; ++i) {
    const double turn = kGoldenAngle_rad * i;
    const double lean = random.uniform(5.0, 28.0) * math::kDegree;
    const double length_m = random.uniform(0.8, 1.08) * habit.height_m;
    const Stem twig = grow_stem({.direction = turned_from(Eigen::Vector3d::UnitZ(), lean, turn),
                                 .length_m = length_m,
                                 .root_radius_m = 0.02,
                                 .segments = 4,
                                 .rise = 0.2,
                                 .wander = 0.12},
                                random);
    add_tube(bush, twig, 3, Material::bark);
  }
  return model;
}

}  // namespace

std::vector<PlantModel> bush_models() {
  std::vector<PlantModel> models;
  for (const BushHabit& habit : kHabits) models.push_back(grow_bush(habit));
  return models;
}

double obstacle_width_m(const PlantModel& model, double scale, double height_m) {
  // In the model's own metres, before it is scaled.
  const double own_height_m = height_m / scale;
  const std::vector<double>& heights = model.trunk_heights_m;
  if (!heights.empty()) {
    // Above the trunk's end (a fork, the top) its last thickness counts.
    const auto above = std::lower_bound(heights.begin(), heights.end(), own_height_m);
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(above - heights.begin(), 1, std::ssize(heights) - 1));
    const double ratio =
        std::clamp((own_height_m - heights[i - 1]) / (heights[i] - heights[i - 1]), 0.0, 1.0);
    const double radius_m =
        model.trunk_radii_m[i - 1] + ratio * (model.trunk_radii_m[i] - model.trunk_radii_m[i - 1]);
    return 2.0 * scale * radius_m;
  }
  double widest_m = 0.0;
  // Every 10°, over half a turn: a width is the same from both sides.
  constexpr int kDirections = 18;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = math::kPi * k / kDirections;
    const double x = math::cos(angle);
    const double y = math::sin(angle);
    // From 0: the root's own place counts in.
    double least = 0.0, most = 0.0;
    for (const Eigen::Vector3f& vertex : model.prototype.mesh.vertices) {
      if (static_cast<double>(vertex.z()) > own_height_m) continue;
      const double along =
          x * static_cast<double>(vertex.x()) + y * static_cast<double>(vertex.y());
      least = std::min(least, along);
      most = std::max(most, along);
    }
    widest_m = std::max(widest_m, most - least);
  }
  return scale * widest_m;
}

}  // namespace avoidbench
