#include "pilot.hpp"

#include <algorithm>
#include <cmath>

#include "avoidbench/planner_eigen.hpp"
#include "avoidbench/portable_math.hpp"

namespace mbplanner {
namespace {

using Eigen::Vector3d;
using planning::CellState;
namespace portable = avoidbench::portable;

constexpr double kLost_m = 0.5;        ///< from the course: then it begins again from the state
constexpr double kLateness_s = 0.15;   ///< that a vehicle may be behind its course
constexpr double kLeastPath_m = 0.15;  ///< the authors' least length of a path
constexpr double kLeastSqueeze_m = 1.0;
constexpr double kLeastPause_s = 0.1;  ///< between two trees
constexpr double kSwitch_m = 0.2;      ///< by which a new path must lead farther
constexpr double kRest_s = 0.5;        ///< that a command lasts at least
constexpr std::size_t kMostTraps = 40;

bool is_finite(const ab_depth_image& image) {
  const Eigen::Isometry3d pose = avoidbench::pose_of(image);
  return pose.matrix().allFinite() && image.depth_m != nullptr && std::isfinite(image.fx_px) &&
         image.fx_px > 0.0 && image.fy_px > 0.0;
}

constexpr double kBorder = 0.05;  ///< of the rows, left out above and below

planning::RollingGridSpec grid_spec(const Settings& settings, double lowest_m, double highest_m) {
  planning::RollingGridSpec spec;
  spec.resolution_m = settings.resolution_m;
  spec.half_size_m = settings.range_m + 1.0;
  spec.lowest_m = lowest_m;
  spec.highest_m = highest_m;
  // Nearer depth is mostly a stereo matcher's mistake. What is really there was seen before, or
  // stays unknown, which blocks as well.
  spec.least_ray_m = 0.8;
  spec.longest_ray_m = settings.range_m;
  // As many rays as touch each cell, as far as the map reaches.
  const double spacing_m = settings.range_m / std::max(settings.focal_length_px, 1.0);
  spec.pixel_step = spacing_m > 0.5 * settings.resolution_m ? 1 : 2;
  spec.hit = settings.hit_log_odds;
  spec.miss = settings.miss_log_odds;
  spec.lowest_log_odds = settings.least_log_odds;
  spec.inflation_m = 0.0;  // boxes are looked up as they are
  return spec;
}

}  // namespace

Pilot::Pilot(const Settings& settings)
    : settings_(settings), grid_(grid_spec(settings, -0.5, 6.0)), tree_(settings) {
  pace_ = std::min(1.0, settings.follower_speed_mps / settings.speed_mps);
}

void Pilot::reset(const ab_mission& mission) {
  goal_.reset(mission);
  potential_.goal = avoidbench::as_vector(mission.goal_world_m);
  potential_.traps.clear();
  goal_radius_m_ = std::max(mission.goal_radius_m, 0.05);
  start_yaw_rad_ = std::isfinite(mission.start_yaw_rad) ? mission.start_yaw_rad : 0.0;
  random_ = planning::Random(mission.seed);
  flown_.forget();
  course_ = Course();
  points_.clear();
  facing_rad_.reset();
  has_begun_ = has_seen_ = false;
  look_ = retreats_ = 0;
  prepare_grid(mission);
}

/// Heights between start and goals, and what may be climbed or sunk beyond.
void Pilot::prepare_grid(const ab_mission& mission) {
  double low_m = mission.start_world_m[2], high_m = low_m;
  for (const avoidbench::Vec3& goal : avoidbench::goals_of(mission)) {
    if (!std::isfinite(goal[2])) return;
    low_m = std::min(low_m, goal[2]);
    high_m = std::max(high_m, goal[2]);
  }
  if (!std::isfinite(low_m)) return;
  lowest_m_ = low_m - settings_.max_departure_m;
  highest_m_ = high_m + settings_.max_departure_m;
  // A metre more than is flown, for boxes around the vehicle; and a bound, since a mission's
  // heights may be anything.
  constexpr double kBeyond_m = 1.0, kTallest_m = 30.0;
  const double floor_m = std::floor(lowest_m_ - kBeyond_m);
  const double ceiling_m = std::min(std::ceil(highest_m_ + kBeyond_m), floor_m + kTallest_m);
  const planning::RollingGridSpec& old = grid_.spec();
  if (old.lowest_m != floor_m || old.highest_m != ceiling_m) {
    grid_ = planning::RollingGrid(grid_spec(settings_, floor_m, ceiling_m));
  }
  const Vector3d start = avoidbench::as_vector(mission.start_world_m);
  grid_.reset(start.allFinite() ? start : Vector3d::Zero());
}

std::optional<std::vector<ab_point>> Pilot::plan(const ab_observation& seen) {
  const Vector3d position = avoidbench::as_vector(seen.state->position_world_m);
  const Vector3d velocity = avoidbench::as_vector(seen.state->velocity_world_mps);
  const double time_s = seen.state->time_s;
  if (!planning::is_place(position) || !velocity.allFinite() || !std::isfinite(time_s) ||
      !planning::is_place(potential_.goal)) {
    return std::nullopt;
  }
  look(seen, position);
  if (!has_begun_) {
    has_begun_ = true;
    hover(position, time_s);
    heading_ = {start_yaw_rad_, 0.0};
    points_began_s_ = planned_s_ = braked_s_ = closest_s_ = time_s;
    // So that the first tree is due at once.
    planned_s_ -= settings_.replan_period_s;
    closest_m_ = potential_.at(position);
  }
  if (goal_.update(seen)) take_goal(position, time_s);
  rejoin(position, velocity, time_s);
  watch_progress(position, time_s);
  if (has_seen_) decide(time_s);
  return points(time_s);
}

/// The way to the goal begins again where another one's turn has come.
void Pilot::take_goal(const Vector3d& position, double time_s) {
  potential_.goal = avoidbench::as_vector(goal_.place_world_m());
  if (goal_.is_next()) {
    potential_.traps.clear();
    closest_m_ = potential_.at(position);
    closest_s_ = time_s;
    planned_s_ = time_s - settings_.replan_period_s;
    facing_rad_.reset();
    look_ = retreats_ = 0;
  }
  course_.end_potential_m = potential_.at(course_.knots.back().position);
}

/// Takes images and sweeps in, the oldest first, and what the vehicle itself shows: its place is
/// free.
void Pilot::look(const ab_observation& seen, const Vector3d& position) {
  grid_.move_to(position);
  for (std::uint32_t i = seen.depth_count; i-- > 0;) {
    if (!is_finite(*seen.depth[i])) continue;
    grid_.integrate(planning::without_border(*seen.depth[i], kBorder));
    has_seen_ = true;
  }
  for (std::uint32_t i = seen.cloud_count; i-- > 0;) {
    grid_.integrate(*seen.clouds[i]);
    has_seen_ = true;
  }
  // More at the start, where nothing was seen yet: the missions' starts have free space around
  // them.
  const double more_m = flown_.places().size() < 2 ? 0.8 : 0.4;
  clear_around(position,
               Vector3d(settings_.robot_length_m + more_m, settings_.robot_length_m + more_m,
                        settings_.robot_height_m + 0.5 * more_m));
  grid_.clear_box(position, Vector3d(settings_.body_length_m, settings_.body_length_m,
                                     settings_.body_height_m));
  flown_.visit(position);
}

/// What is unknown in this box becomes free; obstacles in it stay.
void Pilot::clear_around(const Vector3d& position, const Vector3d& size_m) {
  const planning::Cell from = grid_.cell_of(position - 0.5 * size_m);
  const planning::Cell to = grid_.cell_of(position + 0.5 * size_m);
  // A box around the centre that touches this one cell.
  const Vector3d within = Vector3d::Constant(0.01 * settings_.resolution_m);
  for (int x = from.x(); x <= to.x(); ++x) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int z = from.z(); z <= to.z(); ++z) {
        const planning::Cell cell(x, y, z);
        if (grid_.state(cell) != CellState::unknown) continue;
        grid_.clear_box(grid_.center_of(cell), within);
      }
    }
  }
}

