#include "maps/file_maps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/digest.hpp"
#include "base/input_file.hpp"
#include "base/number_text.hpp"
#include "base/poll.hpp"
#include "map_file/map_file.hpp"
#include "map_file/mesh_file.hpp"
#include "map_file/point_cloud_file.hpp"
#include "map_file/voxel_surface.hpp"
#include "world/scenery.hpp"

namespace avoidbench {
namespace {

constexpr std::uint64_t kMostTriangles = 5'000'000;  // half a gigabyte in each worker
constexpr std::size_t kFewestPoints = 10;
constexpr double kMostExtent_m = 2000.0, kLeastExtent_m = 1.0;
constexpr double kMostCoordinate_m = 10'000.0;  // single precision is finer than 1 mm up to there
constexpr double kLeastBounds_m = 1.0;
constexpr std::size_t kComparedPerPoll = 1024;

std::string number(double value) { return significant_digits(value + 0.0, 6); }  // no "-0"

std::string text_of(const Eigen::Vector3d& v) {
  return "[" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + "]";
}

std::string size_text(const Eigen::Vector3d& size) {
  return number(size.x()) + " × " + number(size.y()) + " × " + number(size.z()) + " m";
}

Eigen::Vector3d corner(const std::vector<double>& v) { return {v.at(0), v.at(1), v.at(2)}; }

Aabb box_of(const BoxSpec& box) { return {corner(box.lowest_m), corner(box.highest_m)}; }

/// Whether both corners are there and in order; else says what is wrong.
bool check_box(const std::string& name, const BoxSpec& box, std::vector<std::string>& problems) {
  if (!box.is_given()) return false;
  const std::size_t before = problems.size();
  for (const auto* values : {&box.lowest_m, &box.highest_m}) {
    const std::string field = name + (values == &box.lowest_m ? ".lowest_m" : ".highest_m");
    if (values->size() != 3) problems.push_back(field + ": expected [x, y, z]");
    for (const double value : *values) {
      // Not "greater", so that NaN is refused.
      if (!(std::abs(value) <= kMostCoordinate_m)) {
        problems.push_back(field + ": " + number(value) + " is outside [-10000, 10000]");
      }
    }
  }
  if (problems.size() > before) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.lowest_m[axis] <= box.highest_m[axis]) continue;
    problems.push_back(name + ".highest_m: is below lowest_m along " + "xyz"[axis]);
    return false;
  }
  return true;
}

/// What can be said of the spec alone, without its file.
template <class FileSpec>
void check_fields(const FileSpec& spec, const std::vector<std::string>& extensions,
                  std::vector<std::string>& problems) {
  std::string known;
  for (const std::string& extension : extensions) {
    known += (known.empty() ? "" : ", ") + extension;
  }
  const std::string extension = extension_of(spec.file);
  if (spec.file.empty()) {
    problems.push_back("file: is not given; it is the map's file (" + known + ")");
  } else if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    const std::string hint(conversion_of(extension));
    problems.push_back("file: '" + extension + "' is not one of " + known +
                       (hint.empty() ? "" : ": " + hint));
  }
  if (!(spec.scale >= 1e-6 && spec.scale <= 1e6))
    problems.push_back("scale: is outside [1e-6, 1e6]");
  for (const double value : spec.origin_m) {
    if (!(std::abs(value) <= 1e8)) problems.push_back("origin_m: is outside [-1e8, 1e8]");
  }
  if (!(spec.flight_height_m >= 0.3 && spec.flight_height_m <= 1000.0)) {
    problems.push_back("flight_height_m: " + number(spec.flight_height_m) +
                       " is outside [0.3, 1000]");
  }
  const bool has_start = check_box("start_region", spec.start_region, problems);
  const bool has_goal = check_box("goal_region", spec.goal_region, problems);
  // The rest is of regions within given bounds.
  if (!check_box("bounds", spec.bounds, problems)) return;
  const Aabb bounds = box_of(spec.bounds);
  if (bounds.sizes().minCoeff() < kLeastBounds_m) {
    problems.push_back("bounds: are thinner than 1 m: " + size_text(bounds.sizes()));
  }
  if (has_start && !bounds.contains(box_of(spec.start_region))) {
    problems.push_back("start_region: is not within bounds");
  }
  if (has_goal && !bounds.contains(box_of(spec.goal_region))) {
    problems.push_back("goal_region: is not within bounds");
  }
  // The flight height is where a region lies that is not given.
  if (!(has_start && has_goal) && spec.flight_height_m >= bounds.sizes().z()) {
    problems.push_back("flight_height_m: " + number(spec.flight_height_m) +
                       " is not below the height of bounds, " + number(bounds.sizes().z()));
  }
}

