#include "maps/avoidbench_field.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/math.hpp"
#include "base/poll.hpp"
#include "maps/dotnet_random.hpp"
#include "maps/glibc_random.hpp"

namespace avoidbench {
namespace {

using Place = Eigen::Vector2f;

constexpr int kSteps = 200;  // of radii, and map seeds
// Bridson's k.
constexpr int kCandidatesPerPlace = 30;
constexpr float kPi = 3.14159274F;  // the float next to π

/// The places taken, in a grid whose cells' diagonal is the radius. A cell at (0, 0) is empty.
class PlaceGrid {
 public:
  PlaceGrid(const Place& size_m, float radius_m)
      : size_m_(size_m),
        squared_radius_(radius_m * radius_m),
        cell_m_(radius_m / static_cast<float>(std::sqrt(2.0))),
        columns_(static_cast<int>(std::ceil(size_m.x() / cell_m_))),
        rows_(static_cast<int>(std::ceil(size_m.y() / cell_m_))),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
               Place::Zero()) {}

  bool contains(const Place& place) const {
    return place.x() >= 0.0F && place.x() < size_m_.x() && place.y() >= 0.0F &&
           place.y() < size_m_.y();
  }
  void take(const Place& place) { cell(column(place), row(place)) = place; }
  bool is_free(const Place& place) {
    // A cell's diagonal is the radius: what is nearer than that is within two cells.
    const int first_column = std::max(column(place) - 2, 0);
    const int last_column = std::min(column(place) + 2, columns_ - 1);
    const int last_row = std::min(row(place) + 2, rows_ - 1);
    for (int r = std::max(row(place) - 2, 0); r <= last_row; ++r) {
      for (int c = first_column; c <= last_column; ++c) {
        const Place& taken = cell(c, r);
        const float dx = taken.x() - place.x();
        const float dy = taken.y() - place.y();
        // A place at (0, 0) itself would count as an empty cell, in the original too.
        if (taken != Place::Zero() && dx * dx + dy * dy < squared_radius_) return false;
      }
    }
    return true;
  }

 private:
  // A place just below the area's end may round to the cell after the last: the original fails.
  int column(const Place& place) const {
    return std::min(static_cast<int>(place.x() / cell_m_), columns_ - 1);
  }
  int row(const Place& place) const {
    return std::min(static_cast<int>(place.y() / cell_m_), rows_ - 1);
  }
  Place& cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }

  Place size_m_;
  float squared_radius_, cell_m_;
  int columns_, rows_;
  std::vector<Place> cells_;
};

/// A point between one and two radii around `centre`.
Place ring_point(const Place& centre, float squared_radius, DotnetRandom& random) {
  const float angle_rad = 2.0F * kPi * static_cast<float>(random.next_double());
  const float ratio = static_cast<float>(random.next_double());
  // Uniform by area: its square is uniform from r² to 4 r².
  const float distance_m = std::sqrt(ratio * 3.0F * squared_radius + squared_radius);
  const auto cosine = static_cast<float>(math::cos(static_cast<double>(angle_rad)));
  const auto sine = static_cast<float>(math::sin(static_cast<double>(angle_rad)));
  return {centre.x() + distance_m * cosine, centre.y() + distance_m * sine};
}

/// Bridson 2007 as the original has it: all in 32-bit floats, and with two integer divisions and a
/// truncation that make its first x and each chosen index 0, though a number is drawn for each.
std::vector<Place> sample(const Place& size_m, float radius_m, std::int32_t seed) {
  DotnetRandom random(seed);
  // The draws that the original makes and does not use keep the sequence in step.
  random.next(1, 100);
  // NOLINTNEXTLINE(bugprone-integer-division): the original's own
  const float first_x_m = static_cast<float>(random.next(1, 100) / 100) * size_m.x();
  const float first_y_m = static_cast<float>(random.next_double()) * size_m.y();

  PlaceGrid grid(size_m, radius_m);
  std::vector<Place> places{Place(first_x_m, first_y_m)};
  std::vector<Place> active = places;
  grid.take(places.front());
  while (!active.empty()) {
    poll_caller();
    random.next_double();
    // Truncation makes the chosen index 0 each time.
    const Place centre = active.front();
    bool is_found = false;
    for (int i = 0; i < kCandidatesPerPlace && !is_found; ++i) {
      const Place candidate = ring_point(centre, radius_m * radius_m, random);
      is_found = grid.contains(candidate) && grid.is_free(candidate);
      if (!is_found) continue;
      grid.take(candidate);
      places.push_back(candidate);
      active.push_back(candidate);
    }
    if (!is_found) {
      active.front() = active.back();
      active.pop_back();
    }
  }
  return places;
}

}  // namespace

AvoidbenchField make_avoidbench_field(const FieldSuite& suite, std::uint64_t number) {
  const Place size_m(static_cast<float>(suite.area_m[0]), static_cast<float>(suite.area_m[1]));
  AB_CHECK(size_m.minCoeff() > 0.0F && suite.radius_origin_m > 0.0 && suite.radius_span_m >= 0.0,
           size_m.transpose(), suite.radius_origin_m, suite.radius_span_m);
  // The lower 32 bits, as a product of two ints leaves them.
  GlibcRandom random(static_cast<std::uint32_t>(static_cast<std::uint64_t>(suite.seed) * number));
  const float ratio = static_cast<float>(random.next() % kSteps) / static_cast<float>(kSteps);
  AvoidbenchField field;
  field.radius_m =
      static_cast<float>(suite.radius_origin_m) + static_cast<float>(suite.radius_span_m) * ratio;
  field.map_seed = random.next() % kSteps;
  field.positions_m = sample(size_m, field.radius_m, field.map_seed);
  return field;
}

std::vector<double> avoidbench_size_ratios(std::int32_t map_seed, std::size_t count) {
  DotnetRandom random(map_seed);
  std::vector<double> ratios(count);
  for (double& ratio : ratios) ratio = random.next_double();
  return ratios;
}

}  // namespace avoidbench
