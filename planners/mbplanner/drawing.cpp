#include "avoidbench/planner_eigen.hpp"
#include "pilot.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kObstacles = 0x3060c0, kTree = 0xa0a0a0, kCourse = 0x20a040,
                        kStop = 0xe08020, kTrap = 0xc03030;

}  // namespace

void Pilot::draw(const avoidbench::Canvas& canvas) const {
  if (!canvas.is_wanted() || !has_begun_) return;
  const double height_m = course_.knots.front().position.z();
  std::vector<Vector3d> near;
  for (const Vector3d& center : grid_.occupied_centers()) {
    if (std::abs(center.z() - height_m) < settings_.robot_height_m) near.push_back(center);
  }
  canvas.points("occupied at this height", kObstacles, near);

  std::vector<Vector3d> edges;
  const std::vector<Vertex>& vertices = tree_.vertices();
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    edges.push_back(vertices[static_cast<std::size_t>(vertices[i].parent)].motion.position);
    edges.push_back(vertices[i].motion.position);
  }
  canvas.segments("tree", kTree, edges);

  std::vector<Vector3d> path, stop;
  for (std::size_t i = 0; i < course_.knots.size(); ++i) {
    const bool is_path = static_cast<double>(i) * kStep_s <= course_.path_s + 1e-9;
    (is_path ? path : stop).push_back(course_.knots[i].position);
  }
  canvas.line("path", kCourse, path);
  canvas.line("stop", kStop, stop);
  for (const Trap& trap : potential_.traps) {
    canvas.text("trap", kTrap, avoidbench::as_array(trap.place));
  }
}

}  // namespace mbplanner
