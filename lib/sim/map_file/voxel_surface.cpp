#include "map_file/voxel_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/poll.hpp"

namespace avoidbench {
namespace {

/// Three indices of 21 bits fit 64: sorting numbers is far simpler than sorting triples.
constexpr unsigned kBits = 21;
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

using Cell = std::array<std::int64_t, 3>;

std::uint64_t packed(std::uint64_t high, std::uint64_t middle, std::uint64_t low) {
  return (high << (2 * kBits)) | (middle << kBits) | low;
}

std::uint64_t part(std::uint64_t key, unsigned index) { return (key >> (index * kBits)) & kMask; }

/// Rounded down, also below 0.
Cell cell_of(const Eigen::Vector3d& point, double resolution_m) {
  return {static_cast<std::int64_t>(std::floor(point.x() / resolution_m)),
          static_cast<std::int64_t>(std::floor(point.y() / resolution_m)),
          static_cast<std::int64_t>(std::floor(point.z() / resolution_m))};
}

/// The lowest index of a voxel along each axis.
Cell lowest_cell(const FilePoints& points, double resolution_m) {
  Cell lowest = cell_of(points.front(), resolution_m);
  Cell highest = lowest;
  for (const Eigen::Vector3d& point : points) {
    const Cell cell = cell_of(point, resolution_m);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lowest[axis] = std::min(lowest[axis], cell[axis]);
      highest[axis] = std::max(highest[axis], cell[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    AB_CHECK(highest[axis] - lowest[axis] < static_cast<std::int64_t>(kMask), axis);
  }
  return lowest;
}

/// Full voxels as packed (x, y, z) above `lowest`, sorted, each once.
std::vector<std::uint64_t> full_voxels(const FilePoints& points, double resolution_m,
                                       const Cell& lowest) {
  std::vector<std::uint64_t> voxels;
  voxels.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    poll_caller();
    const Cell cell = cell_of(point, resolution_m);
    voxels.push_back(packed(static_cast<std::uint64_t>(cell[0] - lowest[0]),
                            static_cast<std::uint64_t>(cell[1] - lowest[1]),
                            static_cast<std::uint64_t>(cell[2] - lowest[2])));
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

/// Faces across one axis d, as packed (d, v, u), sorted: u, v are the axes after d.
struct Faces {
  std::vector<std::uint64_t> low, high;  ///< on the voxels' low and high sides
};

Faces faces_across(const std::vector<std::uint64_t>& voxels, unsigned axis) {
  poll_caller();
  const unsigned u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<std::uint64_t> columns;  // neighbours along the axis stand beside each other
  columns.reserve(voxels.size());
  for (const std::uint64_t voxel : voxels) {
    // In the packed order the axis is the lowest part: neighbours along it differ by 1.
    columns.push_back(packed(part(voxel, 2 - v), part(voxel, 2 - u), part(voxel, 2 - axis)));
  }
  std::sort(columns.begin(), columns.end());
  Faces faces;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::uint64_t key = columns[i];
    const std::uint64_t face = packed(part(key, 0), part(key, 2), part(key, 1));
    // No neighbour: a face to the outside. The parts never carry over, since indices stay below
    // 2^21 − 1.
    if (i == 0 || columns[i - 1] + 1 != key) faces.low.push_back(face);
    if (i + 1 == columns.size() || key + 1 != columns[i + 1]) faces.high.push_back(face);
  }
  std::sort(faces.low.begin(), faces.low.end());
  std::sort(faces.high.begin(), faces.high.end());
  return faces;
}

/// Faces [u0, u1) × [v0, v1) of one layer.
struct Rectangle {
  std::uint64_t layer, u0, u1, v0, v1;
};

/// Merges neighbours along u to runs, then equal runs of rows that follow each other.
std::vector<Rectangle> merged(const std::vector<std::uint64_t>& faces) {
  std::vector<Rectangle> rectangles;
  std::vector<std::size_t> before, now;  // rectangles of the row before and of this one, by u0
  std::uint64_t row_key = ~std::uint64_t{0};
  std::size_t candidate = 0;
  for (std::size_t i = 0; i < faces.size();) {
    poll_caller();
    // Layer and row together.
    const std::uint64_t key = faces[i] >> kBits;
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end] == faces[end - 1] + 1 && faces[end] >> kBits == key) {
      ++end;
    }
    if (key != row_key) {
      // The next row of the same layer; not the first row of the next one.
      const bool follows = key == row_key + 1 && (key & kMask) != 0;
      before = follows ? std::move(now) : std::vector<std::size_t>{};
      now.clear();
      candidate = 0;
      row_key = key;
    }
    const std::uint64_t u0 = faces[i] & kMask;
    const std::uint64_t u1 = u0 + (end - i);
    // Both rows are in order of u: the candidate only moves on.
    while (candidate < before.size() && rectangles[before[candidate]].u0 < u0) ++candidate;
    const bool is_equal = candidate < before.size() && rectangles[before[candidate]].u0 == u0 &&
                          rectangles[before[candidate]].u1 == u1;
    if (is_equal) {
      // The rectangle of the row before grows by this row.
      ++rectangles[before[candidate]].v1;
      now.push_back(before[candidate]);
    } else {
      now.push_back(rectangles.size());
      const std::uint64_t v = key & kMask;
      rectangles.push_back({key >> kBits, u0, u1, v, v + 1});
    }
    i = end;
  }
  return rectangles;
}

struct Frame {
  Cell lowest;
  double resolution_m;
  unsigned axis;  ///< across the faces
  bool is_high;   ///< the faces look along +axis
};

void add_rectangle(const Rectangle& rectangle, const Frame& frame, TriangleMesh& mesh) {
  const unsigned u = (frame.axis + 1) % 3, v = (frame.axis + 2) % 3;
  const auto position = [&](unsigned axis, std::uint64_t index) {
    const std::int64_t cell = frame.lowest[axis] + static_cast<std::int64_t>(index);
    // From the whole index, not from a sum: equal corners of two faces get equal bits.
    return static_cast<float>(static_cast<double>(cell) * frame.resolution_m);
  };
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned corner = 0; corner < 4; ++corner) {
    const bool is_far_u = corner == 1 || corner == 2, is_far_v = corner >= 2;
    Eigen::Vector3f vertex;
    vertex[frame.axis] = position(frame.axis, rectangle.layer + (frame.is_high ? 1U : 0U));
    vertex[u] = position(u, is_far_u ? rectangle.u1 : rectangle.u0);
    vertex[v] = position(v, is_far_v ? rectangle.v1 : rectangle.v0);
    mesh.vertices.push_back(vertex);
  }
  // Counter-clockwise seen from the empty side.
  if (frame.is_high) {
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  } else {
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.triangles.push_back({first, first + 3, first + 2});
  }
}

}  // namespace

