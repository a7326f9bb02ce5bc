#include "view/replay_panel.hpp"

#include <algorithm>
#include <cmath>

#include "view/map_plan.hpp"

namespace avoidbench {
namespace {

/// Paints each pixel as `color_at` says of the place of its middle.
template <class ColorAt>
void paint(const ColorAt& color_at, Panel& panel) {
  auto pixel = panel.picture.rgb.begin();
  for (int row = 0; row < panel.picture.height_px; ++row) {
    for (int column = 0; column < panel.picture.width_px; ++column) {
      const Color color = color_at(panel.world_at(column + 0.5, row + 0.5));
      pixel = std::copy(color.begin(), color.end(), pixel);
    }
  }
}

/// Whether OpenCV can draw to this place: its coordinates are 32-bit with fraction bits: planners
/// may draw far beyond those.
bool is_drawable(const Eigen::Vector2d& at) { return at.cwiseAbs().maxCoeff() < 1e5; }

/// Left out where either end is too far away.
void draw_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Color& color,
                  int width_px, Panel& panel) {
  const Eigen::Vector2d a = panel.to_pixels(from), b = panel.to_pixels(to);
  if (is_drawable(a) && is_drawable(b)) draw_line(panel.picture, {a, b}, color, width_px);
}

/// The part of a drawing that is far from the panel's plane, paler, or the part that is near it.
void draw_one(const Drawing& drawing, bool is_far, Panel& panel) {
  const Color own = color_of(drawing.color_rgb);
  const Color color = is_far ? mixed(own, kWhite, 0.65) : own;
  const auto fits = [&](const Eigen::Vector3d& point) {
    return (panel.distance_m(point) > kNearPlane_m) == is_far;
  };
  const std::vector<Eigen::Vector3d>& points = drawing.points_world;
  // A slip in a planner's size must not fill the picture.
  const double size_px = std::clamp(drawing.size_px, 0.0, 100.0);
  if (drawing.kind == DrawingKind::points || drawing.kind == DrawingKind::text) {
    const double diameter_px = size_px > 0.0 ? size_px : 3.0;
    for (const Eigen::Vector3d& point : points) {
      // A margin of 50 px: a disc's edge or a label may reach into the picture.
      const Eigen::Vector2d at = panel.to_pixels(point);
      const bool is_shown = fits(point) && at.x() > -50.0 && at.y() > -50.0 &&
                            at.x() < panel.picture.width_px + 50.0 &&
                            at.y() < panel.picture.height_px + 50.0;
      if (!is_shown) continue;
      draw_disc(panel.picture, at, 0.5 * diameter_px, color);
      if (drawing.kind != DrawingKind::text) continue;
      draw_label(panel.picture, ascii(drawing.label), static_cast<int>(at.x()) + 7,
                 static_cast<int>(at.y()) + 4, color);
    }
    return;
  }
  const int width_px = size_px > 0.0 ? std::max(1, static_cast<int>(std::lround(size_px))) : 2;
  // Segments are pairs of points; in a polyline each point but the first ends one and begins the
  // next.
  const std::size_t step = drawing.kind == DrawingKind::segments ? 2 : 1;
  for (std::size_t i = 0; i + 1 < points.size(); i += step) {
    if (fits(points[i])) draw_segment(points[i], points[i + 1], color, width_px, panel);
  }
}

}  // namespace

Eigen::Vector2d Panel::to_pixels(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - low_world;
  // Rows count down, `up` goes up.
  return {pixels_per_m * offset.dot(right), picture.height_px - pixels_per_m * offset.dot(up)};
}

Eigen::Vector3d Panel::world_at(double column_px, double row_px) const {
  return low_world + (right * column_px + up * (picture.height_px - row_px)) / pixels_per_m;
}

double Panel::distance_m(const Eigen::Vector3d& point) const {
  // The normal, toward whom looks at the panel.
  return std::abs((point - low_world).dot(right.cross(up)));
}

Panel make_panel(int width_px, int height_px, const Eigen::Vector3d& center,
                 const Eigen::Vector3d& right, const Eigen::Vector3d& up, double width_m) {
  Panel panel{.picture = make_picture(width_px, height_px),
              .low_world = center,
              .right = right,
              .up = up,
              .pixels_per_m = width_px / width_m};
  // From the centre to the lower left corner.
  panel.low_world -= 0.5 * (width_m * right + height_px / panel.pixels_per_m * up);
  return panel;
}

void paint_plan(const Scene& scene, double cut_z_m, Panel& panel) {
  const auto color_at = [&](const Eigen::Vector3d& at) {
    return mixed(plan_color(scene, at.x(), at.y(), cut_z_m), kWhite, 0.25);
  };
  paint(color_at, panel);
}

void paint_silhouette(const Scene& scene, const Eigen::Vector3d& center_world, double radius_m,
                      const Color& color, Panel& panel) {
  constexpr double kFar_m = 1000.0;
  const Eigen::Vector3d away = panel.right.cross(panel.up);
  const Eigen::Vector2d center = panel.to_pixels(center_world);
  const double radius_px = radius_m * panel.pixels_per_m;
  for (int row = 0; row < panel.picture.height_px; ++row) {
    for (int column = 0; column < panel.picture.width_px; ++column) {
      const Eigen::Vector2d pixel_center(column + 0.5, row + 0.5);
      // Rays are cast only for pixels that may be tinted.
      if ((pixel_center - center).norm() > radius_px) continue;
      // From so far away that all of the scene is between.
      const Eigen::Vector3d from = panel.world_at(column + 0.5, row + 0.5) + kFar_m * away;
      if (!std::isfinite(scene.first_hit(from, -away).distance_m)) continue;
      tint(panel.picture, column, row, 1, 1, color, 0.45);
    }
  }
}

