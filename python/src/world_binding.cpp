#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "base/poll.hpp"
#include "base/random.hpp"
#include "base/words.hpp"
#include "bindings.hpp"
#include "config/sweep_file.hpp"
#include "metrics/environment.hpp"
#include "sensing/camera.hpp"
#include "sweep/listed_missions.hpp"
#include "trial/map_scene.hpp"
#include "trial/mission.hpp"
#include "world/voxels.hpp"
#include "yaml/yaml_tree.hpp"

namespace nb = nanobind;

namespace avoidbench::python {
namespace {

using Eigen::Vector3d;

using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using PointsOut = nb::ndarray<double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using NumbersOut = nb::ndarray<double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using TrianglesOut = nb::ndarray<std::int32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Poses = nb::ndarray<const double, nb::shape<-1, 4, 4>, nb::c_contig, nb::device::cpu>;
using ImagesOut = nb::ndarray<float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;
using Cells = nb::ndarray<nb::numpy, bool, nb::ndim<3>>;

/// Where queries make sense: coordinates are floats in the ray tracer.
constexpr double kFarthest_m = 1e6;
constexpr double kGreatestCell_m = 1e3;
/// What rotations given as 32-bit floats may be off by.
constexpr double kRotationTolerance = 1e-5;
constexpr std::size_t kPointsPerSignalCheck = 256;

[[noreturn]] void refuse(const std::string& message) { throw nb::value_error(message.c_str()); }

/// A map with what a sweep says around it.
struct GivenMap {
  explicit GivenMap(MapChoice choice)
      : trial(std::move(choice.trial)),
        listed(missions_of(choice.missions, trial)),
        warnings(std::move(choice.warnings)),
        map(trial) {}

  TrialSpec trial;
  std::vector<Mission> listed;
  std::vector<std::string> warnings;
  MapScene map;
};

std::unique_ptr<GivenMap> make_map(MapChoice choice, std::optional<std::uint64_t> seed) {
  if (seed) choice.trial.map_seed = *seed;
  return std::make_unique<GivenMap>(std::move(choice));
}

std::unique_ptr<GivenMap> read_given_map(const std::string& given,
                                         const std::vector<std::string>& overrides,
                                         std::optional<std::uint64_t> seed) {
  const PollScope polled(check_signals);
  return make_map(read_map(given, overrides), seed);
}

std::unique_ptr<GivenMap> read_map_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides,
                                        std::optional<std::uint64_t> seed) {
  const PollScope polled(check_signals);
  const Document document{.root = parse_yaml(text, name), .file = name, .included = {}};
  return make_map(map_of_document(document, overrides), seed);
}

/// The sensor that these overrides of a sweep's key `sensor` make; read as a map's are.
CameraSpec read_sensor(const std::vector<std::string>& overrides) {
  return read_map(std::string(HallSpec::kind), overrides).trial.sensor;
}

std::array<std::array<double, 3>, 2> corners(const Aabb& box) {
  return {to_array(box.min()), to_array(box.max())};
}

Vector3d point_at(const Points& points, std::size_t i) {
  return {points(i, 0), points(i, 1), points(i, 2)};
}

void check_point(const Vector3d& point, const char* what, std::size_t i) {
  // NaN is no less than anything.
  if (point.cwiseAbs().maxCoeff() <= kFarthest_m && point.allFinite()) return;
  refuse(std::string(what) + "[" + std::to_string(i) + "] is not finite, or beyond 1e6 m");
}

/// Copies first: another thread may write to what Python passed.
Pose pose_at(const Poses& poses, std::size_t i) {
  Eigen::Matrix4d matrix;
  for (std::size_t k = 0; k < 16; ++k) {
    matrix(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) =
        poses(i, k / 4, k % 4);
  }
  const std::string name = "T_world_camera[" + std::to_string(i) + "]";
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if (!matrix.allFinite()) refuse(name + " is not finite");
  if (matrix.row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    refuse(name + ": the last row is not (0, 0, 0, 1)");
  }
  const Eigen::Matrix3d off = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  if (!(off.cwiseAbs().maxCoeff() <= kRotationTolerance) || !(rotation.determinant() > 0.0)) {
    refuse(name +
           ": the upper left 3 × 3 is no rotation: its columns must be unit vectors at "
           "right angles, right-handed");
  }
  check_point(matrix.topRightCorner<3, 1>(), "position of T_world_camera", i);
  Pose pose = Pose::Identity();
  pose.matrix() = matrix;
  return pose;
}

std::size_t vertex_count(const GivenMap& given) {
  std::size_t count = 0;
  for (const Instance& instance : given.map.world.instances) {
    count += given.map.world.prototypes[instance.prototype].mesh.vertices.size();
  }
  return count;
}

void write_mesh(const GivenMap& given, const PointsOut& vertices, const TrianglesOut& triangles) {
  const World& world = given.map.world;
  const std::size_t count = vertex_count(given);
  if (vertices.shape(0) != count || triangles.shape(0) != triangle_count(world)) {
    refuse("vertices and triangles are not of this map's sizes");
  }
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError("the map has more vertices than 32-bit triangles can name");
  }
  const Released released;
  std::size_t vertex = 0, triangle = 0;
  for (const Instance& instance : world.instances) {
    const TriangleMesh& mesh = world.prototypes[instance.prototype].mesh;
    const Eigen::Affine3d placed = instance.T_world_prototype.cast<double>();
    const std::size_t first = vertex;
    for (const Eigen::Vector3f& corner : mesh.vertices) {
      const Vector3d corner_world = placed * corner.cast<double>();
      for (std::size_t k = 0; k < 3; ++k) {
        vertices(vertex, k) = corner_world[static_cast<Eigen::Index>(k)];
      }
      ++vertex;
    }
    for (const auto& face : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        triangles(triangle, k) = static_cast<std::int32_t>(first + face[k]);
      }
      ++triangle;
    }
  }
}

