#include "view/replay_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "explain/struck_patch.hpp"
#include "render/depth.hpp"
#include "trial/planner_view.hpp"
#include "view/map_plan.hpp"
#include "view/map_views.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

constexpr int kHeader_px = 44, kGap_px = 4;
constexpr int kDetail_px = 540, kSideHeight_px = 216, kBands_px = 50;  ///< bands: caption, scales
constexpr double kDetail_m = 12.0;                                     ///< seen around the vehicle
constexpr double kAround_m = 5.0;  ///< shown beside the path, both sides together
constexpr Color kLater{120, 120, 120}, kVehicle{0, 0, 0}, kCommand{240, 120, 0},
    kReference{0, 150, 150};

/// The layout that shows a path of this extent larger.
SheetLayout layout_of(const Eigen::Vector2d& size_m) {
  // A path this much wider than high is shown larger across the sheet.
  constexpr double kWide = 1.25;
  SheetLayout layout;
  layout.is_wide = size_m.x() > kWide * size_m.y();
  if (!layout.is_wide) return layout;
  layout.overview_width_px = layout.width_px;
  const double fitting_px = layout.width_px * size_m.y() / size_m.x() + kBands_px;
  layout.overview_height_px = static_cast<int>(std::clamp(fitting_px, 320.0, 900.0));
  layout.side_width_px = layout.width_px - kGap_px - kDetail_px;
  layout.image_height_px = kDetail_px - kGap_px - kSideHeight_px;
  layout.height_px = kHeader_px + layout.overview_height_px + kGap_px + kDetail_px;
  return layout;
}

/// What the planner commands, as points: a trajectory, or the way of one second.
std::vector<Vector3d> commanded(const Moment& moment) {
  const Vector3d from = moment.believed.position_world;
  const ab_command& command = moment.result.command;
  const auto vector = [](const double(&v)[3]) { return Vector3d(v[0], v[1], v[2]); };
  std::vector<Vector3d> points;
  if (moment.result.status != PlanStatus::command) return points;
  switch (command.kind) {
    case AB_COMMAND_TRAJECTORY:
      for (const ab_point& point : moment.result.points) {
        points.push_back(vector(point.position_world_m));
      }
      return points;
    case AB_COMMAND_POSITION:
      return {from, vector(command.position_world_m)};
    case AB_COMMAND_VELOCITY:
      return {from, from + vector(command.velocity_world_mps)};
    case AB_COMMAND_ACCELERATION:
      // Constant acceleration for a second, in tenths.
      for (int i = 0; i <= 10; ++i) {
        const double t = 0.1 * i;
        points.push_back(from + t * moment.believed.velocity_world +
                         0.5 * t * t * vector(command.acceleration_world_mps2));
      }
      return points;
    default:
      return points;
  }
}

std::string command_text(const Moment& moment) {
  if (moment.result.status == PlanStatus::no_plan) return "no plan";
  if (moment.result.status == PlanStatus::gave_up) return "gave up";
  if (moment.result.status == PlanStatus::error) return "planner error";
  switch (moment.result.command.kind) {
    case AB_COMMAND_TRAJECTORY:
      return "command: trajectory";
    case AB_COMMAND_POSITION:
      return "command: position";
    case AB_COMMAND_VELOCITY:
      return "command: velocity, 1 s";
    case AB_COMMAND_ACCELERATION:
      return "command: acceleration, 1 s";
    default:
      return "command: body rates";
  }
}

/// The part of the path in a panel, coloured by speed.
/// What comes later lies below, thin and grey.
void draw_flown(const TrialRecord& record, double until_s, double most_mps, int width_px,
                Panel& panel) {
  std::vector<Vector3d> before, later;
  for (const Sample& s : record.samples) {
    // With the slack of sample_at(), so that the path ends at the vehicle.
    (s.time_s <= until_s + 1e-9 ? before : later).push_back(s.position_world);
  }
  draw_path(later, kLater, 1, 0, panel);
  draw_path(before, kVehicle, width_px, 1, panel);
  for (std::size_t i = 0; i + 1 < before.size(); ++i) {
    const double speed_mps = record.samples[i].velocity_world.norm();
    draw_path({before[i], before[i + 1]}, turbo_color(speed_mps / most_mps), width_px, 0, panel);
  }
}

