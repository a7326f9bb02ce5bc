#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "export/flight_messages.hpp"
#include "map_file/material_looks.hpp"

namespace avoidbench {
namespace {

/// Places of the path that triangles are compared with: a few metres of a usual flight apart.
constexpr std::size_t kMostPlaces = 100;

using Corners = std::array<Eigen::Vector3f, 3>;

/// Calls `work(material, corners in the world, number)` for each triangle of what stands.
template <class Work>
void for_each_standing(const World& world, Work&& work) {
  std::set<std::uint32_t> moving;
  for (const Motion& motion : world.motions) moving.insert(motion.instance);
  std::size_t number = 0;
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    if (moving.contains(i)) continue;
    const Instance& instance = world.instances[i];
    const Prototype& prototype = world.prototypes[instance.prototype];
    for (std::size_t k = 0; k < prototype.mesh.triangles.size(); ++k) {
      Corners corners;
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] =
            instance.T_world_prototype * prototype.mesh.vertices[prototype.mesh.triangles[k][c]];
      }
      work(prototype.triangle_materials[k], corners, number++);
    }
  }
}

std::vector<Eigen::Vector3f> places_of(std::span<const Sample> samples) {
  std::vector<Eigen::Vector3f> places;
  const std::size_t step = samples.size() / kMostPlaces + 1;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    places.emplace_back(samples[i].position_world.cast<float>());
  }
  return places;
}

/// Of each triangle's middle to the nearest of the places.
std::vector<float> squared_distances(const World& world,
                                     const std::vector<Eigen::Vector3f>& places) {
  std::vector<float> distances;
  for_each_standing(world, [&](Material, const Corners& corners, std::size_t) {
    const Eigen::Vector3f middle = (corners[0] + corners[1] + corners[2]) / 3.0F;
    float least = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& place : places) {
      least = std::min(least, (place - middle).squaredNorm());
    }
    distances.push_back(least);
  });
  return distances;
}

RosColor color_of(std::size_t material) {
  // Screens show about the square root of the light.
  const std::array<float, 3>& linear = kMaterialColours[material];
  return {
      .r = std::sqrt(linear[0]), .g = std::sqrt(linear[1]), .b = std::sqrt(linear[2]), .a = 1.0F};
}

void add_corners(const Corners& corners, RosMarker& marker) {
  for (const Eigen::Vector3f& corner : corners) {
    marker.points.push_back(ros_point(corner.cast<double>()));
  }
}

/// The scale of an instance, the same along each axis.
float scale_of(const Eigen::Affine3f& T_world_prototype) {
  return T_world_prototype.linear().col(0).norm();
}

}  // namespace

RosMarker ros_marker(const std::string& frame, McapTime time, const std::string& ns,
                     std::int32_t id, MarkerType type) {
  RosMarker marker{.header = ros_header(frame, time), .ns = ns, .id = id};
  marker.type = static_cast<std::int32_t>(type);
  marker.scale = {.x = 1.0, .y = 1.0, .z = 1.0};
  marker.frame_locked = true;
  return marker;
}

RosMarkers ros_map(const World& world, McapTime time, std::span<const Sample> samples,
                   std::size_t most_triangles, std::size_t& left_out) {
  std::vector<RosMarker> by_material;
  for (std::size_t i = 0; i < kMaterials; ++i) {
    by_material.push_back(ros_marker(kMapFrame, time, kMaterialNames[i],
                                     static_cast<std::int32_t>(i), MarkerType::triangles));
    by_material.back().color = color_of(i);
  }
  std::vector<float> distances = squared_distances(world, places_of(samples));
  left_out = 0;
  float most = std::numeric_limits<float>::infinity();
  if (distances.size() > most_triangles) {
    std::vector<float> sorted = distances;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(most_triangles);
    std::nth_element(sorted.begin(), end, sorted.end());
    most = *end;
  }
  for_each_standing(world, [&](Material material, const Corners& corners, std::size_t number) {
    if (distances[number] < most) {
      add_corners(corners, by_material[static_cast<std::size_t>(material)]);
    } else {
      ++left_out;
    }
  });
  RosMarkers markers;
  for (RosMarker& marker : by_material) {
    if (!marker.points.empty()) markers.markers.push_back(std::move(marker));
  }
  return markers;
}

RosMarkers ros_movers(const World& world, McapTime time) {
  RosMarkers markers;
  for (std::size_t i = 0; i < world.motions.size(); ++i) {
    const Instance& instance = world.instances[world.motions[i].instance];
    const Prototype& prototype = world.prototypes[instance.prototype];
    RosMarker marker = ros_marker(mover_frame(i), time, world.obstacles[instance.obstacle].kind,
                                  static_cast<std::int32_t>(i), MarkerType::triangles);
    marker.color = {.r = 0.90F, .g = 0.45F, .b = 0.10F, .a = 1.0F};
    const float scale = scale_of(instance.T_world_prototype);
    for (const auto& triangle : prototype.mesh.triangles) {
      Corners corners;
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = scale * prototype.mesh.vertices[triangle[c]];
      }
      add_corners(corners, marker);
    }
    markers.markers.push_back(std::move(marker));
  }
  return markers;
}

std::vector<RosTransformStamped> ros_mover_transforms(const World& world, McapTime time) {
  std::vector<RosTransformStamped> transforms;
  for (std::size_t i = 0; i < world.motions.size(); ++i) {
    const Motion& motion = world.motions[i];
    const Eigen::Affine3f place = moved(world.instances[motion.instance].T_world_prototype, motion,
                                        1e-9 * static_cast<double>(time));
    const Eigen::Quaternionf q(Eigen::Matrix3f(place.linear() / scale_of(place)));
    transforms.push_back(ros_transform(kMapFrame, mover_frame(i), time,
                                       place.translation().cast<double>(),
                                       q.cast<double>().normalized()));
  }
  return transforms;
}

}  // namespace avoidbench