void write_depth(const GivenMap& given, const CameraSpec& sensor, const Poses& T_world_camera,
                 std::uint64_t seed, const ImagesOut& depth_m) {
  const auto width = static_cast<std::size_t>(sensor.width_px);
  const auto height = static_cast<std::size_t>(sensor.height_px);
  const std::size_t count = T_world_camera.shape(0);
  if (depth_m.shape(0) != count || depth_m.shape(1) != height || depth_m.shape(2) != width) {
    refuse("the depth images are not of this sensor's size");
  }
  const Released released;
  Camera camera(sensor);
  CameraImages images;
  for (std::size_t i = 0; i < count; ++i) {
    check_signals();
    camera.expose(given.map.scene, pose_at(T_world_camera, i), {}, {.depth = true},
                  stream_seed(stream_seed(seed, "depth"), i), images);
    std::copy(images.depth_m.begin(), images.depth_m.end(), depth_m.data() + i * width * height);
  }
}

void write_nearest(const GivenMap& given, const Points& points_world, double limit_m,
                   const NumbersOut& distances_m, const PointsOut& nearest_world) {
  const std::size_t count = points_world.shape(0);
  if (distances_m.shape(0) != count || nearest_world.shape(0) != count) {
    refuse("distances and nearest points are not as many as the points");
  }
  if (!(limit_m > 0.0)) refuse("limit_m must be above 0");
  const Released released;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kPointsPerSignalCheck == 0) check_signals();
    const Vector3d point = point_at(points_world, i);
    check_point(point, "points_world", i);
    NearestPoint found = given.map.scene.nearest(point, limit_m);
    if (std::isinf(found.distance_m)) {
      found.point_world.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    distances_m(i) = found.distance_m;
    for (std::size_t k = 0; k < 3; ++k) {
      nearest_world(i, k) = found.point_world[static_cast<Eigen::Index>(k)];
    }
  }
}

std::pair<Cells, std::array<double, 3>> occupancy(const GivenMap& given, double resolution_m) {
  if (!(resolution_m > 0.0 && resolution_m <= kGreatestCell_m)) {
    refuse("resolution_m must be above 0 and at most 1000");
  }
  auto grid = std::make_unique<VoxelGrid>();
  {
    const Released released;
    *grid = surface_voxels(given.map.world, resolution_m, check_signals);
  }
  const std::array<double, 3> origin = to_array(grid->lowest_world);
  const std::size_t sizes[] = {grid->columns, grid->rows, grid->layers};
  const std::int64_t strides[] = {1, static_cast<std::int64_t>(grid->columns),
                                  static_cast<std::int64_t>(grid->columns * grid->rows)};
  std::uint8_t* cells = grid->is_occupied.data();
  const nb::capsule owner(grid.get(), [](void* p) noexcept { delete static_cast<VoxelGrid*>(p); });
  static_cast<void>(grid.release());
  return {Cells(cells, 3, sizes, owner, strides), origin};
}