Motion Pilot::Course::at(double phase_s) const {
  if (phase_s <= 0.0) return knots.front();
  if (phase_s >= duration_s()) {
    Motion end;
    end.position = knots.back().position;
    return end;
  }
  const auto piece = std::min(static_cast<std::size_t>(phase_s / kStep_s), knots.size() - 2);
  const double begin_s = static_cast<double>(piece) * kStep_s;
  return planning::motion_at(planning::quintic_between(knots[piece], knots[piece + 1], kStep_s),
                             phase_s - begin_s);
}

void Pilot::begin(Course course, double time_s) {
  course_ = std::move(course);
  course_.began_s = time_s;
}

void Pilot::hover(const Vector3d& position, double time_s) {
  Course course;
  Motion rest;
  rest.position = position;
  course.knots.assign(2, rest);
  begin(std::move(course), time_s);
}

/// Where the vehicle is not near its course, the course begins again from where it is.
void Pilot::rejoin(const Vector3d& position, const Vector3d& velocity, double time_s) {
  double apart_m = kLost_m;
  constexpr double kLateStep_s = 0.05;
  for (int i = 0; i * kLateStep_s <= kLateness_s + 1e-9; ++i) {
    const double late_s = i * kLateStep_s;
    const Vector3d& there = course_.at(phase_s(time_s) - pace_ * late_s).position;
    apart_m = std::min(apart_m, (there - position).norm());
  }
  if (apart_m < kLost_m) return;
  Motion now;
  now.position = position;
  now.velocity = velocity / pace_;
  Course course;
  course.kind = Kind::brake;
  course.knots = stop_from(now, settings_.braking_mps2, limits(0));
  course.knots.insert(course.knots.begin(), now);
  begin(std::move(course), time_s);
  planned_s_ = time_s - settings_.replan_period_s;
}