/// A sweep that was read holds its file's digest: each worker must fly on that file.
template <class FileSpec>
void check_digest(const FileSpec& spec, const std::string& digest) {
  if (digest == spec.file_digest) return;
  fail_file(spec.file, "has changed: its SHA-256 is not file_digest, " + spec.file_digest);
}

template <class FileSpec>
std::string read_bytes(const FileSpec& spec) {
  std::string bytes = read_map_file(spec.file);
  if (!spec.file_digest.empty()) check_digest(spec, bytes_digest(bytes));
  return bytes;
}

/// The axes of a file whose this axis points up, turned to those of the world. No mirroring.
Eigen::Vector3d turned(UpAxis up, const Eigen::Vector3d& p) {
  if (up == UpAxis::y) return {p.x(), -p.z(), p.y()};
  if (up == UpAxis::x) return {p.y(), p.z(), p.x()};
  return p;
}

/// What turned() turns to p.
Eigen::Vector3d turned_back(UpAxis up, const Eigen::Vector3d& p) {
  if (up == UpAxis::y) return {p.x(), p.z(), -p.y()};
  if (up == UpAxis::x) return {p.z(), p.x(), p.y()};
  return p;
}

/// From the file's units and axes to the world frame.
template <class FileSpec>
Eigen::Vector3d in_world(const FileSpec& spec, const Eigen::Vector3d& p) {
  const Eigen::Vector3d origin(spec.origin_m[0], spec.origin_m[1], spec.origin_m[2]);
  return spec.scale * turned(spec.up_axis, p) - origin;
}

template <class FileSpec>
void to_world(const FileSpec& spec, FilePoints& points) {
  for (Eigen::Vector3d& p : points) p = in_world(spec, p);
}

Aabb box_around(const FilePoints& points) {
  Aabb box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  return box;
}

double farthest_m(const Aabb& box) {
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

/// Throws where the box is no map's in metres; `hint` is what else may help where it is too large.
void check_extent(const std::string& file, const Aabb& box, const std::string& hint) {
  const Eigen::Vector3d size = box.sizes();
  const std::string found = "spans " + size_text(size);
  // Also refuses what became infinite by scaling.
  if (!(size.maxCoeff() <= kMostExtent_m)) {
    fail_file(file, found +
                        ", more than 2000 m: if its unit is not the metre, set scale (0.001 for "
                        "millimetres, 0.01 for centimetres, 0.3048 for feet)" +
                        hint);
  }
  if (size.maxCoeff() < kLeastExtent_m) {
    fail_file(file, found + ", less than 1 m: set scale, the metres in one unit of the file");
  }
  // After the size: a wrong scale moves a map far away, too.
  if (farthest_m(box) > kMostCoordinate_m) {
    const Eigen::Vector3d whole = box.min().array().floor();
    const std::string origin = "[" + significant_digits(whole.x(), 12) + ", " +
                               significant_digits(whole.y(), 12) + ", " +
                               significant_digits(whole.z(), 12) + "]";
    fail_file(file,
              "lies more than 10 km from its origin, at " + origin + ": set origin_m near there");
  }
}

/// The share of the box that the bounds hold.
double share_within(const Aabb& bounds, const Aabb& box) {
  const Aabb common = bounds.intersection(box);
  if (common.isEmpty()) return 0.0;
  double share = 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    // A flat map has no thickness to share.
    const double size = box.sizes()[axis];
    if (size > 0.0) share *= common.sizes()[axis] / size;
  }
  return share;
}

