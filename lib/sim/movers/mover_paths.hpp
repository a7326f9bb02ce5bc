#pragma once

#include <optional>
#include <variant>

#include "base/random.hpp"
#include "movers/mover_shapes.hpp"
#include "movers/movers.hpp"

namespace avoidbench {

/// What one mover is made in and of.
struct MoverTask {
  const Scene& map;
  const MoversSpec& spec;
  const MoverCourse& course;
  MoverShape shape;
  double speed_mps = 1.0;
};

/// Where a mover stands by its transform, and how it moves from there.
struct MoverPath {
  Eigen::Vector3d rest_world = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  std::optional<std::variant<Sway, Route, Trefoil>> path;  ///< nothing: it stands
};

/// One try; nothing where what was drawn does not fit the map or is too near to the start.
std::optional<MoverPath> try_path(const MoverTask& task, MoverMotion motion, RandomStream& draws);

}  // namespace avoidbench
