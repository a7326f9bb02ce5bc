#include "view/film.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "base/number_text.hpp"
#include "shading/shading.hpp"
#include "trial/goals.hpp"
#include "trial/planner_view.hpp"
#include "view/map_plan.hpp"
#include "view/map_views.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kBehind_m = 2.6, kAbove_m = 0.9, kLookAhead_m = 1.5;
constexpr double kChaseFov_deg = 80.0;
constexpr int kChaseWidth_px = 2 * (kFilmWidth_px / 3);
constexpr int kSideWidth_px = kFilmWidth_px - kChaseWidth_px;
constexpr double kTurning_s = 0.5;     // time in which the camera follows a turn
constexpr double kFilmEnd_s = 1.0;     // the last frame stays so long
constexpr double kFilmMargin_m = 6.0;  // shown around the path from above, both sides together
constexpr Color kFilmPath{20, 90, 200}, kFilmBody{220, 80, 20}, kFilmVehicle{0, 0, 0};

/// Draws lines between points of the world into a camera's picture; what lies behind the camera is
/// left out.
struct Sketch {
  const Pinhole& camera;
  Pose T_camera_world;
  Picture& picture;

  void line(const std::vector<Vector3d>& points, const Color& color, int width_px) {
    std::vector<Eigen::Vector2d> shown;
    for (const Vector3d& point : points) {
      const Vector3d seen = T_camera_world * point;
      if (seen.z() < 0.1) {
        flush(shown, color, width_px);
        continue;
      }
      shown.emplace_back(camera.cx_px + camera.fx_px * seen.x() / seen.z(),
                         camera.cy_px + camera.fy_px * seen.y() / seen.z());
    }
    flush(shown, color, width_px);
  }

 private:
  void flush(std::vector<Eigen::Vector2d>& shown, const Color& color, int width_px) {
    if (shown.size() > 1) draw_line(picture, shown, color, width_px);
    shown.clear();
  }
};

/// A cross of arms with a ring at each end: a quadrotor of this body.
void sketch_vehicle(const Vector3d& body_m, const Pose& T_world_body, Sketch& sketch) {
  for (const double side : {-1.0, 1.0}) {
    const Vector3d front(0.32 * body_m.x(), side * 0.32 * body_m.y(), 0.0);
    sketch.line({T_world_body * front, T_world_body * Vector3d(-front)}, {40, 40, 40}, 4);
    for (const double end : {-1.0, 1.0}) {
      std::vector<Vector3d> ring;
      constexpr int kCorners = 16;
      for (int i = 0; i <= kCorners; ++i) {
        const double angle = math::kTau * i / kCorners;
        ring.push_back(T_world_body * Vector3d(end * front + 0.2 * body_m.y() *
                                                                 Vector3d(math::cos(angle),
                                                                          math::sin(angle), 0.0)));
      }
      sketch.line(ring, end > 0.0 ? kFilmBody : Color{60, 60, 60}, 3);
    }
  }
  sketch.line({T_world_body.translation(), T_world_body * Vector3d(0.45 * body_m.x(), 0.0, 0.0)},
              kFilmBody, 5);
}

Picture seen_picture(const Moment& moment, const SensorSpec& sensor) {
  for (const SeenImage& image : moment.images) {
    if (!image.depth_m.empty() || !image.bytes.empty())
      return image_picture(image, sensor.max_range_m);
  }
  Picture none = make_picture(320, 240);
  const bool has_lidar = !sensor.lidars.empty();
  draw_text(none, has_lidar ? "points, see below" : "it sees no image", 90, 120, kWhite);
  return none;
}

/// As high as the sensor's image is at this width, within reason.
int seen_height_px(const SensorSpec& sensor) {
  const double height =
      static_cast<double>(kSideWidth_px * sensor.height_px) / static_cast<double>(sensor.width_px);
  return static_cast<int>(std::min(height, 0.6 * kFilmHeight_px));
}

Panel empty_plan(const StoredTrial& stored, const World& world, const TrialRecord& record,
                 int height_px) {
  const World roofless = without_roof(world);
  return flight_plan(Scene(roofless), record, extent_of(stored, record), kFilmMargin_m,
                     kSideWidth_px, height_px, 0);
}

}  // namespace

Film::Film(const StoredTrial& stored, const World& world, const TrialRecord& record,
           const std::vector<Moment>& moments)
    : stored_(stored),
      record_(record),
      moments_(moments),
      scene_(world),
      seen_height_px_(seen_height_px(seen_sensor(stored.spec))),
      plan_(empty_plan(stored, world, record, kFilmHeight_px - seen_height_px_)),
      struck_(struck_obstacle(world, record)) {
  // The camera turns after the vehicle, as someone who follows it would.
  double yaw_rad = yaw_of(record.samples.front().q_world_body);
  const double share = 1.0 - math::exp(-1.0 / (kTurning_s * kFilmRate_hz));
  for (std::size_t i = 0; i < frame_count(); ++i) {
    const double wanted = yaw_of(sample_at(record, time_of(i)).q_world_body);
    yaw_rad += share * std::remainder(wanted - yaw_rad, math::kTau);
    yaws_rad_.push_back(yaw_rad);
  }
}