void paint_below(const Scene& scene, double from_z_m, Panel& panel) {
  const double highest_m = scene.world().flight_bounds.sizes().z();
  const auto color_at = [&](const Eigen::Vector3d& at) {
    return mixed(color_below(scene, at.x(), at.y(), from_z_m, highest_m), kWhite, 0.55);
  };
  paint(color_at, panel);
}

void paint_slice(const Scene& scene, double radius_m, Panel& panel) {
  // A nearest-point query a pixel would be four times as many.
  constexpr int kBlock_px = 2;
  constexpr Color kSurface{20, 20, 20}, kNear{230, 40, 30};
  // Half of a block's diagonal is 0.71 of its side: no surface slips between two blocks.
  const double surface_m = 0.75 * kBlock_px / panel.pixels_per_m;
  const double limit_m = std::max(radius_m, surface_m);
  for (int row = 0; row < panel.picture.height_px; row += kBlock_px) {
    for (int column = 0; column < panel.picture.width_px; column += kBlock_px) {
      const Eigen::Vector3d at = panel.world_at(column + 0.5 * kBlock_px, row + 0.5 * kBlock_px);
      const double distance_m = scene.nearest(at, limit_m).distance_m;
      if (distance_m > limit_m) continue;
      const bool is_surface = distance_m < surface_m;
      tint(panel.picture, column, row, kBlock_px, kBlock_px, is_surface ? kSurface : kNear,
           is_surface ? 0.85 : 0.3);
    }
  }
}

void draw(const std::vector<Drawing>& drawings, Panel& panel) {
  // All far parts first, so that no far part of one drawing hides a near part of another.
  for (const bool is_far : {true, false}) {
    for (const Drawing& drawing : drawings) draw_one(drawing, is_far, panel);
  }
}

void draw_path(const std::vector<Eigen::Vector3d>& points, const Color& color, int width_px,
               int rim_px, Panel& panel) {
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector2d at = panel.to_pixels(point);
    // Left out, not cut there: the line goes on from its neighbours.
    if (point.allFinite() && is_drawable(at)) pixels.push_back(at);
  }
  if (pixels.size() < 2) return;
  if (rim_px > 0) draw_line(panel.picture, pixels, kWhite, width_px + 2 * rim_px);
  draw_line(panel.picture, pixels, color, width_px);
}

void draw_box(const Eigen::Vector3d& size_m, const Pose& T_world_body, const Color& color,
              Panel& panel) {
  // Corner i has bit 0 for x, bit 1 for y, bit 2 for z.
  const auto corner = [&](unsigned bits) -> Eigen::Vector3d {
    const Eigen::Vector3d sign((bits & 1U) != 0 ? 0.5 : -0.5, (bits & 2U) != 0 ? 0.5 : -0.5,
                               (bits & 4U) != 0 ? 0.5 : -0.5);
    return T_world_body * sign.cwiseProduct(size_m);
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    // Each edge once: from the corner that lacks the axis' bit to the one that has it.
    for (const unsigned axis : {1U, 2U, 4U}) {
      if ((bits & axis) == 0) draw_segment(corner(bits), corner(bits | axis), color, 2, panel);
    }
  }
}

void add_legend(const std::vector<LegendLine>& lines, Picture& picture) {
  constexpr int kRow_px = 18, kTop_px = 26, kLetter_px = 9;
  // Planners may draw hundreds of things with labels of any length.
  constexpr std::size_t kMostLines = 12, kMostLetters = 40;
  std::vector<LegendLine> shown;
  std::size_t letters = 0;
  for (const LegendLine& line : lines) {
    const std::string label = ascii(line.label).substr(0, kMostLetters);
    const bool is_there = std::any_of(shown.begin(), shown.end(), [&](const LegendLine& other) {
      return other.label == label && other.color == line.color;
    });
    if (is_there || label.empty() || shown.size() == kMostLines) continue;
    shown.push_back({line.color, label});
    letters = std::max(letters, label.size());
  }
  if (shown.empty()) return;
  tint(picture, 0, kTop_px - 4, 30 + kLetter_px * static_cast<int>(letters),
       kRow_px * static_cast<int>(shown.size()) + 6, kWhite, 0.75);
  int y = kTop_px + 7;
  for (const LegendLine& line : shown) {
    draw_disc(picture, {13.0, static_cast<double>(y)}, 4.5, line.color);
    draw_text(picture, line.label, 24, y + 5, {20, 20, 20});
    y += kRow_px;
  }
}

std::string ascii(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xC0) continue;  // inside of a letter
    plain += byte >= 0x20 && byte < 0x7F ? c : '?';
  }
  return plain;
}

Color color_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
          static_cast<std::uint8_t>(rgb)};
}

}  // namespace avoidbench
