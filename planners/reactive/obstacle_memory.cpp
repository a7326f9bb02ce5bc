#include "obstacle_memory.hpp"

namespace reactive {
namespace {

constexpr std::size_t kEntries = 8192;  // a power of two
constexpr double kCell_m = 0.25;

/// Spreads the cell of a point over the table; two cells may share an entry, where the newer one
/// stays.
std::size_t entry_of(const Vector3& point) {
  const auto cell = [](double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / kCell_m)));
  };
  std::uint64_t hash = cell(point.x) * 0x9e3779b97f4a7c15ULL;
  hash ^= cell(point.y) * 0xc2b2ae3d27d4eb4fULL;
  hash ^= cell(point.z) * 0x165667b19e3779f9ULL;
  hash ^= hash >> 29U;
  hash *= 0xbf58476d1ce4e5b9ULL;
  return static_cast<std::size_t>(hash >> 32U) & (kEntries - 1);
}

}  // namespace

ObstacleMemory::ObstacleMemory() : entries_(kEntries) { forget(); }

void ObstacleMemory::forget() { entries_.assign(kEntries, Entry{{}, 0.0, false}); }

void ObstacleMemory::add(const Vector3& point_world, double time_s) {
  if (!is_finite(point_world) || norm(point_world) > 1e9) return;
  entries_[entry_of(point_world)] = {point_world, time_s, true};
}

void ObstacleMemory::prune(const Vector3& centre_world, double range_m, double time_s, double age_s,
                           const Sight& sight) {
  for (Entry& entry : entries_) {
    if (!entry.is_used) continue;
    const Vector3 offset = entry.point - centre_world;
    const bool stays = time_s - entry.time_s <= age_s && dot(offset, offset) <= range_m * range_m;
    if (!stays || sight.sees_through(entry.point)) entry.is_used = false;
  }
}

void ObstacleMemory::append_points(double except_time_s, std::vector<Vector3>& points_world) const {
  for (const Entry& entry : entries_) {
    if (entry.is_used && entry.time_s != except_time_s) points_world.push_back(entry.point);
  }
}

}  // namespace reactive
