#pragma once

#include <string>
#include <vector>

#include "drawing/picture.hpp"
#include "plugin/drawings.hpp"
#include "render/scene.hpp"

namespace avoidbench {

/// A flat piece of the world as a picture. What does not lie in its plane is drawn where it is seen
/// from far away along the plane's normal.
struct Panel {
  Picture picture;
  Eigen::Vector3d low_world;  ///< the picture's lower left corner; fixes the plane too
  Eigen::Vector3d right, up;  ///< of the picture, unit, in the world
  double pixels_per_m = 1.0;

  Eigen::Vector2d to_pixels(const Eigen::Vector3d& point) const;
  Eigen::Vector3d world_at(double column_px, double row_px) const;
  double distance_m(const Eigen::Vector3d& point) const;  ///< from the plane
};

/// A panel of this size around `center`.
Panel make_panel(int width_px, int height_px, const Eigen::Vector3d& center,
                 const Eigen::Vector3d& right, const Eigen::Vector3d& up, double width_m);

inline constexpr double kNearPlane_m = 1.0;  ///< what is farther from a panel's plane is drawn pale

/// Fills the panel with the plan at this height (plan_color() of map_plan.hpp), a bit pale, so that
/// one can draw on it.
void paint_plan(const Scene& scene, double cut_z_m, Panel& panel);

/// Tints where anything of the scene is seen along the panel's normal, within `radius_m` of a
/// place.
void paint_silhouette(const Scene& scene, const Eigen::Vector3d& center_world, double radius_m,
                      const Color& color, Panel& panel);

/// Fills the panel with what lies below `from_z_m`, pale, so that one can draw on it.
void paint_below(const Scene& scene, double from_z_m, Panel& panel);

/// Blackens where surfaces cut the panel's plane, reddens what is nearer to one than `radius_m`.
void paint_slice(const Scene& scene, double radius_m, Panel& panel);

/// What a planner drew, far things below near ones.
void draw(const std::vector<Drawing>& drawings, Panel& panel);

/// A polyline of world points, with a white rim where `rim_px` is more than 0.
void draw_path(const std::vector<Eigen::Vector3d>& points, const Color& color, int width_px,
               int rim_px, Panel& panel);

/// The edges of a box.
void draw_box(const Eigen::Vector3d& size_m, const Pose& T_world_body, const Color& color,
              Panel& panel);

/// A line of a legend: a swatch and what it means.
struct LegendLine {
  Color color;
  std::string label;
};
/// At the upper left, below a caption; each line once.
void add_legend(const std::vector<LegendLine>& lines, Picture& picture);

/// `text` with ? for what is no printable ASCII: pictures have no other letters.
std::string ascii(const std::string& text);

Color color_of(std::uint32_t rgb);

}  // namespace avoidbench
