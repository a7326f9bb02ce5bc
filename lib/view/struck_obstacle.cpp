#include "view/struck_obstacle.hpp"

#include "explain/struck_patch.hpp"
#include "text/number_text.hpp"

namespace avoidbench {
namespace {

constexpr Color kStruck{220, 20, 30}, kRim{255, 255, 255};

}  // namespace

StruckObstacle::StruckObstacle(World struck, double contact_s, const Eigen::Vector3d& body_world,
                               const Collision& collision)
    : world(std::move(struck)),
      scene(world),
      time_s(contact_s),
      // The place of the obstacle that is nearest to the body's centre: a contact has no recorded
      // place.
      contact_world(scene.nearest(body_world).point_world),
      is_shown(collision.kind != "ground" && collision.kind != "ceiling"),
      label("touched " + ascii(collision.kind) + " " + std::to_string(collision.obstacle) + " at " +
            fixed_digits(collision.time_s, 2) + " s, " + fixed_digits(collision.speed_mps, 1) +
            " m/s") {}

std::unique_ptr<StruckObstacle> struck_obstacle(const World& world, const TrialRecord& record) {
  if (record.collisions.empty() || record.samples.empty()) return nullptr;
  const Collision& last = record.collisions.back();
  const bool is_known =
      last.obstacle >= 0 && last.obstacle < static_cast<std::int64_t>(world.obstacles.size());
  if (!is_known) return nullptr;
  World struck = alone(world, last.obstacle, last.time_s);
  if (struck.instances.empty()) return nullptr;
  return std::make_unique<StruckObstacle>(std::move(struck), last.time_s,
                                          body_pose_at(record.samples, last.time_s).translation(),
                                          last);
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
          width_px == 6 ? kRim : kStruck, width_px);
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

}  // namespace avoidbench