/// Throws where all says that another axis of the file points up: with given bounds, that they hold
/// the map only if so; without, that the map is far higher than the way along y is long. `box` is
/// that of the map in the world frame.
template <class FileSpec>
void check_up_axis(const FileSpec& spec, const Aabb& box) {
  constexpr double kAtMost = 0.1, kAtLeast = 0.5, kFarHigher = 3.0;
  const std::string now(text(spec.up_axis));
  const Eigen::Vector3d size = box.sizes();
  if (!spec.bounds.is_given()) {
    if (!(size.z() > kFarHigher * size.y())) return;
    const std::string other = spec.up_axis == UpAxis::y ? "z" : "y";
    fail_file(spec.file, "spans " + size_text(size) +
                             ", far higher than it is long, with up_axis: " + now +
                             ": if the file's " + other + " axis points up" +
                             (other == "y" ? ", as in most glTF and OBJ files," : "") +
                             " set up_axis: " + other + ", else give bounds");
  }
  const Aabb bounds = box_of(spec.bounds);
  // The bounds hold a part of it: the axis may well be right.
  if (share_within(bounds, box) > kAtMost) return;
  const Eigen::Vector3d origin(spec.origin_m[0], spec.origin_m[1], spec.origin_m[2]);
  for (const auto& [up, name] : EnumText<UpAxis>::entries) {
    Aabb other;
    for (const Eigen::Vector3d& p : {box.min(), box.max()}) {
      // Back to the file's axes, then as the other axis would turn them.
      other.extend(turned(up, turned_back(spec.up_axis, p + origin)) - origin);
    }
    if (share_within(bounds, other) < kAtLeast) continue;
    fail_file(spec.file, "is hardly within bounds with up_axis: " + now + ": it spans " +
                             text_of(box.min()) + " to " + text_of(box.max()) +
                             " m; with up_axis: " + std::string(name) + " it fits, so set that");
  }
}

/// A band along x at one end of y, at the flight height.
Region band(const Aabb& bounds, double flight_height_m, bool is_goal) {
  const Eigen::Vector3d size = bounds.sizes();
  // As in forests and halls, scaled to the size of the map.
  const double side_m = std::min(2.0, 0.1 * size.x());
  const double depth_m = size.y() * (6.0 / 40.0);
  const double wall_m = std::min(1.0, 0.25 * depth_m);
  const double z = bounds.min().z() + flight_height_m;
  const double near_m = is_goal ? bounds.max().y() - depth_m : bounds.min().y() + wall_m;
  const double far_m = is_goal ? bounds.max().y() - wall_m : bounds.min().y() + depth_m;
  return {{bounds.min().x() + side_m, near_m, z}, {bounds.max().x() - side_m, far_m, z}};
}

/// Fails where a region that was given, or the usual one, is not within the bounds.
Region region_of(const std::string& file, const std::string& name, const BoxSpec& given,
                 const Aabb& bounds, double flight_height_m) {
  Region region = band(bounds, flight_height_m, name == "goal_region");
  if (given.is_given()) region = {corner(given.lowest_m), corner(given.highest_m)};
  const Aabb box(region.lowest, region.highest);
  if (!bounds.contains(box)) {
    fail_file(file, name + ": " + text_of(region.lowest) + " to " + text_of(region.highest) +
                        " is not within the bounds, " + text_of(bounds.min()) + " to " +
                        text_of(bounds.max()));
  }
  return region;
}

template <class FileSpec>
void set_bounds(const FileSpec& spec, const Aabb& own_box, World& world) {
  world.bounds = spec.bounds.is_given() ? box_of(spec.bounds) : own_box;
  if (world.bounds.sizes().minCoeff() < kLeastBounds_m) {
    fail_file(spec.file, "its own box is only " + size_text(own_box.sizes()) + ": give bounds");
  }
  world.flight_bounds = world.bounds;
  world.start_region =
      region_of(spec.file, "start_region", spec.start_region, world.bounds, spec.flight_height_m);
  world.goal_region =
      region_of(spec.file, "goal_region", spec.goal_region, world.bounds, spec.flight_height_m);
}

