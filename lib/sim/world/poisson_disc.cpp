#include "world/poisson_disc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/check.hpp"
#include "base/poll.hpp"

namespace avoidbench {
namespace {

// Bridson's own number. What is left open is filled by fill_gaps().
constexpr int kCandidatesPerPoint = 30;
// Of the radius: smaller gaps stay, in which no plant would stand.
constexpr double kSmallestGapRatio = 1e-9;

constexpr std::int64_t kBorder = 2;  // empty cells around the grid
constexpr double kNowhere = 1e100;   // coordinates of the sample of an empty cell

/// The samples, in a grid whose cells hold at most one each: a cell's diagonal is just under the
/// radius, so that samples nearer than the radius are in the 5 × 5 cells around.
class SampleGrid {
 public:
  SampleGrid(const Eigen::Vector2d& size_m, double radius_m)
      : size_m_(size_m),
        squared_radius_(radius_m * radius_m),
        // Less a hair, so that rounding never puts two samples into one cell.
        cell_m_(radius_m * std::sqrt(0.5) * (1.0 - 1e-9)),
        columns_(static_cast<std::int64_t>(std::ceil(size_m.x() / cell_m_))),
        rows_(static_cast<std::int64_t>(std::ceil(size_m.y() / cell_m_))),
        stride_(columns_ + 2 * kBorder),
        cells_(static_cast<std::size_t>(stride_ * (rows_ + 2 * kBorder)),
               Eigen::Vector2d(kNowhere, kNowhere)) {
    // Rows above and below, nearest first: most answers are near.
    for (const std::int64_t row : {0, -1, 1, -2, 2}) {
      for (const std::int64_t column : {0, -1, 1, -2, 2}) {
        steps_[steps_used_++] = row * stride_ + column;
      }
    }
  }

  const std::vector<Eigen::Vector2d>& samples() const { return samples_; }
  double cell_m() const { return cell_m_; }
  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }

  bool inside(const Eigen::Vector2d& point) const {
    return point.x() >= 0.0 && point.y() >= 0.0 && point.x() < size_m_.x() &&
           point.y() < size_m_.y();
  }
  bool occupied(std::int64_t column, std::int64_t row) const {
    return cells_[static_cast<std::size_t>(index(column, row))].x() < kNowhere;
  }
  void add(const Eigen::Vector2d& point) {
    Eigen::Vector2d& cell = cells_[static_cast<std::size_t>(index_of(point))];
    AB_CHECK(cell.x() == kNowhere);
    cell = point;
    samples_.push_back(point);
  }
  /// Whether no sample is nearer than the radius.
  bool is_free(const Eigen::Vector2d& point) const {
    return !any_sample_near(point, [&](const Eigen::Vector2d& sample) {
      return (sample - point).squaredNorm() < squared_radius_;
    });
  }
  /// Whether one sample's disc holds the whole square, whose diagonal is under the radius.
  bool covered(const Eigen::Vector2d& low, double side_m) const {
    const Eigen::Vector2d middle = low.array() + 0.5 * side_m;
    return any_sample_near(middle, [&](const Eigen::Vector2d& sample) {
      const Eigen::Vector2d farthest = (sample - middle).cwiseAbs().array() + 0.5 * side_m;
      return farthest.squaredNorm() < squared_radius_;
    });
  }

 private:
  std::int64_t index(std::int64_t column, std::int64_t row) const {
    return (row + kBorder) * stride_ + column + kBorder;
  }
  std::int64_t index_of(const Eigen::Vector2d& p) const {
    const auto column = static_cast<std::int64_t>(p.x() / cell_m_);
    const auto row = static_cast<std::int64_t>(p.y() / cell_m_);
    return index(std::clamp<std::int64_t>(column, 0, columns_ - 1),
                 std::clamp<std::int64_t>(row, 0, rows_ - 1));
  }

  template <class Predicate>
  bool any_sample_near(const Eigen::Vector2d& point, const Predicate& predicate) const {
    const std::int64_t middle = index_of(point);
    return std::any_of(steps_.begin(), steps_.end(), [&](std::int64_t step) {
      return predicate(cells_[static_cast<std::size_t>(middle + step)]);
    });
  }