VoxelSurface voxel_surface(const FilePoints& points, double resolution_m,
                           std::uint64_t most_triangles) {
  VoxelSurface surface;
  if (points.empty()) return surface;
  const Cell lowest = lowest_cell(points, resolution_m);
  const std::vector<std::uint64_t> voxels = full_voxels(points, resolution_m, lowest);
  surface.voxel_count = voxels.size();
  std::array<std::vector<Rectangle>, 6> sides;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const Faces faces = faces_across(voxels, axis);
    sides[2 * axis] = merged(faces.low);
    sides[2 * axis + 1] = merged(faces.high);
    surface.triangle_count += 2 * (sides[2 * axis].size() + sides[2 * axis + 1].size());
    if (surface.triangle_count > most_triangles) sides = {};
  }
  // Only counted: the caller says how many there would be.
  if (surface.triangle_count > most_triangles) return surface;
  surface.mesh.vertices.reserve(2 * surface.triangle_count);
  surface.mesh.triangles.reserve(surface.triangle_count);
  for (unsigned side = 0; side < 6; ++side) {
    const Frame frame{lowest, resolution_m, side / 2, side % 2 == 1};
    for (const Rectangle& rectangle : sides[side]) add_rectangle(rectangle, frame, surface.mesh);
  }
  return surface;
}

namespace {

constexpr std::int64_t kMiddle = std::int64_t{1} << (kBits - 1);  // of the cells that can be packed
constexpr std::size_t kFewestUnsorted = std::size_t{1} << 20U;

}  // namespace

VoxelSieve::VoxelSieve(double resolution_m, std::size_t most_voxels)
    : resolution_m_(resolution_m), most_voxels_(most_voxels), sort_at_(kFewestUnsorted) {}

void VoxelSieve::sort() {
  std::sort(cells_.begin(), cells_.end());
  cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
  sort_at_ = cells_.size() + std::max(cells_.size(), kFewestUnsorted);
}

bool VoxelSieve::add(const Eigen::Vector3d& point) {
  const Cell cell = cell_of(point, resolution_m_);
  const auto above = [&](std::size_t axis) {
    AB_CHECK(cell[axis] >= -kMiddle && cell[axis] < kMiddle, axis);
    return static_cast<std::uint64_t>(cell[axis] + kMiddle);
  };
  const std::uint64_t packed_cell = packed(above(0), above(1), above(2));
  // Neighbours in a file are neighbours in space, mostly.
  if (!cells_.empty() && cells_.back() == packed_cell) return true;
  cells_.push_back(packed_cell);
  if (cells_.size() < sort_at_) return true;
  sort();
  return cells_.size() <= most_voxels_;
}

FilePoints VoxelSieve::centres() {
  sort();
  FilePoints points;
  if (cells_.size() > most_voxels_) return points;
  points.reserve(cells_.size());
  for (const std::uint64_t cell : cells_) {
    Eigen::Vector3d point;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const std::int64_t index = static_cast<std::int64_t>(part(cell, 2 - axis)) - kMiddle;
      point[axis] = (static_cast<double>(index) + 0.5) * resolution_m_;
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace avoidbench