/// The triangles with equal vertices made one, without those of no area, as seen from `foot`.
Prototype welded(const MeshPart& part, const Eigen::Vector3d& foot) {
  std::vector<Eigen::Vector3f> all;
  all.reserve(part.vertices.size());
  for (const Eigen::Vector3d& vertex : part.vertices) {
    all.push_back((vertex - foot).cast<float>() + Eigen::Vector3f::Zero());  // -0 becomes 0
  }
  std::vector<std::uint32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0U);
  std::size_t compared = 0;
  // Equal vertices stand together when sorted; stable, so that the first in the file stands for
  // them.
  const auto key = [&](std::uint32_t i) { return std::tuple(all[i].x(), all[i].y(), all[i].z()); };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (++compared % kComparedPerPoll == 0) poll_caller();
    return key(a) < key(b);
  });
  std::vector<std::uint32_t> first(all.size());  // the first vertex at the same place
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && all[order[i]] == all[order[i - 1]];
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  Prototype prototype;
  prototype.name = part.kind;
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> index(all.size(), kUnused);
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    poll_caller();
    const auto& [a, b, c] = part.triangles[i];
    const Eigen::Vector3d from = all[a].cast<double>();
    // Exactly no area: thin triangles are real.
    if ((all[b].cast<double>() - from).cross(all[c].cast<double>() - from).isZero(0.0)) continue;
    std::array<std::uint32_t, 3> corners{first[a], first[b], first[c]};
    for (std::uint32_t& corner_index : corners) {
      std::uint32_t& used = index[corner_index];
      // Vertices that only triangles without area used are left out.
      if (used == kUnused) {
        used = static_cast<std::uint32_t>(prototype.mesh.vertices.size());
        prototype.mesh.vertices.push_back(all[corner_index]);
      }
      corner_index = used;
    }
    prototype.mesh.triangles.push_back(corners);
    prototype.triangle_materials.push_back(part.materials[i]);
  }
  return prototype;
}

/// Adds the part as an obstacle that stands at the middle of its foot.
void add_part(const MeshPart& part, World& world) {
  const Aabb box = box_around(part.vertices);
  const Eigen::Vector3d middle(box.center().x(), box.center().y(), box.min().z());
  const Eigen::Vector3d foot = (middle * 64.0).array().floor() / 64.0;  // exact in single precision
  Prototype prototype = welded(part, foot);
  if (prototype.mesh.triangles.empty()) return;
  Instance instance;
  instance.prototype = static_cast<std::uint32_t>(world.prototypes.size());
  instance.obstacle = static_cast<std::uint32_t>(world.obstacles.size());
  instance.T_world_prototype.translation() = foot.cast<float>();
  Obstacle obstacle;
  obstacle.kind = part.kind;
  obstacle.position_world = foot;
  if (!is_scenery(part.kind)) obstacle.width_m = std::max(box.sizes().x(), box.sizes().y());
  world.prototypes.push_back(std::move(prototype));
  world.instances.push_back(instance);
  world.obstacles.push_back(std::move(obstacle));
}

void set_mean_width(World& world) {
  double sum_m = 0.0, count = 0.0;
  for (const Obstacle& obstacle : world.obstacles) {
    if (is_scenery(obstacle.kind)) continue;
    sum_m += obstacle.width_m;
    count += 1.0;
  }
  if (count > 0.0) world.mean_obstacle_width_m = sum_m / count;
}

/// Points counted, and the box around them.
struct Extent {
  std::uint64_t count = 0;
  Aabb box;

  void add(const Eigen::Vector3d& point) {
    ++count;
    box.extend(point);
  }
};

/// Those in the world frame, and those of them within the bounds.
struct CloudExtent {
  Extent all, within;
};

