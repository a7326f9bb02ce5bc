#include "page/world_data.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "page/packed.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

constexpr double kMillimetre_m = 0.001;
constexpr double kTurnSteps = 16384.0;  // of a quaternion's numbers
constexpr double kScaleStep = 0.0001;

Eigen::AlignedBox3f box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex);
  return box;
}

/// The vertex's place within the box along each side.
std::array<std::int64_t, 3> steps_in(const Eigen::AlignedBox3f& box,
                                     const Eigen::Vector3f& vertex) {
  std::array<std::int64_t, 3> place{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double size = static_cast<double>(box.max()[k]) - static_cast<double>(box.min()[k]);
    const double from_low = static_cast<double>(vertex[k]) - static_cast<double>(box.min()[k]);
    place[static_cast<std::size_t>(k)] =
        size > 0.0 ? steps(from_low / size, 1.0 / static_cast<double>(kMeshSteps)) : 0;
  }
  return place;
}

void add_triangles(const Prototype& prototype, Packed& packed) {
  std::vector<std::int64_t> corners;
  for (const auto& triangle : prototype.mesh.triangles) {
    for (const std::uint32_t corner : triangle) corners.push_back(corner);
  }
  packed.add_deltas(corners);
  std::vector<std::uint8_t> materials;
  for (const Material material : prototype.triangle_materials) {
    materials.push_back(static_cast<std::uint8_t>(material));
  }
  packed.add_bytes(materials);
}

/// Millimetres; what is shared by all instances of a prototype.
void add_prototypes(const World& world, const std::vector<std::size_t>& mesh_of, Packed& packed) {
  for (std::size_t i = 0; i < world.prototypes.size(); ++i) {
    packed.add_unsigned(mesh_of[i]);
    const Eigen::AlignedBox3f box = box_of(world.prototypes[i].mesh);
    for (Eigen::Index k = 0; k < 3; ++k) {
      packed.add_signed(box.isEmpty() ? 0
                                      : steps(static_cast<double>(box.min()[k]), kMillimetre_m));
      packed.add_signed(box.isEmpty() ? 0
                                      : steps(static_cast<double>(box.sizes()[k]), kMillimetre_m));
    }
  }
}

/// Kinds of obstacles, each once, and of each obstacle the index of its own.
struct Kinds {
  std::vector<std::string> names;
  std::vector<std::int64_t> of_obstacle;
};

Kinds kinds_of(const World& world) {
  Kinds kinds;
  for (const Obstacle& obstacle : world.obstacles) {
    const std::size_t place = place_in(kinds.names, obstacle.kind).value_or(kinds.names.size());
    kinds.of_obstacle.push_back(static_cast<std::int64_t>(place));
    if (place == kinds.names.size()) kinds.names.push_back(obstacle.kind);
  }
  return kinds;
}

void add_instances(const World& world, const Kinds& kinds, Packed& packed) {
  std::vector<std::int64_t> prototypes, obstacles, kind, scale;
  std::array<std::vector<std::int64_t>, 3> place;
  std::array<std::vector<std::int64_t>, 4> turn;
  for (const Instance& instance : world.instances) {
    prototypes.push_back(instance.prototype);
    obstacles.push_back(instance.obstacle);
    kind.push_back(kinds.of_obstacle[instance.obstacle]);
    const Eigen::Matrix3d linear = instance.T_world_prototype.linear().cast<double>();
    const double size = linear.col(0).norm();
    scale.push_back(steps(size, kScaleStep));
    const Eigen::Quaterniond q(Eigen::Matrix3d(linear / size));
    const std::array<double, 4> wxyz{q.w(), q.x(), q.y(), q.z()};
    for (std::size_t k = 0; k < 4; ++k) turn[k].push_back(steps(wxyz[k], 1.0 / kTurnSteps));
    for (std::size_t k = 0; k < 3; ++k) {
      place[k].push_back(
          steps(static_cast<double>(
                    instance.T_world_prototype.translation()[static_cast<Eigen::Index>(k)]),
                kMillimetre_m));
    }
  }
  for (const auto* list : {&prototypes, &obstacles, &kind, &scale}) packed.add_deltas(*list);
  for (const auto& list : place) packed.add_deltas(list);
  for (const auto& list : turn) packed.add_deltas(list);
}

ordered_json path_json(const Sway& sway) {
  return {{"kind", "sway"},
          {"amplitude", to_array(sway.amplitude_world)},
          {"period", sway.period_s},
          {"phase", sway.phase}};
}

/// Milliseconds, millimetres and thousandths of a radian: a page has hundreds of knots.
ordered_json path_json(const Route& route) {
  ordered_json knots = ordered_json::array();
  for (const Knot& knot : route.knots) {
    knots.push_back({steps(knot.time_s, 0.001), steps(knot.offset_world.x(), kMillimetre_m),
                     steps(knot.offset_world.y(), kMillimetre_m),
                     steps(knot.offset_world.z(), kMillimetre_m), steps(knot.turn_rad, 0.001)});
  }
  return {{"kind", "route"}, {"knots", std::move(knots)}};
}

ordered_json path_json(const Trefoil& knot) {
  return {{"kind", "trefoil"},       {"reach", knot.reach_m}, {"rise", knot.rise_m},
          {"period", knot.period_s}, {"phase", knot.phase},   {"heading", knot.heading_rad}};
}

ordered_json box_json(const Aabb& box) { return {to_array(box.min()), to_array(box.max())}; }

}  // namespace

std::size_t MeshStore::add(const Prototype& prototype) {
  const Eigen::AlignedBox3f box = box_of(prototype.mesh);
  std::array<std::vector<std::int64_t>, 3> places;
  for (const Eigen::Vector3f& vertex : prototype.mesh.vertices) {
    const auto place = steps_in(box, vertex);
    for (std::size_t k = 0; k < 3; ++k) places[k].push_back(place[k]);
  }
  Packed packed;
  for (const auto& axis : places) packed.add_deltas(axis);
  add_triangles(prototype, packed);
  const auto [entry, is_new] = index_of_.emplace(packed.bytes(), meshes_.size());
  if (is_new) {
    meshes_.push_back({{"vertices", prototype.mesh.vertices.size()},
                       {"triangles", prototype.mesh.triangles.size()},
                       {"data", packed.text()}});
  }
  return entry->second;
}

void MeshStore::cut(std::size_t size) {
  meshes_.erase(meshes_.begin() + static_cast<std::ptrdiff_t>(size), meshes_.end());
  std::erase_if(index_of_, [&](const auto& entry) { return entry.second >= size; });
}

ordered_json world_json(const World& world, MeshStore& meshes) {
  std::vector<std::size_t> mesh_of;
  for (const Prototype& prototype : world.prototypes) mesh_of.push_back(meshes.add(prototype));
  const Kinds kinds = kinds_of(world);
  Packed packed;
  add_prototypes(world, mesh_of, packed);
  add_instances(world, kinds, packed);
  ordered_json motions = ordered_json::array();
  for (const Motion& motion : world.motions) {
    ordered_json path = std::visit([](const auto& held) { return path_json(held); }, motion.path);
    path["instance"] = motion.instance;
    motions.push_back(std::move(path));
  }
  return {{"prototypes", world.prototypes.size()},
          {"instances", world.instances.size()},
          {"kinds", kinds.names},
          {"data", packed.text()},
          {"motions", motions},
          {"triangles", triangle_count(world)},
          {"bounds", box_json(world.bounds)},
          {"flight_bounds", box_json(world.flight_bounds)}};
}

}  // namespace avoidbench