void add_speed_scale(double most_mps, Picture& picture) {
  constexpr int kWidth = 140, kRight = 96;
  const int left = picture.width_px - kWidth - kRight, y = picture.height_px - 12;
  // As wide as a band is high: the dark ground of the scale.
  draw_line(picture, {{left - 70.0, y + 1.0}, {picture.width_px + 0.0, y + 1.0}}, {70, 70, 70}, 23);
  for (int i = 0; i < kWidth; ++i) {
    const double x = left + i;
    draw_line(picture, {{x, y - 5.0}, {x, y + 5.0}}, turbo_color(i / (kWidth - 1.0)), 1);
  }
  draw_text(picture, "speed 0", left - 64, y + 5, kWhite);
  draw_text(picture, significant_digits(most_mps, 3) + " m/s", left + kWidth + 8, y + 5, kWhite);
}

void draw_mission(const Mission& mission, double goal_radius_m, Panel& panel) {
  const Eigen::Vector2d start = panel.to_pixels(mission.start_world);
  const double goal_px = std::max(5.0, goal_radius_m * panel.pixels_per_m);
  const std::vector<Vector3d> goals = goals_of(mission);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Eigen::Vector2d goal = panel.to_pixels(goals[i]);
    draw_circle(panel.picture, goal, goal_px, kWhite, 4);
    draw_circle(panel.picture, goal, goal_px, kGoalColor, 2);
    if (goals.size() > 1) draw_goal_number(panel.picture, i + 1, goal, goal_px);
  }
  draw_disc(panel.picture, start, 7.0, kWhite);
  draw_disc(panel.picture, start, 5.0, kStartColor);
}

/// "0.41 m", or "> 5 m" where the search ended before a surface.
std::string clearance_text(double clearance_m) {
  return (clearance_m < kClearanceLimit_m ? fixed_digits(clearance_m, 2)
                                          : "> " + fixed_digits(kClearanceLimit_m, 0)) +
         " m";
}

}  // namespace

const Sample& sample_at(const TrialRecord& record, double time_s) {
  // Times are sums of periods: a sample at the very moment counts even where rounding puts it
  // behind.
  const auto after = std::upper_bound(record.samples.begin(), record.samples.end(), time_s + 1e-9,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  return after == record.samples.begin() ? *after : *std::prev(after);
}

std::string reference_text(const Scene& scene, const std::array<double, 3>& body_size_m,
                           const Sample& now) {
  const std::string label = "reference";
  if (!now.reference_world.allFinite()) return label;
  const double away_m = (now.position_world - now.reference_world).norm();
  const double clearance_m = scene.body_clearance(
      to_eigen(body_size_m), make_pose(now.reference_world, now.q_world_body), kClearanceLimit_m);
  return label + ": " + fixed_digits(away_m, 2) + " m off, clear by " + clearance_text(clearance_m);
}

Picture image_picture(const SeenImage& image, double shown_m) {
  if (!image.depth_m.empty()) {
    return depth_picture(image.depth_m, image.width_px, image.height_px, 0.0, shown_m);
  }
  Picture picture = make_picture(image.width_px, image.height_px);
  // Grey pictures have one byte a pixel, colour has three.
  const bool is_color = image.bytes.size() == picture.rgb.size();
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    picture.rgb[i] = image.bytes[is_color ? i : i / 3];
  }
  return picture;
}

Eigen::AlignedBox2d extent_of(const StoredTrial& stored, const TrialRecord& record) {
  Eigen::AlignedBox2d extent;
  for (const Sample& s : record.samples) extent.extend(s.position_world.head<2>());
  extent.extend(stored.mission.start_world.head<2>());
  for (const Vector3d& goal : goals_of(stored.mission)) extent.extend(goal.head<2>());
  return extent;
}