/// Whether the point is within the bounds, where these are given; one on a high face would fill the
/// voxel behind it.
bool is_within(const PointCloudSpec& spec, const Eigen::Vector3d& point) {
  if (!spec.bounds.is_given()) return true;
  const Aabb bounds = box_of(spec.bounds);
  return bounds.contains(point) && !(point.array() == bounds.max().array()).any();
}

void check_extent(const PointCloudSpec& spec, const CloudExtent& extent) {
  const auto& [all, within] = extent;
  if (all.count < kFewestPoints) {
    fail_file(spec.file, "has " + std::to_string(all.count) +
                             (all.count == 1 ? " point that is" : " points that are") +
                             " finite; a map needs 10 at least");
  }
  if (within.count < kFewestPoints) {
    fail_file(spec.file, "has " + std::to_string(within.count) +
                             " points within bounds; its points span " + text_of(all.box.min()) +
                             " to " + text_of(all.box.max()) +
                             " m (scale, up_axis and origin_m applied)");
  }
  // Of those within: stray points out of the bounds do no harm.
  check_extent(spec.file, within.box, "; stray points: give bounds");
}

/// Throws where voxels of the map would lie between those of the octree. Returns what is to be
/// added to all points: where origin_m puts the octree's centres on the faces of the map's voxels,
/// rounding would choose a side for each.
Eigen::Vector3d octree_shift(const PointCloudSpec& spec, double octree_m) {
  constexpr double kSame = 1e-6;
  const double ratio = octree_m / spec.resolution_m;
  if (ratio > 1.0 + kSame) {
    fail_file(spec.file, "has voxels of " + number(octree_m) + " m: resolution_m " +
                             number(spec.resolution_m) +
                             " would leave gaps between them; set it to " + number(octree_m) +
                             " or coarser");
  }
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  // In coarser voxels there is another centre, farther from the faces.
  if (ratio < 1.0 - kSame) return shift;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = 0.5 - spec.origin_m[axis] / spec.resolution_m;  // of a centre, in voxels
    if (std::abs(place - std::round(place)) < 1e-3) {
      shift[static_cast<Eigen::Index>(axis)] = 0.25 * spec.resolution_m;
    }
  }
  return shift;
}

/// The cloud's points within the bounds, in the world frame, of a file that is read whole.
FilePoints whole_cloud(const PointCloudSpec& spec) {
  const std::string bytes = read_bytes(spec);
  FilePoints points = parse_point_cloud(bytes, spec.file);
  to_world(spec, points);
  if (is_octree(bytes)) {
    const double octree_m = spec.scale * octree_resolution(bytes, spec.file);
    const Eigen::Vector3d shift = octree_shift(spec, octree_m);
    for (Eigen::Vector3d& p : points) p += shift;
  }
  CloudExtent extent;
  for (const Eigen::Vector3d& p : points) extent.all.add(p);
  std::erase_if(points, [&](const Eigen::Vector3d& p) { return !is_within(spec, p); });
  for (const Eigen::Vector3d& p : points) extent.within.add(p);
  check_extent(spec, extent);
  return points;
}

[[noreturn]] void fail_voxels(const PointCloudSpec& spec) {
  fail_file(spec.file, "has points in more than " + std::to_string(kMostVoxels) + " voxels of " +
                           number(spec.resolution_m) +
                           " m: set resolution_m coarser, or bounds to the part that is flown in");
}

/// As whole_cloud(), a point for each voxel, of a LAS file that may be larger than the memory.
FilePoints sieved_cloud(const PointCloudSpec& spec) {
  InputFile input(spec.file, kMostFileBytes);
  Digest digest;
  const auto read = [&](std::span<char> bytes) {
    const std::size_t count = input.read(bytes);
    if (!spec.file_digest.empty()) digest.add_bytes(std::as_bytes(bytes.first(count)));
    return count;
  };
  CloudExtent extent;
  VoxelSieve sieve(spec.resolution_m, kMostVoxels);
  read_las_points(read, spec.file, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = in_world(spec, point);
    extent.all.add(p);
    if (!is_within(spec, p)) return;
    extent.within.add(p);
    // Else the extent is refused at the end, and the point may have no voxel.
    const Aabb& box = extent.within.box;
    const bool is_map =
        box.sizes().maxCoeff() <= kMostExtent_m && farthest_m(box) <= kMostCoordinate_m;
    if (is_map && !sieve.add(p)) fail_voxels(spec);
  });
  if (!spec.file_digest.empty()) {
    std::array<char, 4096> rest{};
    while (read(rest) == rest.size()) {
    }
    check_digest(spec, digest.hex());
  }
  check_extent(spec, extent);
  FilePoints points = sieve.centres();
  if (points.empty()) fail_voxels(spec);
  return points;
}

