#include "explain/struck_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "render/scene.hpp"

namespace avoidbench {
namespace {

constexpr double kSpacing_m = 0.05;
constexpr std::size_t kMostPlaces = 200;

/// Places over a triangle, no farther apart than kSpacing_m: its corners' mean at least.
void add_places(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& around,
                std::vector<Eigen::Vector3d>& places) {
  const Eigen::Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
  // Triangles of the ground are metres long, and only a corner of one may be near.
  const double longest_m = std::max({u.norm(), v.norm(), (v - u).norm()});
  const int steps = static_cast<int>(std::clamp(std::ceil(longest_m / kSpacing_m), 1.0, 400.0));
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; i + j < steps; ++j) {
      // The middle of each of steps² parts that stand as the whole does.
      const double a = (i + 1.0 / 3.0) / steps, b = (j + 1.0 / 3.0) / steps;
      const Eigen::Vector3d place = corners[0] + a * u + b * v;
      if ((place - around).norm() <= kPatchRadius_m) places.push_back(place);
    }
  }
}

/// Whether a triangle's box comes within the patch's radius: most of a tree do not.
bool is_near(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& around) {
  const Eigen::Vector3d lowest = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Eigen::Vector3d highest = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  const Eigen::Vector3d nearest = around.cwiseMax(lowest).cwiseMin(highest);
  return (nearest - around).norm() <= kPatchRadius_m;
}

void add_instance(const World& struck, const Instance& instance, StruckPatch& patch,
                  std::int32_t motion) {
  const TriangleMesh& mesh = struck.prototypes[instance.prototype].mesh;
  const Eigen::Affine3d T = instance.T_world_prototype.cast<double>();
  std::vector<Eigen::Vector3d> places;
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = T * mesh.vertices[triangle[i]].cast<double>();
    if (is_near(corners, patch.contact_world)) add_places(corners, patch.contact_world, places);
  }
  patch.motion.insert(patch.motion.end(), places.size(), motion);
  patch.places_world.insert(patch.places_world.end(), places.begin(), places.end());
}

/// Every n-th, so that what is looked at does not depend on how finely a mesh is cut.
void thin_out(StruckPatch& patch) {
  const std::size_t count = patch.places_world.size();
  if (count <= kMostPlaces) return;
  for (std::size_t i = 0; i < kMostPlaces; ++i) {
    const std::size_t from = i * count / kMostPlaces;
    patch.places_world[i] = patch.places_world[from];
    patch.motion[i] = patch.motion[from];
  }
  patch.places_world.resize(kMostPlaces);
  patch.motion.resize(kMostPlaces);
}

}  // namespace

World alone(const World& world, std::int64_t obstacle, double time_s) {
  World struck = standing_at(world, time_s);
  std::erase_if(struck.instances, [&](const Instance& instance) {
    return static_cast<std::int64_t>(instance.obstacle) != obstacle;
  });
  return struck;
}

Pose body_pose_at(const std::vector<Sample>& samples, double time_s) {
  const auto after = std::upper_bound(samples.begin(), samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  const auto pose = [](const Sample& s) {
    return Pose(Eigen::Translation3d(s.position_world) * s.q_world_body);
  };
  if (after == samples.begin()) return pose(samples.front());
  if (after == samples.end()) return pose(samples.back());
  const Sample& a = *std::prev(after);
  const double share = (time_s - a.time_s) / (after->time_s - a.time_s);
  const Eigen::Vector3d position =
      a.position_world + share * (after->position_world - a.position_world);
  return Pose(Eigen::Translation3d(position) * a.q_world_body.slerp(share, after->q_world_body));
}

std::optional<StruckPatch> struck_patch(const World& world, const TrialRecord& record) {
  if (record.collisions.empty() || record.samples.empty()) return std::nullopt;
  const Collision& last = record.collisions.back();
  if (last.obstacle < 0 || last.obstacle >= static_cast<std::int64_t>(world.obstacles.size())) {
    return std::nullopt;
  }
  StruckPatch patch{.obstacle = last.obstacle,
                    .contact_s = last.time_s,
                    .places_world = {},
                    .motion = {},
                    .motions = {}};
  const World struck = alone(world, last.obstacle, last.time_s);
  if (struck.instances.empty()) return std::nullopt;
  // The surface nearest to the body's centre: a contact has no recorded place.
  const Eigen::Vector3d body = body_pose_at(record.samples, last.time_s).translation();
  patch.contact_world = Scene(struck).nearest(body).point_world;
  // `struck` has the instances of `world` in their order, without the others.
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    if (static_cast<std::int64_t>(world.instances[i].obstacle) != last.obstacle) continue;
    std::int32_t motion = -1;
    for (const Motion& one : world.motions) {
      if (one.instance != i) continue;
      motion = static_cast<std::int32_t>(patch.motions.size());
      patch.motions.push_back(
          {world.instances[i].T_world_prototype.translation().cast<double>(), one});
    }
    add_instance(struck, struck.instances[at++], patch, motion);
  }
  if (patch.places_world.empty()) return std::nullopt;
  thin_out(patch);
  return patch;
}

std::vector<Eigen::Vector3d> places_at(const StruckPatch& patch, double time_s) {
  std::vector<Eigen::Vector3d> places = patch.places_world;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (patch.motion[i] < 0) continue;
    const auto& [rest_world, motion] = patch.motions[static_cast<std::size_t>(patch.motion[i])];
    const MotionState now = state_at(motion, time_s);
    const MotionState contact = state_at(motion, patch.contact_s);
    const Eigen::Vector3d origin = rest_world + contact.offset_world;
    if (const double turn_rad = now.turn_rad - contact.turn_rad; turn_rad != 0.0) {
      places[i] = origin + upright_turn(turn_rad).cast<double>() * (places[i] - origin);
    }
    places[i] += now.offset_world - contact.offset_world;
  }
  return places;
}

}  // namespace avoidbench