Panel flight_plan(const Scene& roofless, const TrialRecord& record,
                  const Eigen::AlignedBox2d& extent, double margin_m, int width_px, int height_px,
                  int bands_px) {
  const Eigen::Vector2d size = extent.sizes() + Eigen::Vector2d::Constant(margin_m);
  const double width_m = std::max(size.x(), size.y() * width_px / (height_px - bands_px));
  Panel panel = make_panel(width_px, height_px, {extent.center().x(), extent.center().y(), 0.0},
                           Vector3d::UnitX(), Vector3d::UnitY(), width_m);
  std::vector<double> heights_m;
  for (const Sample& s : record.samples) heights_m.push_back(s.position_world.z());
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::nth_element(heights_m.begin(), middle, heights_m.end());
  paint_plan(roofless, *middle, panel);
  return panel;
}

/// What moves has not come to the place of the contact before.
bool ReplaySheets::shows_contact(const Moment& moment) const {
  return struck_ != nullptr && (world_.motions.empty() || moment.time_s >= struck_->time_s - 1e-9);
}

/// Scenes and the plan are costly: they are made once where nothing moves, else for each moment.
/// Old ones go first, since scenes refer to their worlds.
void ReplaySheets::build(double time_s) {
  if (built_s_ && (world_.motions.empty() || *built_s_ == time_s)) return;
  built_s_ = time_s;
  map_.reset();
  scene_.reset();
  roofless_scene_.reset();
  frozen_ = standing_at(world_, time_s);
  roofless_ = without_roof(world_, time_s);
  scene_.emplace(frozen_);
  roofless_scene_.emplace(roofless_);
  map_ = flight_plan(*roofless_scene_, record_, extent_, kAround_m, layout_.overview_width_px,
                     layout_.overview_height_px, kBands_px);
}

Panel ReplaySheets::overview(const Moment& moment) const {
  Panel panel = *map_;
  // Heights matter in the details: here all is drawn as if it lay in the vehicle's plane.
  panel.low_world.z() = sample_at(record_, moment.time_s).position_world.z();
  draw(moment.drawings, panel);
  draw_flown(record_, moment.time_s, most_mps_, 3, panel);
  draw_path(commanded(moment), kCommand, 2, 1, panel);
  draw_mission(stored_.mission, stored_.spec.mission.goal_radius_m, panel);
  if (shows_contact(moment)) draw_struck(*struck_, panel);
  const Vector3d vehicle = sample_at(record_, moment.time_s).position_world;
  draw_circle(panel.picture, panel.to_pixels(vehicle), 9.0, kWhite, 4);
  draw_circle(panel.picture, panel.to_pixels(vehicle), 9.0, kVehicle, 2);
  add_caption(panel.picture, "from above; path by speed, grey: what came later");
  add_legend({{kStartColor, "start"}, {kGoalColor, "goal"}, {kVehicle, "vehicle"}}, panel.picture);
  add_scale_bar(panel.picture, panel.pixels_per_m);
  add_speed_scale(most_mps_, panel.picture);
  return panel;
}

/// From the bottom up: surfaces, mission, drawings, path, command, what was struck, and the vehicle
/// on top.
Panel ReplaySheets::detail(const Moment& moment, const Panel& empty, bool from_above) const {
  Panel panel = empty;
  const Sample& now = sample_at(record_, moment.time_s);
  paint_slice(*scene_, radius_m_, panel);
  if (from_above) draw_mission(stored_.mission, stored_.spec.mission.goal_radius_m, panel);
  draw(moment.drawings, panel);
  draw_flown(record_, moment.time_s, most_mps_, 2, panel);
  // What the controller followed: away from the path where the vehicle lags.
  std::vector<Vector3d> references;
  for (const Sample& s : record_.samples) {
    const bool is_recent = s.time_s > moment.time_s - 3.0 && s.time_s <= moment.time_s + 1e-9;
    if (is_recent && s.reference_world.allFinite()) references.push_back(s.reference_world);
  }
  draw_path(references, kReference, 1, 0, panel);
  draw_path(commanded(moment), kCommand, 2, 1, panel);
  if (shows_contact(moment)) draw_struck(*struck_, panel);
  const Vector3d body_m = to_eigen(stored_.spec.vehicle.body_size_m);
  if (now.reference_world.allFinite()) {
    draw_box(body_m, make_pose(now.reference_world, now.q_world_body), kReference, panel);
  }
  draw_box(body_m, make_pose(now.position_world, now.q_world_body), kVehicle, panel);
  // Body x is forward.
  const Vector3d nose = now.position_world + 0.6 * (now.q_world_body * Vector3d::UnitX());
  draw_path({now.position_world, nose}, kVehicle, 2, 0, panel);
  return panel;
}