FilePoints cloud_points(const PointCloudSpec& spec) {
  const std::string begin = first_bytes(spec.file, 32);
  if (is_las(begin)) return sieved_cloud(spec);
  if (is_octree(begin) && std::filesystem::file_size(spec.file) > kMostOctreeBytes) {
    fail_file(spec.file,
              "is larger than " + std::to_string(kMostOctreeBytes / 1'000'000) +
                  " MB, the most for an octree: make its voxels larger or cut out a part first");
  }
  return whole_cloud(spec);
}

/// A resolution at which the surface should have few enough triangles, two digits.
double coarser_m(double resolution_m, std::uint64_t triangles) {
  // Surfaces grow with the square of the resolution; 5 % more, since the guess is rough.
  const double ratio = static_cast<double>(triangles) / static_cast<double>(kMostTriangles);
  return std::ceil(resolution_m * std::sqrt(ratio) * 1.05 * 100.0) / 100.0;
}

}  // namespace

void find_problems(const MeshSpec& spec, std::vector<std::string>& problems) {
  check_fields(spec, mesh_endings(), problems);
}

void find_problems(const PointCloudSpec& spec, std::vector<std::string>& problems) {
  check_fields(spec, cloud_endings(), problems);
  if (!(spec.resolution_m >= 0.01 && spec.resolution_m <= 10.0)) {
    problems.push_back("resolution_m: " + number(spec.resolution_m) + " is outside [0.01, 10]");
  }
}

World make_mesh(const MeshSpec& spec) {
  std::vector<MeshPart> parts =
      parse_mesh(read_bytes(spec), spec.file, spec.material, kMostTriangles);
  Aabb box;
  for (MeshPart& part : parts) {
    to_world(spec, part.vertices);
    box.extend(box_around(part.vertices));
  }
  check_extent(spec.file, box, "");
  check_up_axis(spec, box);
  World world;
  for (const MeshPart& part : parts) add_part(part, world);
  if (world.instances.empty()) fail_file(spec.file, "has no triangle with an area above 0");
  set_mean_width(world);
  set_bounds(spec, box, world);
  world.digest = world_digest(world);
  return world;
}

World make_point_cloud(const PointCloudSpec& spec) {
  VoxelSurface surface = voxel_surface(cloud_points(spec), spec.resolution_m, kMostTriangles);
  if (surface.mesh.triangles.empty()) {
    fail_file(spec.file, "its voxels of " + number(spec.resolution_m) + " m have " +
                             std::to_string(surface.triangle_count) + " triangles, more than " +
                             std::to_string(kMostTriangles) +
                             ": set resolution_m coarser, to about " +
                             number(coarser_m(spec.resolution_m, surface.triangle_count)));
  }
  World world;
  Prototype prototype;
  prototype.name = "cloud";
  prototype.mesh = std::move(surface.mesh);
  prototype.triangle_materials.assign(prototype.mesh.triangles.size(), spec.material);
  // Of the voxels, which reach beyond their points.
  Aabb box;
  for (const Eigen::Vector3f& vertex : prototype.mesh.vertices) box.extend(vertex.cast<double>());
  world.prototypes.push_back(std::move(prototype));
  world.instances.push_back({});
  world.obstacles.push_back({.kind = "cloud"});
  set_bounds(spec, box, world);
  world.digest = world_digest(world);
  return world;
}

}  // namespace avoidbench
