#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "avoidbench/planner.h"

namespace avoidbench {

enum class DrawingKind { points, line, segments, text };

/// Something that a planner drew; see ab_drawing.
struct Drawing {
  DrawingKind kind = DrawingKind::points;
  std::uint32_t color_rgb = 0;
  std::string label;
  double size_px = 0.0;  ///< 0: a usual one
  std::vector<Eigen::Vector3d> points_world;
};

/// Of one call of the planner.
inline constexpr std::size_t kMostDrawnPoints = 200'000;

/// The host's end of AB_DEBUG_EXTENSION: keeps copies of what was drawn since take(), as long as
/// someone looks. Stays at its address.
class DrawingBoard {
 public:
  DrawingBoard();
  DrawingBoard(const DrawingBoard&) = delete;
  DrawingBoard& operator=(const DrawingBoard&) = delete;

  const ab_debug& table() const { return table_; }
  bool is_wanted = false;

  std::vector<Drawing> take();
  /// Whether something was left out since the last take() for kMostDrawnPoints.
  bool is_full() const { return is_full_; }

 private:
  void draw(const ab_drawing& drawing);

  ab_debug table_{};
  std::vector<Drawing> drawings_;
  std::size_t point_count_ = 0;
  bool is_full_ = false;
};

}  // namespace avoidbench