Panel ReplaySheets::from_above(const Moment& moment) const {
  const Sample& now = sample_at(record_, moment.time_s);
  Panel panel = make_panel(kDetail_px, kDetail_px, now.position_world, Vector3d::UnitX(),
                           Vector3d::UnitY(), kDetail_m);
  // What is more than half a metre above the vehicle is left out.
  paint_below(*roofless_scene_, now.position_world.z() + 0.5, panel);
  panel = detail(moment, panel, true);
  std::vector<LegendLine> legend{
      {kCommand, command_text(moment)},
      {kReference, reference_text(*scene_, stored_.spec.vehicle.body_size_m, now)}};
  for (const Drawing& drawing : moment.drawings) {
    if (drawing.kind == DrawingKind::text) continue;
    legend.push_back({color_of(drawing.color_rgb), drawing.label});
  }
  add_legend(legend, panel.picture);
  add_caption(panel.picture, "z = " + fixed_digits(now.position_world.z(), 2) + " m, " +
                                 fixed_digits(now.velocity_world.norm(), 2) + " m/s, clearance " +
                                 clearance_text(now.clearance_m) + "; red: within " +
                                 fixed_digits(radius_m_, 2) + " m");
  add_scale_bar(panel.picture, panel.pixels_per_m);
  return panel;
}

Panel ReplaySheets::from_aside(const Moment& moment) const {
  const Sample& now = sample_at(record_, moment.time_s);
  Vector3d along = now.velocity_world;
  along.z() = 0.0;
  // Slower than this the direction of the velocity is chance.
  const bool is_flying = along.norm() > 0.3;
  if (!is_flying) {
    along = now.q_world_body * Vector3d::UnitX();
    along.z() = 0.0;
  }
  along.normalize();
  Panel panel = make_panel(layout_.side_width_px, kSideHeight_px, now.position_world, along,
                           Vector3d::UnitZ(), kDetail_m);
  // The view is not centred on low flights: little of it is below the ground.
  const double ground_m =
      ground_height_m(world_, now.position_world.x(), now.position_world.y()) - 0.4;
  panel.low_world.z() = std::max(panel.low_world.z(), ground_m);
  std::fill(panel.picture.rgb.begin(), panel.picture.rgb.end(), std::uint8_t{255});
  panel = detail(moment, panel, false);
  add_caption(panel.picture, std::string("from the side, along the ") +
                                 (is_flying ? "velocity" : "nose") + " (to the right)");
  return panel;
}