double Film::time_of(std::size_t frame) const {
  return std::min(record_.samples.front().time_s + static_cast<double>(frame) / kFilmRate_hz,
                  record_.samples.back().time_s);
}

const Moment* Film::moment_at(double time_s) const {
  const Moment* found = nullptr;
  for (const Moment& moment : moments_) {
    if (moment.call_s <= time_s + 1e-9) found = &moment;
  }
  return found;
}

Picture Film::chase(std::size_t frame) const {
  const double time_s = time_of(frame);
  const Sample& now = sample_at(record_, time_s);
  const Vector3d ahead(math::cos(yaws_rad_[frame]), math::sin(yaws_rad_[frame]), 0.0);
  const Vector3d back = -kBehind_m * ahead + kAbove_m * Vector3d::UnitZ();
  // In front of what stands between: through a trunk nothing is seen.
  const RayHit hit = scene_.first_hit(now.position_world, back, back.norm() + 0.3);
  const double reach = std::clamp((hit.distance_m - 0.3) / back.norm(), 0.25, 1.0);
  const Vector3d eye = now.position_world + reach * back;
  const Pose T_world_camera = look_at(eye, now.position_world + kLookAhead_m * ahead);
  const Pinhole camera =
      make_pinhole(kChaseWidth_px, kFilmHeight_px, kChaseFov_deg * math::kDegree, 200.0);
  Picture picture = make_picture(kChaseWidth_px, kFilmHeight_px);
  render_shaded(scene_, camera, T_world_camera, Light{}, 1, picture.rgb);
  Sketch sketch{camera, T_world_camera.inverse(), picture};
  std::vector<Vector3d> flown;
  for (const Sample& s : record_.samples) {
    if (s.time_s > time_s - 2.0 && s.time_s <= time_s + 1e-9) flown.push_back(s.position_world);
  }
  sketch.line(flown, kFilmPath, 2);
  sketch_vehicle(to_eigen(stored_.spec.vehicle.body_size_m),
                 make_pose(now.position_world, now.q_world_body), sketch);
  add_caption(picture, ascii(stored_.row.planner_label) + ", " + fixed_digits(time_s, 2) + " s, " +
                           fixed_digits(now.velocity_world.norm(), 1) + " m/s, clearance " +
                           fixed_digits(std::min(now.clearance_m, kClearanceLimit_m), 2) + " m");
  if (time_s >= record_.samples.back().time_s) {
    draw_label(picture, ascii(std::string(text(record_.outcome))), kChaseWidth_px / 2 - 60,
               kFilmHeight_px - 40, kGoalColor);
  }
  return picture;
}

Picture Film::from_above(double time_s, const Moment* moment) const {
  Panel panel = plan_;
  const Sample& now = sample_at(record_, time_s);
  panel.low_world.z() = now.position_world.z();
  if (moment != nullptr) draw(moment->drawings, panel);
  std::vector<Vector3d> flown;
  for (const Sample& s : record_.samples) {
    if (s.time_s <= time_s + 1e-9) flown.push_back(s.position_world);
  }
  draw_path(flown, kFilmPath, 2, 1, panel);
  const double goal_px = std::max(5.0, stored_.spec.mission.goal_radius_m * panel.pixels_per_m);
  const std::size_t last = stored_.mission.waypoints_world.size();
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector3d place = goal_place(stored_.spec.mission, stored_.mission, i, time_s);
    draw_circle(panel.picture, panel.to_pixels(place), goal_px, kGoalColor, 2);
  }
  draw_disc(panel.picture, panel.to_pixels(stored_.mission.start_world), 5.0, kStartColor);
  if (struck_ != nullptr && time_s >= struck_->time_s - 1e-9) draw_struck(*struck_, panel);
  draw_circle(panel.picture, panel.to_pixels(now.position_world), 7.0, kFilmVehicle, 2);
  add_caption(panel.picture, "from above");
  add_scale_bar(panel.picture, panel.pixels_per_m);
  return panel.picture;
}

std::size_t Film::frame_count() const {
  const std::vector<Sample>& samples = record_.samples;
  const double length_s = samples.back().time_s - samples.front().time_s + kFilmEnd_s;
  return static_cast<std::size_t>(std::ceil(length_s * kFilmRate_hz));
}

Picture Film::frame(std::size_t index) {
  const double time_s = time_of(index);
  scene_.set_time(time_s);
  const Moment* moment = moment_at(time_s);
  Picture picture = make_picture(kFilmWidth_px, kFilmHeight_px);
  paste(chase(index), 0, 0, picture);
  if (moment != nullptr) {
    Picture seen =
        resized(seen_picture(*moment, seen_sensor(stored_.spec)), kSideWidth_px, seen_height_px_);
    add_caption(seen, "what the planner saw");
    paste(seen, kChaseWidth_px, 0, picture);
  }
  paste(from_above(time_s, moment), kChaseWidth_px, seen_height_px_, picture);
  return picture;
}

}  // namespace avoidbench
