#include "planning/rolling_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avoidbench/planner_eigen.hpp"

namespace planning {
namespace {

using Eigen::Vector3d;

/// Numbers that are no cell's, NaN among them, become cells far outside.
int floored(double value) {
  constexpr double kFar = 1e9;
  if (!(value > -kFar)) return -static_cast<int>(kFar);
  if (value > kFar) return static_cast<int>(kFar);
  // The cast cuts toward zero, which is one cell too high below zero.
  const int cut = static_cast<int>(value);
  return cut - (static_cast<double>(cut) > value ? 1 : 0);
}

int wrapped(int value, int size) {
  const int rest = value % size;
  return rest < 0 ? rest + size : rest;
}

std::int16_t thousandths(double log_odds) {
  // Whole numbers: sums of log odds then depend neither on their order nor on the compiler. ±16
  // keeps two of them within 16 bits.
  return static_cast<std::int16_t>(std::lround(1000.0 * std::clamp(log_odds, -16.0, 16.0)));
}

/// The bits from..to, both included, that lie in this word.
std::uint64_t bits_between(int from, int to, int word) {
  const int low = std::max(from - 64 * word, 0), high = std::min(to - 64 * word, 63);
  if (low > high) return 0;
  return (~std::uint64_t{0} << low) & (~std::uint64_t{0} >> (63 - high));
}

}  // namespace

ab_depth_image without_border(const ab_depth_image& image, double share) {
  if (image.height_px <= 0 || image.depth_m == nullptr) return image;
  const int rows = static_cast<int>(std::clamp(share, 0.0, 0.49) * image.height_px);
  ab_depth_image inner = image;
  inner.height_px -= 2 * rows;
  inner.cy_px -= rows;
  inner.depth_m += static_cast<std::ptrdiff_t>(rows) * image.width_px;
  return inner;
}

RollingGrid::RollingGrid(const RollingGridSpec& spec) : spec_(spec) {
  hit_ = thousandths(spec.hit);
  miss_ = thousandths(spec.miss);
  lowest_ = thousandths(spec.lowest_log_odds);
  highest_ = thousandths(spec.highest_log_odds);
  occupied_above_ = thousandths(spec.occupied_above);
  unknown_ = thousandths(spec.unknown_log_odds);
  side_ = 2 * static_cast<int>(std::ceil(spec.half_size_m / spec.resolution_m));
  lowest_z_ = floored(spec.lowest_m / spec.resolution_m);
  height_ = floored(spec.highest_m / spec.resolution_m) - lowest_z_ + 1;
  words_ = (height_ + 63) / 64;
  // Less a hair, so that 0.3 m of cells of 0.1 m are three of them, not four.
  reach_ = static_cast<int>(std::ceil(spec.inflation_m / spec.resolution_m - 1e-9));
  const auto columns = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  const std::size_t words = columns * static_cast<std::size_t>(words_);
  log_odds_.assign(64 * words, unknown_);
  ends_in_.assign(64 * words, 0);
  for (auto* bits : {&known_, &occupied_, &inflated_, &settled_, &not_missed_, &passed_}) {
    bits->assign(words, 0);
  }
  swept_bits_.assign(words, 0);
  column_flags_.assign(columns, 0);
  center_at(Cell::Zero());
}

void RollingGrid::center_at(const Cell& center) {
  first_x_ = center.x() - side_ / 2;
  first_y_ = center.y() - side_ / 2;
  // The first column's place in the ring is its own number modulo the side, so that a column keeps
  // its place as long as it is inside.
  ring_x_ = wrapped(first_x_, side_);
  ring_y_ = wrapped(first_y_, side_);
}

void RollingGrid::reset(const Vector3d& center_world) {
  std::fill(log_odds_.begin(), log_odds_.end(), unknown_);
  for (auto* bits : {&known_, &occupied_, &inflated_, &settled_}) {
    std::fill(bits->begin(), bits->end(), std::uint64_t{0});
  }
  if (center_world.allFinite()) center_at(cell_of(center_world));
}

void RollingGrid::move_to(const Vector3d& center_world) {
  if (!center_world.allFinite()) return;
  const int old_x = first_x_, old_y = first_y_;
  const Cell center = cell_of(center_world);
  // In 64 bits: a centre beyond all cells must not overflow the difference.
  const std::int64_t far_x = std::int64_t{center.x()} - side_ / 2 - old_x;
  const std::int64_t far_y = std::int64_t{center.y()} - side_ / 2 - old_y;
  // Nothing of the old place is left: quicker than to forget it column by column.
  if (std::abs(far_x) >= side_ || std::abs(far_y) >= side_) {
    reset(center_world);
    return;
  }
  if (far_x == 0 && far_y == 0) return;
  // Where a surface leaves, what stays beside it changes. What comes in has surfaces beside it
  // only.
  std::vector<Eigen::Vector2i> left_behind;
  for (int x = old_x; x < old_x + side_; ++x) {
    const bool leaves = x < old_x + far_x || x >= old_x + far_x + side_;
    for (int y = old_y; y < old_y + side_; ++y) {
      if (!leaves && y >= old_y + far_y && y < old_y + far_y + side_) continue;
      if (forget_column(x, y)) left_behind.emplace_back(x, y);
    }
  }
  center_at(center);
  for (const Eigen::Vector2i& at : left_behind) {
    // Those columns are gone; what they inflated is next to them, inside.
    mark_changed(std::clamp(at.x(), first_x_, first_x_ + side_ - 1),
                 std::clamp(at.y(), first_y_, first_y_ + side_ - 1));
  }
  for (int x = first_x_; x < first_x_ + side_; ++x) {
    const bool comes_in = x < old_x || x >= old_x + side_;
    for (int y = first_y_; y < first_y_ + side_; ++y) {
      if (!comes_in && y >= old_y && y < old_y + side_) continue;
      column_flags_[column_of(x, y)] |= kInReach;
      in_reach_.emplace_back(x, y);
    }
  }
  inflate_changes();
}

Cell RollingGrid::cell_of(const Vector3d& position_world) const {
  return {floored(position_world.x() / spec_.resolution_m),
          floored(position_world.y() / spec_.resolution_m),
          floored(position_world.z() / spec_.resolution_m)};
}

Vector3d RollingGrid::center_of(const Cell& cell) const {
  return (cell.cast<double>() + Vector3d::Constant(0.5)) * spec_.resolution_m;
}

bool RollingGrid::contains(const Cell& cell) const {
  return cell.x() >= first_x_ && cell.x() < first_x_ + side_ && cell.y() >= first_y_ &&
         cell.y() < first_y_ + side_ && cell.z() >= lowest_z_ && cell.z() < lowest_z_ + height_;
}

CellState RollingGrid::state(const Cell& cell) const {
  if (!is_known(cell)) return CellState::unknown;
  return bit(occupied_, cell) ? CellState::occupied : CellState::free;
}

bool RollingGrid::is_inflated(const Cell& cell) const {
  return contains(cell) && bit(inflated_, cell);
}

std::vector<Vector3d> RollingGrid::occupied_centers() const {
  std::vector<Vector3d> centers;
  for (int x = first_x_; x < first_x_ + side_; ++x) {
    for (int y = first_y_; y < first_y_ + side_; ++y) {
      for (int z = lowest_z_; z < lowest_z_ + height_; ++z) {
        if (bit(occupied_, {x, y, z})) centers.push_back(center_of({x, y, z}));
      }
    }
  }
  return centers;
}

CellState RollingGrid::box_state(const Vector3d& center_world, const Vector3d& size_m) const {
  const Cell from = cell_of(center_world - 0.5 * size_m), to = cell_of(center_world + 0.5 * size_m);
  const int from_x = std::max(from.x(), first_x_), to_x = std::min(to.x(), first_x_ + side_ - 1);
  const int from_y = std::max(from.y(), first_y_), to_y = std::min(to.y(), first_y_ + side_ - 1);
  const int from_z = std::max(from.z(), lowest_z_) - lowest_z_;
  const int to_z = std::min(to.z(), lowest_z_ + height_ - 1) - lowest_z_;
  if (from_x > to_x || from_y > to_y || from_z > to_z) return CellState::unknown;
  std::uint64_t occupied = 0, unknown = 0;
  for (int word = from_z / 64; word <= to_z / 64; ++word) {
    const std::uint64_t mask = bits_between(from_z, to_z, word);
    for (int x = from_x; x <= to_x; ++x) {
      for (int y = from_y; y <= to_y; ++y) {
        const std::size_t at = column_start(x, y) / 64 + static_cast<std::size_t>(word);
        occupied |= occupied_[at] & mask;
        unknown |= ~known_[at] & mask;
      }
    }
  }
  if (occupied != 0) return CellState::occupied;
  // The part inside may all be free, but what lies beyond the grid is unknown.
  const bool is_inside = contains(from) && contains(to);
  return unknown == 0 && is_inside ? CellState::free : CellState::unknown;
}

/// Whether there was a surface in it.
bool RollingGrid::forget_column(int x, int y) {
  const auto words = static_cast<std::ptrdiff_t>(words_);
  const std::size_t start = column_start(x, y);
  const auto word = static_cast<std::ptrdiff_t>(start / 64);
  std::fill_n(log_odds_.begin() + static_cast<std::ptrdiff_t>(start), 64 * words, unknown_);
  std::uint64_t occupied = 0;
  for (std::ptrdiff_t w = 0; w < words; ++w)
    occupied |= occupied_[start / 64 + static_cast<std::size_t>(w)];
  for (auto* bits : {&known_, &occupied_, &inflated_, &settled_}) {
    std::fill_n(bits->begin() + word, words, std::uint64_t{0});
  }
  return occupied != 0;
}

/// The inflation of this column and its neighbours is to be found again.
void RollingGrid::mark_changed(int x, int y) {
  std::uint8_t& flags = column_flags_[column_of(x, y)];
  if ((flags & kChanged) != 0) return;
  flags |= kChanged;
  changed_.emplace_back(x, y);
}

/// The inflation of columns within reach of a change is found again, first along y, then along x
/// and z.
void RollingGrid::inflate_changes() {
  const auto words = static_cast<std::size_t>(words_);
  const auto first_of = [&](int value, int first) { return std::max(value - reach_, first); };
  const auto last_of = [&](int value, int first) {
    return std::min(value + reach_, first + side_ - 1);
  };
  const auto gather = [&](int x, int y, std::uint8_t flag, std::vector<Eigen::Vector2i>& list) {
    std::uint8_t& flags = column_flags_[column_of(x, y)];
    if ((flags & flag) != 0) return;
    flags |= flag;
    list.emplace_back(x, y);
  };
  // A box is grown one axis after the other: a cell is inflated if an occupied one lies within
  // reach along y, then along x, then along z. So each pass costs the reach, not its cube. The list
  // grows while it is walked, by columns within reach along y; its first `count` are those that
  // changed.
  for (std::size_t i = 0, count = changed_.size(); i < count; ++i) {
    const Eigen::Vector2i at = changed_[i];
    for (int y = first_of(at.y(), first_y_); y <= last_of(at.y(), first_y_); ++y) {
      gather(at.x(), y, kChanged, changed_);
    }
  }
  for (const Eigen::Vector2i& at : changed_) {
    for (int x = first_of(at.x(), first_x_); x <= last_of(at.x(), first_x_); ++x) {
      gather(x, at.y(), kInReach, in_reach_);
    }
  }
  for (const Eigen::Vector2i& at : in_reach_) {
    for (int x = first_of(at.x(), first_x_); x <= last_of(at.x(), first_x_); ++x) {
      gather(x, at.y(), kSwept, swept_);
    }
  }
  for (const Eigen::Vector2i& at : swept_) {
    std::uint64_t* to = &swept_bits_[column_of(at.x(), at.y()) * words];
    std::fill_n(to, words, std::uint64_t{0});
    for (int y = first_of(at.y(), first_y_); y <= last_of(at.y(), first_y_); ++y) {
      const std::uint64_t* from = &occupied_[column_of(at.x(), y) * words];
      for (std::size_t w = 0; w < words; ++w) to[w] |= from[w];
    }
  }
  for (const Eigen::Vector2i& at : in_reach_) {
    std::uint64_t* to = &inflated_[column_of(at.x(), at.y()) * words];
    std::fill_n(to, words, std::uint64_t{0});
    for (int x = first_of(at.x(), first_x_); x <= last_of(at.x(), first_x_); ++x) {
      const std::uint64_t* from = &swept_bits_[column_of(x, at.y()) * words];
      for (std::size_t w = 0; w < words; ++w) to[w] |= from[w];
    }
    grow_along_z(to);
  }
  for (const auto* list : {&changed_, &in_reach_, &swept_}) {
    for (const Eigen::Vector2i& at : *list) column_flags_[column_of(at.x(), at.y())] = 0;
  }
  changed_.clear();
  in_reach_.clear();
  swept_.clear();
}

/// One cell up and down at a time.
void RollingGrid::grow_along_z(std::uint64_t* column) const {
  const auto words = static_cast<std::size_t>(words_);
  for (int step = 0; step < reach_; ++step) {
    std::uint64_t below = 0;
    for (std::size_t w = 0; w < words; ++w) {
      const std::uint64_t at = column[w], above = w + 1 < words ? column[w + 1] : 0;
      // The neighbours of a word's first and last cell are in the words before and behind; `below`
      // is the word before as it was.
      column[w] = at | at << 1U | at >> 1U | below >> 63U | above << 63U;
      below = at;
    }
  }
}

void RollingGrid::clear_box(const Vector3d& center_world, const Vector3d& size_m) {
  const Cell from = cell_of(center_world - 0.5 * size_m), to = cell_of(center_world + 0.5 * size_m);
  const int to_x = std::min(to.x(), first_x_ + side_ - 1);
  const int to_y = std::min(to.y(), first_y_ + side_ - 1);
  const int from_z = std::max(from.z(), lowest_z_) - lowest_z_;
  const int to_z = std::min(to.z(), lowest_z_ + height_ - 1) - lowest_z_;
  if (from_z > to_z) return;
  for (int x = std::max(from.x(), first_x_); x <= to_x; ++x) {
    for (int y = std::max(from.y(), first_y_); y <= to_y; ++y) {
      const std::size_t start = column_start(x, y);
      for (int z = from_z; z <= to_z; ++z) log_odds_[start + static_cast<std::size_t>(z)] = lowest_;
      for (int word = from_z / 64; word <= to_z / 64; ++word) {
        const std::size_t at = start / 64 + static_cast<std::size_t>(word);
        const std::uint64_t mask = bits_between(from_z, to_z, word);
        known_[at] |= mask;
        settled_[at] |= mask;
        if ((occupied_[at] & mask) == 0) continue;
        occupied_[at] &= ~mask;
        mark_changed(x, y);
      }
    }
  }
  inflate_changes();
}

std::uint8_t place_of(const RollingGrid& grid, const std::array<double, 3>& place_world) {
  const Eigen::Vector3d place(place_world[0], place_world[1], place_world[2]);
  if (!is_place(place)) return AB_PLACE_UNKNOWN;
  const Cell cell = grid.cell_of(place);
  if (!grid.contains(cell)) return AB_PLACE_UNKNOWN;
  switch (grid.state(cell)) {
    case CellState::occupied:
      return AB_PLACE_OCCUPIED;
    case CellState::free:
      return AB_PLACE_FREE;
    case CellState::unknown:
      break;
  }
  return AB_PLACE_UNKNOWN;
}

}  // namespace planning