  Eigen::Vector2d size_m_;
  double squared_radius_;
  double cell_m_;
  std::int64_t columns_, rows_, stride_;
  std::vector<Eigen::Vector2d> cells_;
  std::array<std::int64_t, 25> steps_{};
  std::size_t steps_used_ = 0;
  std::vector<Eigen::Vector2d> samples_;
};

/// A point of the ring between one and two radii around `centre`, uniform by area.
Eigen::Vector2d ring_point(const Eigen::Vector2d& centre, double radius_m, RandomStream& random) {
  // By trying points of the square, of which 3π/16, six in ten, are in the ring.
  Eigen::Vector2d offset;
  double squared = 0.0;
  do {
    offset.x() = random.uniform(-2.0, 2.0);
    offset.y() = random.uniform(-2.0, 2.0);
    squared = offset.squaredNorm();
  } while (squared < 1.0 || squared >= 4.0);
  return centre + radius_m * offset;
}

/// Bridson 2007.
void sample_outwards(double radius_m, const Eigen::Vector2d& first, SampleGrid& grid,
                     RandomStream& random) {
  grid.add(first);
  // Samples around which there may still be room.
  std::vector<std::size_t> active{0};
  while (!active.empty()) {
    poll_caller();
    // Any of them, as Bridson does.
    const std::size_t chosen = static_cast<std::size_t>(random.below(active.size()));
    const Eigen::Vector2d centre = grid.samples()[active[chosen]];
    bool found = false;
    for (int candidate = 0; candidate < kCandidatesPerPoint && !found; ++candidate) {
      const Eigen::Vector2d point = ring_point(centre, radius_m, random);
      found = grid.inside(point) && grid.is_free(point);
      if (!found) continue;
      active.push_back(grid.samples().size());
      grid.add(point);
    }
    if (!found) {
      // The last one takes its place: taking out costs the same however many there are.
      active[chosen] = active.back();
      active.pop_back();
    }
  }
}

/// Ebeida et al. 2012: a dart into each square that no disc covers; where it misses, the four
/// quarters are next.
void fill_gaps(const Eigen::Vector2d& size_m, double radius_m, SampleGrid& grid,
               RandomStream& random) {
  std::vector<Eigen::Vector2d> squares, quarters;
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      // The sample in it covers it whole: the cell's diagonal is under the radius.
      if (grid.occupied(column, row)) continue;
      squares.emplace_back(static_cast<double>(column) * grid.cell_m(),
                           static_cast<double>(row) * grid.cell_m());
    }
  }
  for (double side_m = grid.cell_m(); !squares.empty() && side_m > kSmallestGapRatio * radius_m;
       side_m *= 0.5) {
    quarters.clear();
    for (const Eigen::Vector2d& low : squares) {
      poll_caller();
      // One disc alone has to hold it; a square that two discs hold together is quartered until
      // they do.
      if (low.x() >= size_m.x() || low.y() >= size_m.y() || grid.covered(low, side_m)) continue;
      const double x = random.uniform(low.x(), std::min(low.x() + side_m, size_m.x()));
      const double y = random.uniform(low.y(), std::min(low.y() + side_m, size_m.y()));
      const Eigen::Vector2d dart(x, y);
      if (grid.inside(dart) && grid.is_free(dart)) {
        grid.add(dart);  // its disc covers the square
        continue;
      }
      const double half_m = 0.5 * side_m;
      quarters.push_back(low);
      quarters.emplace_back(low.x() + half_m, low.y());
      quarters.emplace_back(low.x(), low.y() + half_m);
      quarters.emplace_back(low.x() + half_m, low.y() + half_m);
    }
    squares.swap(quarters);
  }
}

}  // namespace

std::vector<Eigen::Vector2d> poisson_disc(const Eigen::Vector2d& size_m, double radius_m,
                                          RandomStream& random) {
  AB_CHECK(size_m.x() > 0.0 && size_m.y() > 0.0 && radius_m > 0.0, size_m.transpose(), radius_m);
  SampleGrid grid(size_m, radius_m);
  const double x = random.uniform(0.0, size_m.x());
  const double y = random.uniform(0.0, size_m.y());
  sample_outwards(radius_m, Eigen::Vector2d(x, y), grid, random);
  fill_gaps(size_m, radius_m, grid, random);
  return grid.samples();
}

}  // namespace avoidbench
