#include "view/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/math.hpp"
#include "shading/shading.hpp"
#include "text/number_text.hpp"
#include "view/map_plan.hpp"
#include "view/map_views.hpp"
#include "view/replay_panel.hpp"
#include "view/struck_obstacle.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr double kBehind_m = 2.6, kAbove_m = 0.9, kLookAhead_m = 1.5;
constexpr double kChaseFov_deg = 80.0;
constexpr double kTurning_s = 0.5;     // time in which the camera follows a turn
constexpr double kFilmEnd_s = 1.0;     // the last frame stays so long
constexpr double kFilmMargin_m = 6.0;  // shown around the path from above, both sides together
constexpr Color kFilmPath{20, 90, 200}, kFilmBody{220, 80, 20}, kFilmVehicle{0, 0, 0};

/// The sample not after `time_s`.
const Sample& last_sample(const TrialRecord& record, double time_s) {
  const auto after = std::upper_bound(record.samples.begin(), record.samples.end(), time_s + 1e-9,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  return after == record.samples.begin() ? *after : *std::prev(after);
}

/// A camera at `eye` that looks at `target`, RDF.
Pose looking_at(const Vector3d& eye, const Vector3d& target) {
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = eye;
  return pose;
}

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

Picture seen_picture(const Moment& moment, double shown_m) {
  for (const SeenImage& image : moment.images) {
    if (!image.depth_m.empty()) {
      return depth_picture(image.depth_m, image.width_px, image.height_px, 0.0, shown_m);
    }
    if (image.bytes.empty()) continue;
    Picture picture = make_picture(image.width_px, image.height_px);
    const bool is_color = image.bytes.size() == picture.rgb.size();
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
      picture.rgb[i] = image.bytes[is_color ? i : i / 3];
    }
    return picture;
  }
  Picture none = make_picture(320, 240);
  draw_text(none, "it sees no image", 90, 120, kWhite);
  return none;
}

}  // namespace

struct Film::Internals {
  const StoredTrial& stored;
  const World& world;
  const TrialRecord& record;
  const std::vector<Moment>& moments;
  FilmSpec spec;
  Scene scene;
  int chase_width_px, side_width_px, seen_height_px;
  std::vector<double> yaws_rad;  ///< of the chasing camera, a frame each
  std::optional<Panel> plan;     ///< of the map, where nothing moves
  double shown_m = 15.0;
  std::unique_ptr<StruckObstacle> struck;

  double time_of(std::size_t frame) const {
    return std::min(record.samples.front().time_s + static_cast<double>(frame) / spec.rate_hz,
                    record.samples.back().time_s);
  }
  void find_yaws(std::size_t count);
  Panel empty_plan();
  Picture chase(std::size_t frame);
  Picture from_above(double time_s, const Moment* moment);
  const Moment* moment_at(double time_s) const;
};

/// The camera turns after the vehicle, as someone who follows it would.
void Film::Internals::find_yaws(std::size_t count) {
  double yaw_rad = yaw_of(record.samples.front().q_world_body);
  const double share = 1.0 - math::exp(-1.0 / (kTurning_s * spec.rate_hz));
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = yaw_of(last_sample(record, time_of(i)).q_world_body);
    yaw_rad += share * std::remainder(wanted - yaw_rad, math::kTau);
    yaws_rad.push_back(yaw_rad);
  }
}

Panel Film::Internals::empty_plan() {
  Eigen::AlignedBox2d extent;
  std::vector<double> heights_m;
  for (const Sample& s : record.samples) {
    extent.extend(s.position_world.head<2>());
    heights_m.push_back(s.position_world.z());
  }
  extent.extend(stored.mission.start_world.head<2>());
  extent.extend(stored.mission.goal_world.head<2>());
  const Eigen::Vector2d size = extent.sizes() + Eigen::Vector2d::Constant(kFilmMargin_m);
  const int height_px = spec.height_px - seen_height_px;
  const double width_m = std::max(size.x(), size.y() * side_width_px / height_px);
  Panel panel = make_panel(side_width_px, height_px, {extent.center().x(), extent.center().y(), 0},
                           Vector3d::UnitX(), Vector3d::UnitY(), width_m);
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  const World roofless = without_roof(world);
  const Scene roofless_scene(roofless);
  paint_plan(roofless_scene, *middle, panel);
  return panel;
}

const Moment* Film::Internals::moment_at(double time_s) const {
  const Moment* found = nullptr;
  for (const Moment& moment : moments) {
    if (moment.call_s <= time_s + 1e-9) found = &moment;
  }
  return found;
}

