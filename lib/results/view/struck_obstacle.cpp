#include "view/struck_obstacle.hpp"

#include <algorithm>

#include "base/number_text.hpp"
#include "explain/struck_patch.hpp"

namespace avoidbench {
namespace {

constexpr Color kStruck{220, 20, 30};

}  // namespace

std::unique_ptr<StruckObstacle> struck_obstacle(const World& world, const TrialRecord& record) {
  if (record.collisions.empty() || record.samples.empty()) return nullptr;
  const Collision& last = record.collisions.back();
  const bool is_known =
      last.obstacle >= 0 && last.obstacle < static_cast<std::int64_t>(world.obstacles.size());
  if (!is_known) return nullptr;
  World own = alone(world, last.obstacle, last.time_s);
  if (own.instances.empty()) return nullptr;
  auto struck = std::make_unique<StruckObstacle>(std::move(own));
  struck->time_s = last.time_s;
  // The place that is nearest to the body's centre: a contact has no recorded place.
  const Eigen::Vector3d body_world = body_pose_at(record.samples, last.time_s).translation();
  struck->contact_world = struck->scene.nearest(body_world).point_world;
  struck->is_shown = last.kind != "ground" && last.kind != "ceiling";
  struck->label = "touched " + ascii(last.kind) + " " + std::to_string(last.obstacle) + " at " +
                  fixed_digits(last.time_s, 2) + " s, " + fixed_digits(last.speed_mps, 1) + " m/s";
  return struck;
}

void draw_struck(const StruckObstacle& struck, Panel& panel) {
  constexpr double kShown_m = 3.0, kArm_px = 7.0;
  if (struck.is_shown) {
    paint_silhouette(struck.scene, struck.contact_world, kShown_m, kStruck, panel);
  }
  const Eigen::Vector2d at = panel.to_pixels(struck.contact_world);
  // Not drawn at the border: the cross would be at a wrong place.
  const bool is_inside = at.x() >= 0.0 && at.y() >= 0.0 && at.x() < panel.picture.width_px &&
                         at.y() < panel.picture.height_px;
  if (!is_inside) return;
  // The pale rim first, the cross over it.
  for (const int width_px : {6, 3}) {
    for (const double side : {-1.0, 1.0}) {
      draw_line(
          panel.picture,
          {at + kArm_px * Eigen::Vector2d(-1.0, side), at - kArm_px * Eigen::Vector2d(-1.0, side)},
          width_px == 6 ? kWhite : kStruck, width_px);
    }
  }
  // Beside the cross, or below it where neither side has room.
  const int width_px = text_width_px(struck.label), x_px = static_cast<int>(at.x());
  const bool fits_right = panel.picture.width_px - x_px > width_px + 24;
  const bool fits_left = x_px > width_px + 24;
  const int left_px = fits_right ? x_px + 16 : x_px - width_px - 16;
  const int below_px = fits_right || fits_left ? 4 : 26;
  draw_label(panel.picture, struck.label, left_px, static_cast<int>(at.y()) + below_px, kStruck);
}

bool ring_struck(const StruckObstacle& struck, const CameraSetup& camera, const Pose& T_world_body,
                 double scale, Picture& image) {
  constexpr double kLeast_px = 8.0;
  const Eigen::Vector3d p = (T_world_body * camera.T_body_camera).inverse() * struck.contact_world;
  if (!struck.is_shown || p.z() <= 0.0) return false;
  // Pixel centres are whole in the camera, and the picture begins half a pixel before the first.
  const Eigen::Vector2d at(scale * (camera.fx_px * p.x() / p.z() + camera.cx_px + 0.5),
                           scale * (camera.fy_px * p.y() / p.z() + camera.cy_px + 0.5));
  const double radius_px = std::max(kLeast_px, scale * camera.fx_px * kPatchRadius_m / p.z());
  // From just before the contact the ring would be around the whole image.
  const bool is_inside = at.x() >= 0.0 && at.y() >= 0.0 && at.x() < image.width_px &&
                         at.y() < image.height_px && radius_px < image.width_px;
  if (!is_inside) return false;
  draw_circle(image, at, radius_px, kWhite, 5);
  draw_circle(image, at, radius_px, kStruck, 2);
  return true;
}

}  // namespace avoidbench
