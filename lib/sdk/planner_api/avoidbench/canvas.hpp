/* Drawing from a planner into `avoidbench replay`; a part of planner.hpp, which includes it.
 *
 * SPDX-License-Identifier: MIT
 * Planners under any licence, including closed ones, may use this header and link with it.
 */
#ifndef AVOIDBENCH_CANVAS_HPP
#define AVOIDBENCH_CANVAS_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "avoidbench/planner.h"

namespace avoidbench {

/// A vector of three: metres, metres per second …; the variable's name gives the quantity and the
/// frame.
using Vec3 = std::array<double, 3>;

/// Whether a `Point` is three doubles x, y, z in memory and nothing else, so that Canvas takes
/// vectors of it. planner_eigen.hpp adds Eigen::Vector3d; add a vector type of your own likewise.
template <class Point>
struct IsThreeDoubles : std::false_type {};
template <>
struct IsThreeDoubles<Vec3> : std::true_type {};

/// Draws into `avoidbench replay`: see AB_DEBUG_EXTENSION. Make it from the host (in a constructor
/// (const ab_setup&, const ab_host&)) and keep it; cheap to copy. Points are in world coordinates,
/// colours 0xRRGGBB, sizes in pixels (0: the default). Calls do nothing unless is_wanted().
///
///   if (canvas_.is_wanted()) canvas_.points("obstacles", 0x2060c0, obstacles_world());
class Canvas {
 public:
  Canvas() = default;  ///< nobody looks
  explicit Canvas(const ab_host& host)
      : debug_(host.get_extension == nullptr ? nullptr
                                             : static_cast<const ab_debug*>(host.get_extension(
                                                   host.context, AB_DEBUG_EXTENSION))) {}

  /// Whether drawings are shown. Check it before computing what is only drawn; commands must not
  /// depend on it.
  bool is_wanted() const { return debug_ != nullptr && debug_->is_wanted(debug_->context) != 0; }

  /// Dots. `xyz` is 3 * count numbers.
  void points(const char* label, std::uint32_t color_rgb, const double* xyz, std::size_t count,
              double size_px = 0.0) const {
    draw(AB_DRAW_POINTS, label, color_rgb, xyz, count, size_px);
  }
  /// A polyline through all points.
  void line(const char* label, std::uint32_t color_rgb, const double* xyz, std::size_t count,
            double size_px = 0.0) const {
    draw(AB_DRAW_LINE, label, color_rgb, xyz, count, size_px);
  }
  /// A line from point 0 to 1, from 2 to 3, …
  void segments(const char* label, std::uint32_t color_rgb, const double* xyz, std::size_t count,
                double size_px = 0.0) const {
    draw(AB_DRAW_SEGMENTS, label, color_rgb, xyz, count, size_px);
  }
  /// `text` next to a point.
  void text(const char* text, std::uint32_t color_rgb, const Vec3& at_world_m) const {
    draw(AB_DRAW_TEXT, text, color_rgb, at_world_m.data(), 1, 0.0);
  }

  /// The same for vectors of Vec3, Eigen::Vector3d (planner_eigen.hpp) and similar types.
  template <class Point>
  void points(const char* label, std::uint32_t color_rgb, const std::vector<Point>& of,
              double size_px = 0.0) const {
    points(label, color_rgb, numbers(of), of.size(), size_px);
  }
  template <class Point>
  void line(const char* label, std::uint32_t color_rgb, const std::vector<Point>& of,
            double size_px = 0.0) const {
    line(label, color_rgb, numbers(of), of.size(), size_px);
  }
  template <class Point>
  void segments(const char* label, std::uint32_t color_rgb, const std::vector<Point>& of,
                double size_px = 0.0) const {
    segments(label, color_rgb, numbers(of), of.size(), size_px);
  }

 private:
  template <class Point>
  static const double* numbers(const std::vector<Point>& of) {
    static_assert(IsThreeDoubles<Point>::value, "see IsThreeDoubles");
    static_assert(sizeof(Point) == 3 * sizeof(double), "a point is three doubles");
    return reinterpret_cast<const double*>(of.data());
  }

  void draw(std::uint32_t kind, const char* label, std::uint32_t color_rgb, const double* xyz,
            std::size_t count, double size_px) const {
    if (!is_wanted()) return;
    constexpr std::size_t kMost = UINT32_MAX;
    ab_drawing drawing{};
    drawing.struct_size = static_cast<std::uint32_t>(sizeof(ab_drawing));
    drawing.kind = kind;
    drawing.color_rgb = color_rgb;
    drawing.point_count = static_cast<std::uint32_t>(std::min(count, kMost));
    drawing.points_world_m = xyz;
    drawing.size_px = size_px;
    drawing.label = label;
    debug_->draw(debug_->context, &drawing);
  }

  const ab_debug* debug_ = nullptr;
};

}  // namespace avoidbench

#endif