double Pilot::phase_s(double time_s) const { return pace_ * (time_s - course_.began_s); }

bool Pilot::is_resting(double time_s) const { return phase_s(time_s) >= course_.duration_s(); }

Space Pilot::space(int relaxation) const {
  Space space;
  space.grid = &grid_;
  // The whole box, one that the body can just turn in, and one half-way between.
  const double turning_m = std::min(settings_.robot_length_m, 1.45 * settings_.body_length_m);
  const double low_m = std::min(settings_.robot_height_m, settings_.body_height_m + 0.28);
  const double part = 0.5 * relaxation;
  const double length_m = std::lerp(settings_.robot_length_m, turning_m, part);
  const double height_m = std::lerp(settings_.robot_height_m, low_m, part);
  space.box_m = {length_m, length_m, height_m};
  space.lowest_m = lowest_m_;
  space.highest_m = highest_m_;
  return space;
}

Limits Pilot::limits(int relaxation) const {
  constexpr double kShares[] = {1.0, 0.6, 0.3};
  return {settings_.speed_mps * kShares[relaxation], settings_.acceleration_mps2,
          settings_.jerk_mps3};
}

/// Whether a known obstacle is in the rest of the course, with the box of this relaxation.
bool Pilot::is_blocked(double phase_s, int relaxation) const {
  if (course_.kind == Kind::retreat) return false;  // where it has been there is room
  Space tight = space(relaxation);
  tight.lowest_m = -1e9;
  tight.highest_m = 1e9;
  const double end_s = course_.duration_s();
  for (int i = -2;; i += 2) {
    const double at_s = phase_s + i * kStep_s;
    if (at_s >= end_s + kStep_s) break;
    if (tight.at(course_.at(std::min(at_s, end_s)).position) == CellState::occupied) return true;
  }
  return false;
}

/// What is left of the course's primitives.
std::vector<Primitive> Pilot::chain_left(double phase_s) const {
  std::vector<Primitive> left;
  if (course_.kind != Kind::path) return left;
  int flown = static_cast<int>(std::lround(phase_s / kStep_s));
  for (const Primitive& primitive : course_.primitives) {
    const int rest = primitive.steps - flown;
    flown = std::max(0, flown - primitive.steps);
    if (rest > 0) left.push_back({primitive.pull, rest});
  }
  return left;
}

/// The course from this phase on, a knot a step.
std::vector<Motion> Pilot::knots_left(double phase_s) const {
  std::vector<Motion> left;
  for (int i = 1; phase_s + i * kStep_s < course_.duration_s() + kStep_s; ++i) {
    left.push_back(course_.at(phase_s + i * kStep_s));
  }
  return left;
}

