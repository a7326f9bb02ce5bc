/* The map itself, for planners that declare AB_INPUT_WORLD; a part of planner.hpp, which includes
 * it.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_KNOWN_WORLD_HPP
#define AVOIDBENCH_KNOWN_WORLD_HPP

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "avoidbench/canvas.hpp"
#include "avoidbench/planner.h"

namespace avoidbench {

/// Asks the host for the map: see AB_WORLD_EXTENSION. Make it from the host in a constructor
/// (const ab_setup&, const ab_host&) and keep it; cheap to copy. Throws std::runtime_error if the
/// host shows no map.
class KnownWorld {
 public:
  explicit KnownWorld(const ab_host& host)
      : world_(host.get_extension == nullptr ? nullptr
                                             : static_cast<const ab_world*>(host.get_extension(
                                                   host.context, AB_WORLD_EXTENSION))) {
    if (world_ == nullptr) {
      throw std::runtime_error("the host shows no map: declare AB_INPUT_WORLD in a library");
    }
  }

  /// Distance from each place to the nearest surface, m, at most 2.5.
  std::vector<double> distances_m(const std::vector<Vec3>& places_world_m) const {
    std::vector<double> distances(places_world_m.size());
    const double* numbers = places_world_m.empty() ? nullptr : places_world_m.front().data();
    const auto count = static_cast<std::uint32_t>(places_world_m.size());
    if (world_->distances(world_->context, numbers, count, distances.data()) != AB_OK) {
      throw std::runtime_error("the host can't say how far these places are from surfaces");
    }
    return distances;
  }

  /// The shortest path of a ball of this radius from the start to the goal; empty if it has
  /// none.
  std::vector<Vec3> shortest_path_m(double radius_m) const {
    const double* numbers = nullptr;
    std::uint32_t count = 0;
    const ab_status status = world_->shortest_path(world_->context, radius_m, &numbers, &count);
    if (status == AB_ERROR) throw std::runtime_error("the host can't say the shortest path");
    std::vector<Vec3> points(status == AB_OK ? count : 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    return points;
  }

 private:
  const ab_world* world_;
};

}  // namespace avoidbench

#endif