Picture Film::Internals::chase(std::size_t frame) {
  const double time_s = time_of(frame);
  const Sample& now = last_sample(record, time_s);
  const Vector3d ahead(math::cos(yaws_rad[frame]), math::sin(yaws_rad[frame]), 0.0);
  const Vector3d back = -kBehind_m * ahead + kAbove_m * Vector3d::UnitZ();
  // In front of what stands between: through a trunk nothing is seen.
  const RayHit hit = scene.first_hit(now.position_world, back, back.norm() + 0.3);
  const double reach = std::clamp((hit.distance_m - 0.3) / back.norm(), 0.25, 1.0);
  const Vector3d eye = now.position_world + reach * back;
  const Pose T_world_camera = looking_at(eye, now.position_world + kLookAhead_m * ahead);
  const Pinhole camera =
      make_pinhole(chase_width_px, spec.height_px, kChaseFov_deg * math::kDegree, 200.0);
  Picture picture = make_picture(chase_width_px, spec.height_px);
  render_shaded(scene, camera, T_world_camera, Light{}, 1, picture.rgb);
  Sketch sketch{camera, T_world_camera.inverse(), picture};
  std::vector<Vector3d> flown;
  for (const Sample& s : record.samples) {
    if (s.time_s > time_s - 2.0 && s.time_s <= time_s + 1e-9) flown.push_back(s.position_world);
  }
  sketch.line(flown, kFilmPath, 2);
  sketch_vehicle(to_eigen(stored.spec.vehicle.body_size_m),
                 make_pose(now.position_world, now.q_world_body), sketch);
  add_caption(picture, ascii(stored.row.planner_label) + ", " + fixed_digits(time_s, 2) + " s, " +
                           fixed_digits(now.velocity_world.norm(), 1) + " m/s, clearance " +
                           fixed_digits(std::min(now.clearance_m, kClearanceLimit_m), 2) + " m");
  if (time_s >= record.samples.back().time_s) {
    draw_label(picture, ascii(std::string(text(record.outcome))), chase_width_px / 2 - 60,
               spec.height_px - 40, kGoalColor);
  }
  return picture;
}

Picture Film::Internals::from_above(double time_s, const Moment* moment) {
  if (!plan) plan.emplace(empty_plan());
  Panel panel = *plan;
  const Sample& now = last_sample(record, time_s);
  panel.low_world.z() = now.position_world.z();
  if (moment != nullptr) draw(moment->drawings, panel);
  std::vector<Vector3d> flown;
  for (const Sample& s : record.samples) {
    if (s.time_s <= time_s + 1e-9) flown.push_back(s.position_world);
  }
  draw_path(flown, kFilmPath, 2, 1, panel);
  const double goal_px = std::max(5.0, stored.spec.mission.goal_radius_m * panel.pixels_per_m);
  draw_circle(panel.picture, panel.to_pixels(stored.mission.goal_world), goal_px, kGoalColor, 2);
  draw_disc(panel.picture, panel.to_pixels(stored.mission.start_world), 5.0, kStartColor);
  if (struck != nullptr && time_s >= struck->time_s - 1e-9) draw_struck(*struck, panel);
  draw_circle(panel.picture, panel.to_pixels(now.position_world), 7.0, kFilmVehicle, 2);
  add_caption(panel.picture, "from above");
  add_scale_bar(panel.picture, panel.pixels_per_m);
  return panel.picture;
}

Film::Film(const StoredTrial& stored, const World& world, const TrialRecord& record,
           const std::vector<Moment>& moments, const FilmSpec& spec)
    : internals_(new Internals{.stored = stored,
                               .world = world,
                               .record = record,
                               .moments = moments,
                               .spec = spec,
                               .scene = Scene(world),
                               .chase_width_px = 2 * (spec.width_px / 3),
                               .side_width_px = spec.width_px - 2 * (spec.width_px / 3),
                               .seen_height_px = 0,
                               .yaws_rad = {},
                               .plan = {},
                               .shown_m = stored.spec.sensor.max_range_m,
                               .struck = struck_obstacle(world, record)}) {
  const SensorSpec& sensor = stored.spec.sensor;
  const double height = static_cast<double>(internals_->side_width_px * sensor.height_px) /
                        static_cast<double>(sensor.width_px);
  internals_->seen_height_px = static_cast<int>(std::min(height, 0.6 * spec.height_px));
  internals_->find_yaws(frame_count());
}

Film::~Film() = default;

std::size_t Film::frame_count() const {
  const std::vector<Sample>& samples = internals_->record.samples;
  const double length_s = samples.back().time_s - samples.front().time_s + kFilmEnd_s;
  return static_cast<std::size_t>(std::ceil(length_s * internals_->spec.rate_hz));
}

Picture Film::frame(std::size_t index) {
  Internals& film = *internals_;
  const double time_s = film.time_of(index);
  film.scene.set_time(time_s);
  const Moment* moment = film.moment_at(time_s);
  Picture picture = make_picture(film.spec.width_px, film.spec.height_px);
  paste(film.chase(index), 0, 0, picture);
  if (moment != nullptr) {
    Picture seen =
        resized(seen_picture(*moment, film.shown_m), film.side_width_px, film.seen_height_px);
    add_caption(seen, "what the planner saw");
    paste(seen, film.chase_width_px, 0, picture);
  }
  paste(film.from_above(time_s, moment), film.chase_width_px, film.seen_height_px, picture);
  return picture;
}

}  // namespace avoidbench