void Pilot::decide(double time_s) {
  const double phase = phase_s(time_s);
  const bool blocked = is_blocked(phase, std::max(course_.relaxation, 1));
  const bool is_old = time_s - planned_s_ >= settings_.replan_period_s - 1e-9;
  const bool is_new = time_s - planned_s_ < kLeastPause_s - 1e-9;
  const bool ends =
      course_.kind != Kind::retreat && course_.path_s - phase < settings_.lead_s && !is_new;
  // What came nearer than the whole box is passed more slowly, or farther away.
  const bool is_tight = course_.kind == Kind::path && course_.relaxation == 0 && !is_new &&
                        (blocked || is_blocked(phase, 0));
  if (course_.kind == Kind::retreat && !is_resting(time_s)) return;
  if (!blocked && !is_old && !ends && !is_tight) return;
  planned_s_ = time_s;
  if (find_path(time_s, blocked, is_tight)) {
    facing_rad_.reset();
    look_ = 0;
    return;
  }
  if (is_resting(time_s) || course_.kind == Kind::hover) {
    search(time_s);
  } else if (blocked && (course_.kind != Kind::brake || time_s - braked_s_ >= 0.1)) {
    brake(time_s);
  }
}

/// The tightest box that may be tried: the slower the vehicle, the tighter; at full speed only
/// where something is in the way, and never one that it could only creep through.
int Pilot::most_relaxed(double speed_mps, bool is_in_the_way) const {
  const double share = speed_mps / settings_.speed_mps;
  int tightest = is_in_the_way || share < 0.5 ? 1 : 0;
  if (share < 0.35) tightest = 2;
  return std::min(tightest, settings_.relaxations);
}

/// `is_blocked_now`: an obstacle is on the course; `is_tight`: in the whole box along it.
bool Pilot::find_path(double time_s, bool is_blocked_now, bool is_tight) {
  const double phase = phase_s(time_s);
  Task task;
  task.root = course_.at(phase);
  task.goal = potential_.goal;
  task.goal_radius_m = goal_radius_m_;
  task.chain = chain_left(phase);
  std::vector<Motion> flown;
  if (course_.kind == Kind::path && !is_blocked_now) {
    flown = knots_left(phase);
  }
  const int tightest = most_relaxed(task.root.velocity.norm(), is_blocked_now || is_tight);
  for (int relaxation = 0; relaxation <= tightest; ++relaxation) {
    task.limits = limits(relaxation);
    task.space = space(relaxation);
    task.space.lowest_m = std::min(task.space.lowest_m, task.root.position.z() - 0.05);
    task.space.highest_m = std::max(task.space.highest_m, task.root.position.z() + 0.05);
    tree_.grow(task, random_);
    // Squeezing by must be worth it, or it creeps up to surfaces for a few centimetres.
    const double least_m = relaxation == 0 ? kLeastPath_m : kLeastSqueeze_m;
    const auto choice = choose(tree_, task, potential_, settings_, flown, least_m);
    if (!choice) continue;
    const double end_m = potential_.at(choice->safe_path.back().position);
    const bool leads_on = course_.kind != Kind::path || is_blocked_now || is_tight ||
                          phase > course_.path_s - settings_.lead_s ||
                          end_m < course_.end_potential_m - kSwitch_m;
    if (!leads_on) return true;  // as good as before: keep to it
    Course course;
    course.kind = Kind::path;
    course.knots.push_back(task.root);
    course.knots.insert(course.knots.end(), choice->path.begin(), choice->path.end());
    course.knots.insert(course.knots.end(), choice->safe_path.begin(), choice->safe_path.end());
    course.primitives = choice->primitives;
    course.path_s = static_cast<double>(choice->path.size()) * kStep_s;
    course.relaxation = relaxation;
    course.end_potential_m = end_m;
    begin(std::move(course), time_s);
    return true;
  }
  return false;
}

void Pilot::brake(double time_s) {
  const double phase = phase_s(time_s);
  const Motion now = course_.at(phase);
  Course course;
  course.kind = Kind::brake;
  course.knots = least_bad_stop(now, knots_left(phase), space(1), space(2), limits(0), settings_);
  course.knots.insert(course.knots.begin(), now);
  course.relaxation = 1;
  braked_s_ = time_s;
  begin(std::move(course), time_s);
}

