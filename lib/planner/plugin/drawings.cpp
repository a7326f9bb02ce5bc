#include "plugin/drawings.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace avoidbench {
namespace {

// A label without an end is read no further.
constexpr std::size_t kMostLabelBytes = 120;

std::optional<DrawingKind> kind_of(std::uint32_t kind) {
  switch (kind) {
    case AB_DRAW_POINTS:
      return DrawingKind::points;
    case AB_DRAW_LINE:
      return DrawingKind::line;
    case AB_DRAW_SEGMENTS:
      return DrawingKind::segments;
    case AB_DRAW_TEXT:
      return DrawingKind::text;
    default:
      return std::nullopt;
  }
}

/// Points that belong together: both ends of a segment.
std::size_t group_size(DrawingKind kind) { return kind == DrawingKind::segments ? 2 : 1; }

}  // namespace

DrawingBoard::DrawingBoard() {
  table_.struct_size = static_cast<std::uint32_t>(sizeof table_);
  table_.context = this;
  table_.is_wanted = [](void* context) -> std::int32_t {
    return static_cast<DrawingBoard*>(context)->is_wanted ? 1 : 0;
  };
  table_.draw = [](void* context, const ab_drawing* drawing) {
    auto& board = *static_cast<DrawingBoard*>(context);
    if (board.is_wanted && drawing != nullptr) board.draw(*drawing);
  };
}

void DrawingBoard::draw(const ab_drawing& drawing) {
  ab_drawing given{};  // an older planner's struct may be shorter
  std::memcpy(&given, &drawing, std::min<std::size_t>(drawing.struct_size, sizeof given));
  const auto kind = kind_of(given.kind);
  if (!kind || given.points_world_m == nullptr) return;
  Drawing kept{.kind = *kind,
               .color_rgb = given.color_rgb & 0xffffffU,
               .label = {},
               .size_px = std::isfinite(given.size_px) ? given.size_px : 0.0,
               .points_world = {}};
  if (given.label != nullptr) kept.label.assign(given.label, strnlen(given.label, kMostLabelBytes));
  const std::size_t group = group_size(*kind);
  const std::size_t count =
      // A text stands beside its first point; others mean nothing.
      *kind == DrawingKind::text ? std::min(given.point_count, 1U) : given.point_count;
  for (std::size_t first = 0; first + group <= count; first += group) {
    const double* xyz = given.points_world_m + 3 * first;
    const bool is_finite =
        std::all_of(xyz, xyz + 3 * group, [](double v) { return std::isfinite(v); });
    // With segments the partner goes as well: pairs must stay pairs.
    if (!is_finite) continue;
    if (point_count_ + group > kMostDrawnPoints) {
      is_full_ = true;
      break;
    }
    point_count_ += group;
    for (std::size_t i = 0; i < group; ++i, xyz += 3) {
      kept.points_world.emplace_back(xyz[0], xyz[1], xyz[2]);
    }
  }
  if (!kept.points_world.empty()) drawings_.push_back(std::move(kept));
}

std::vector<Drawing> DrawingBoard::take() {
  std::vector<Drawing> taken;
  taken.swap(drawings_);
  // The limit is one call's.
  point_count_ = 0;
  is_full_ = false;
  return taken;
}

}  // namespace avoidbench