using MissionRow = std::array<double, 7>;

/// Start, goal and heading of each.
std::vector<MissionRow> missions(const GivenMap& given, std::int64_t count) {
  if (count < 0 || count > 1'000'000) refuse("count must be within [0, 1000000]");
  if (!given.listed.empty() && count > static_cast<std::int64_t>(given.listed.size())) {
    refuse("the sweep lists only " + counted(given.listed.size(), "mission"));
  }
  const Released released;
  std::vector<MissionRow> rows;
  for (std::int64_t i = 0; i < count; ++i) {
    check_signals();
    const std::optional<Mission> found = the_mission(given.map.scene, given.trial, i, given.listed);
    if (!found) {
      throw InputError("mission " + std::to_string(i) +
                       ": no start or goal is free_radius_m from every surface");
    }
    const Vector3d& start = found->start_world;
    const Vector3d& goal = found->goal_world;
    rows.push_back(
        {start.x(), start.y(), start.z(), goal.x(), goal.y(), goal.z(), found->start_yaw_rad});
  }
  return rows;
}

using ObstacleRow = std::pair<std::string, std::array<double, 4>>;

/// Kind; position and width of each.
std::vector<ObstacleRow> obstacles(const GivenMap& given) {
  std::vector<ObstacleRow> rows;
  for (const Obstacle& obstacle : given.map.world.obstacles) {
    const Vector3d& at = obstacle.position_world;
    rows.push_back({obstacle.kind, {at.x(), at.y(), at.z(), obstacle.width_m}});
  }
  return rows;
}

}  // namespace

void bind_world(nb::module_& m) {
  using Unlocked = nb::call_guard<Released>;
  nb::class_<CameraSpec>(m, "Sensor", "A camera's spec.")
      .def_prop_ro("name", [](const CameraSpec& s) { return s.name; })
      .def_prop_ro("width_px", [](const CameraSpec& s) { return s.width_px; })
      .def_prop_ro("height_px", [](const CameraSpec& s) { return s.height_px; });
  m.def("read_sensor", &read_sensor, nb::arg("overrides"), Unlocked(),
        "The camera that overrides such as `sensor.width_px=64` make.");

  nb::class_<GivenMap>(m, "World", "A map and its ray tracer; see avoidbench.World.")
      .def_prop_ro("generator", [](const GivenMap& p) { return std::string(kind(p.trial.map)); })
      .def_prop_ro("seed", [](const GivenMap& p) { return p.trial.map_seed; })
      .def_prop_ro("warnings", [](const GivenMap& p) { return p.warnings; })
      .def_prop_ro("digest", [](const GivenMap& p) { return p.map.world.digest; })
      .def_prop_ro("bounds_m", [](const GivenMap& p) { return corners(p.map.world.bounds); })
      .def_prop_ro("flight_bounds_m",
                   [](const GivenMap& p) { return corners(p.map.world.flight_bounds); })
      .def_prop_ro("obstacle_count", [](const GivenMap& p) { return obstacle_count(p.map.world); })
      .def_prop_ro("vertex_count", &vertex_count)
      .def_prop_ro("triangle_count", [](const GivenMap& p) { return triangle_count(p.map.world); })
      .def("obstacles", &obstacles)
      .def("missions", &missions, nb::arg("count"))
      .def("occupancy", &occupancy, nb::arg("resolution_m"))
      .def("write_mesh", &write_mesh, nb::arg("vertices").noconvert(),
           nb::arg("triangles").noconvert())
      .def("write_depth", &write_depth, nb::arg("sensor"), nb::arg("T_world_camera").noconvert(),
           nb::arg("seed"), nb::arg("depth_m").noconvert())
      .def("write_nearest", &write_nearest, nb::arg("points_world").noconvert(), nb::arg("limit_m"),
           nb::arg("distances_m").noconvert(), nb::arg("nearest_world").noconvert());
  m.def("read_world", &read_given_map, nb::arg("given"), nb::arg("overrides"),
        nb::arg("seed").none(), Unlocked(), "The map of a generator, a file or a built-in sweep.");
  m.def("read_world_text", &read_map_text, nb::arg("text"), nb::arg("name"), nb::arg("overrides"),
        nb::arg("seed").none(), Unlocked(),
        "The map of a document in YAML; `name` stands in messages.");
}

}  // namespace avoidbench::python