/// At rest without a way: look around, then go back where it came from, farther each time.
void Pilot::search(double time_s) {
  const Vector3d here = course_.at(phase_s(time_s)).position;
  if (course_.kind != Kind::hover) hover(here, time_s);
  // Toward the goal first, then to both sides by a radian more each: with 90° of view every
  // direction is seen, also behind.
  constexpr double kLooks_rad[] = {0.0, 1.0, -1.0, 2.0, -2.0, portable::kPi};
  constexpr int kLooks = 6;
  constexpr double kClose_rad = 0.1;
  const Vector3d way = potential_.goal - here;
  const double toward = way.head<2>().norm() > 1e-6 ? portable::atan2(way.y(), way.x()) : 0.0;
  if (facing_rad_) {
    const double error = portable::wrapped_angle(*facing_rad_ - heading_.yaw_rad);
    if (std::abs(error) > kClose_rad && time_s - searched_s_ < 4.0) return;
    ++look_;
  }
  searched_s_ = time_s;
  if (look_ < kLooks) {
    facing_rad_ = portable::wrapped_angle(toward + kLooks_rad[look_]);
    return;
  }
  set_trap(here);
  // It looked all around and is touched by nothing: what the map has so close is a ghost.
  grid_.clear_box(here, space(0).box_m);
  look_ = 0;
  facing_rad_.reset();
  ++retreats_;
  Course course;
  course.kind = Kind::retreat;
  Motion now;
  now.position = here;
  course.knots = flown_.back(here, 1.0 + 1.5 * retreats_, {1.0, 1.5, settings_.jerk_mps3});
  course.knots.insert(course.knots.begin(), now);
  if (course.knots.size() < 2) return;
  begin(std::move(course), time_s);
}

/// A new trap, or a stronger and wider one where there was one: dead ends may be large.
void Pilot::set_trap(const Vector3d& place) {
  // A trap's slope, weight over radius, is 1 at first: as steep as the way to the goal, so that it
  // cancels the pull into a dead end. It grows while it is not enough, up to the size of the map.
  constexpr double kWeight_m = 3.0, kRadius_m = 3.0, kGrowth = 1.5, kGreatest_m = 8.0;
  for (Trap& trap : potential_.traps) {
    if ((trap.place - place).norm() > 0.5 * trap.radius_m) continue;
    trap.weight_m = std::min(kGrowth * trap.weight_m, kGreatest_m);
    trap.radius_m = std::min(kGrowth * trap.radius_m, kGreatest_m);
    return;
  }
  if (potential_.traps.size() >= kMostTraps) potential_.traps.erase(potential_.traps.begin());
  potential_.traps.push_back({place, kWeight_m, kRadius_m});
}

/// Where nothing was gained for long, the place becomes a trap and the search goes elsewhere.
void Pilot::watch_progress(const Vector3d& position, double time_s) {
  // Longer than looking all around takes; a gain of half a metre is more than drift at a hover.
  constexpr double kPatience_s = 6.0, kGain_m = 0.5;
  const double left_m = potential_.at(position);
  if (left_m < closest_m_ - kGain_m) {
    closest_m_ = left_m;
    closest_s_ = time_s;
    retreats_ = 0;
  }
  if (time_s - closest_s_ < kPatience_s) return;
  set_trap(position);
  closest_m_ = potential_.at(position);
  closest_s_ = time_s;
}

/// The rest of the course, in the clock's time.
std::vector<ab_point> Pilot::points(double time_s) {
  if (!points_.empty()) {
    heading_ = planning::heading_at(points_, time_s - points_began_s_);
  }
  const planning::TimedMotion motion{
      [this](double at_s) {
        Motion now = course_.at(pace_ * at_s);
        now.velocity *= pace_;
        now.acceleration *= pace_ * pace_;
        return now;
      },
      // Some rest at its end, so that headings go on turning.
      std::max(course_.duration_s(), phase_s(time_s) + kRest_s) / pace_};
  planning::LookAhead look;
  look.limits = {settings_.yaw_rate_radps, std::min(6.0, 4.0 * settings_.yaw_rate_radps)};
  std::optional<double> facing = facing_rad_;
  if (course_.kind == Kind::retreat) facing = heading_.yaw_rad;
  points_ =
      planning::trajectory_points(motion, phase_s(time_s) / pace_, kStep_s, heading_, look, facing);
  points_began_s_ = time_s;
  return points_;
}

}  // namespace mbplanner