Picture ReplaySheets::images(const Moment& moment) const {
  const SensorSpec sensor = seen_sensor(stored_.spec);
  const double shown_m = std::min(sensor.max_range_m, 20.0);
  std::vector<SeenImage> seen = moment.images;
  std::string caption = "what the planner saw last";
  if (seen.empty()) {
    // A planner that asks for no images still flies somewhere: show what a camera would have seen.
    const Sample& now = sample_at(record_, moment.time_s);
    Pinhole camera = sensor_camera(sensor);
    SeenImage& image = seen.emplace_back();
    image.time_s = now.time_s;
    image.width_px = camera.width_px;
    image.height_px = camera.height_px;
    image.depth_m.resize(static_cast<std::size_t>(camera.width_px) *
                         static_cast<std::size_t>(camera.height_px));
    render_depth(*scene_, camera,
                 make_pose(now.position_world, now.q_world_body) * T_body_camera(sensor.mounting),
                 image.depth_m);
    caption = "ideal depth; this planner saw no image";
  }
  // As square as can be, filled row by row.
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(seen.size()))));
  const int rows = (static_cast<int>(seen.size()) + columns - 1) / columns;
  const int cell_width = layout_.side_width_px / columns,
            cell_height = layout_.image_height_px / rows;
  Picture sheet = make_picture(layout_.side_width_px, layout_.image_height_px);
  double newest_s = seen.front().time_s;
  std::string ring;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // A camera that has not exposed yet.
    if (seen[i].width_px == 0) continue;
    newest_s = std::max(newest_s, seen[i].time_s);
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const bool is_alone = seen.size() == 1;
    const int gap_px = is_alone ? 0 : kGap_px;
    const double scale = std::min(1.0 * (cell_width - gap_px) / seen[i].width_px,
                                  1.0 * (cell_height - gap_px) / seen[i].height_px);
    const int width = static_cast<int>(seen[i].width_px * scale);
    const int height = static_cast<int>(seen[i].height_px * scale);
    Picture shown = resized(image_picture(seen[i], shown_m), width, height);
    const Pose T_world_body = body_pose_at(record_.samples, seen[i].time_s);
    if (i < cameras_.size() && shows_contact(moment) &&
        ring_struck(*struck_, cameras_[i], T_world_body, scale, shown)) {
      ring = "; ring: what it struck";
    }
    if (!is_alone) draw_label(shown, "camera " + std::to_string(i), 6, height - 30, {20, 20, 20});
    paste(shown, column * cell_width + (cell_width - width) / 2, row * cell_height, sheet);
  }
  add_caption(sheet, caption + ", t = " + fixed_digits(newest_s, 3) + " s" + ring);
  if (!seen.front().depth_m.empty()) add_depth_scale(sheet, 0.0, shown_m);
  return sheet;
}

ReplaySheets::ReplaySheets(const StoredTrial& stored, const World& world, const TrialRecord& record,
                           std::string title)
    : stored_(stored),
      world_(world),
      record_(record),
      title_(std::move(title)),
      radius_m_(0.5 * to_eigen(stored.spec.vehicle.body_size_m).norm()),
      extent_(extent_of(stored, record)),
      layout_(layout_of(extent_.sizes() + Eigen::Vector2d::Constant(kAround_m))),
      struck_(struck_obstacle(world, record)),
      cameras_(planner_setup(stored.spec).cameras) {
  for (const Sample& s : record.samples) {
    most_mps_ = std::max(most_mps_, s.velocity_world.norm());
  }
}

Picture ReplaySheets::sheet(const Moment& moment) {
  build(moment.time_s);
  Picture sheet = make_picture(layout_.width_px, layout_.height_px);
  draw_text(sheet, ascii(title_), 8, 17, kWhite);
  draw_text(sheet,
            ascii("t = " + fixed_digits(moment.time_s, 3) + " s, planned at " +
                  fixed_digits(moment.call_s, 3) + " s; ended at " +
                  fixed_digits(record_.end_time_s, 3) + " s: " + record_.reason),
            8, 36, kWhite);
  paste(overview(moment).picture, 0, kHeader_px, sheet);
  const int left = layout_.is_wide ? 0 : layout_.overview_width_px + kGap_px;
  const int top = layout_.is_wide ? kHeader_px + layout_.overview_height_px + kGap_px : kHeader_px;
  paste(from_above(moment).picture, left, top, sheet);
  const int side_left = layout_.is_wide ? kDetail_px + kGap_px : left;
  const int side_top = layout_.is_wide ? top : top + kDetail_px + kGap_px;
  paste(from_aside(moment).picture, side_left, side_top, sheet);
  paste(images(moment), side_left, side_top + kSideHeight_px + kGap_px, sheet);
  return sheet;
}

}  // namespace avoidbench
