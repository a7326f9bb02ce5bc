#include "view/map_plan.hpp"

#include <cmath>

#include "base/number_text.hpp"
#include "metrics/environment.hpp"
#include "metrics/map_record.hpp"
#include "metrics/reference_path.hpp"

namespace avoidbench {
namespace {

/// Paper is where the world ends; what moves is marked by the way that it takes.
constexpr Color kPaper{236, 236, 234}, kGround{214, 209, 199}, kPath{255, 255, 255},
    kPathRim{20, 20, 20}, kMoving{230, 120, 20};
constexpr int kBand_px = 22;  ///< of caption and scales
constexpr double kMargin_m = 0.5;

/// Where the map lies in the picture.
struct Plan {
  Eigen::Vector2d low_world;  ///< the corner at the picture's lower left
  double pixels_per_m;
  double left_px, bottom_px;

  Eigen::Vector2d to_pixels(const Eigen::Vector3d& point) const {
    return {left_px + pixels_per_m * (point.x() - low_world.x()),
            bottom_px - pixels_per_m * (point.y() - low_world.y())};
  }
};

/// As large as fits between the bands, in the middle of what is left.
Plan lay_out(const World& world, const MapView& view) {
  const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(kMargin_m);
  const Eigen::Vector2d low = world.flight_bounds.min().head<2>() - margin_m;
  const Eigen::Vector2d size = world.flight_bounds.sizes().head<2>() + 2.0 * margin_m;
  const double height_px = view.height_px - 2 * kBand_px;
  const double scale = std::min(view.width_px / size.x(), height_px / size.y());
  return {.low_world = low,
          .pixels_per_m = scale,
          .left_px = 0.5 * (view.width_px - scale * size.x()),
          .bottom_px = kBand_px + 0.5 * (height_px + scale * size.y())};
}

/// The way of what moves: both ends of a sway, the places of a longer way in the first minute.
std::vector<Eigen::Vector2d> way_of(const World& world, const Motion& motion, const Plan& plan) {
  constexpr int kSamples = 240;
  const Eigen::Vector3d rest =
      world.instances[motion.instance].T_world_prototype.translation().cast<double>();
  if (const auto* sway = std::get_if<Sway>(&motion.path)) {
    return {plan.to_pixels(rest - sway->amplitude_world),
            plan.to_pixels(rest + sway->amplitude_world)};
  }
  std::vector<Eigen::Vector2d> way;
  for (int i = 0; i <= kSamples; ++i) {
    way.push_back(plan.to_pixels(rest + displacement_world(motion, 60.0 * i / kSamples)));
  }
  return way;
}

/// One plan_color() per sample, samples × samples of them a pixel on a regular grid; their mean is
/// of sRGB values, as they are, which is good enough for edges.
void paint_ground_plan(const World& world, const Plan& plan, const MapView& view,
                       Picture& picture) {
  const Scene scene(world);
  const Aabb& bounds = world.flight_bounds;
  const Region& starts = world.start_region;
  // The middle of the heights at which missions start; above the ground where the map says so.
  const double flight_m = 0.5 * (starts.lowest.z() + starts.highest.z());
  const auto cut_z_m = [&](double x, double y) {
    return flight_m + (world.heights_above_ground ? ground_height_m(world, x, y) : 0.0);
  };
  auto byte = picture.rgb.begin();
  for (int row = 0; row < view.height_px; ++row) {
    for (int column = 0; column < view.width_px; ++column) {
      std::array<int, 3> sum{};
      for (int sample = 0; sample < view.samples * view.samples; ++sample) {
        const int sample_column = sample % view.samples, sample_row = sample / view.samples;
        const double across = column + (sample_column + 0.5) / view.samples;
        const double down = row + (sample_row + 0.5) / view.samples;
        const double x = plan.low_world.x() + (across - plan.left_px) / plan.pixels_per_m;
        const double y = plan.low_world.y() + (plan.bottom_px - down) / plan.pixels_per_m;
        const bool is_on_map =
            x >= bounds.min().x() - kMargin_m && x <= bounds.max().x() + kMargin_m &&
            y >= bounds.min().y() - kMargin_m && y <= bounds.max().y() + kMargin_m;
        const Color color = is_on_map ? plan_color(scene, x, y, cut_z_m(x, y)) : kPaper;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += color[i];
      }
      for (const int total : sum) {
        *byte++ = static_cast<std::uint8_t>(total / (view.samples * view.samples));
      }
    }
  }
}

void draw_region(const Plan& plan, const Region& region, const Color& color, Picture& picture) {
  const Eigen::Vector3d &low = region.lowest, &high = region.highest;
  draw_line(picture,
            {plan.to_pixels(low), plan.to_pixels({high.x(), low.y(), 0.0}), plan.to_pixels(high),
             plan.to_pixels({low.x(), high.y(), 0.0}), plan.to_pixels(low)},
            color, 2);
}

/// The mission over the map, and what there is to say of it.
std::string draw_mission(const Scene& scene, const TrialSpec& trial, const MapView& view,
                         const Plan& plan, Picture& picture) {
  // The same mission that a trial of this index flies.
  const auto mission = the_mission(scene, trial, view.mission_index, view.listed_missions);
  const std::string name = "mission " + std::to_string(view.mission_index);
  if (!mission) {
    return name + (view.listed_missions.empty() ? ": no free start or goal" : " is not listed");
  }
  ClearanceGrid grid(scene, scene.world().bounds, kMapCell_m);
  const double radius_m = body_measure(to_eigen(trial.vehicle.body_size_m)).radius_m;
  const auto path = reference_path(grid, *mission, trial.mission.goal_radius_m, radius_m);
  if (path) {
    // Pale on a dark rim: seen on any ground.
    std::vector<Eigen::Vector2d> points;
    for (const Eigen::Vector3d& point : *path) points.push_back(plan.to_pixels(point));
    draw_line(picture, points, kPathRim, 5);
    draw_line(picture, points, kPath, 2);
  }
  const double goal_px = std::max(6.0, trial.mission.goal_radius_m * plan.pixels_per_m);
  const std::vector<Eigen::Vector3d> goals = goals_of(*mission);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Eigen::Vector2d goal = plan.to_pixels(goals[i]);
    draw_circle(picture, goal, goal_px, kPath, 5);
    draw_circle(picture, goal, goal_px, kGoalColor, 3);
    if (goals.size() > 1) draw_goal_number(picture, i + 1, goal, goal_px);
  }
  draw_disc(picture, plan.to_pixels(mission->start_world), 7.0, kPath);
  draw_disc(picture, plan.to_pixels(mission->start_world), 5.0, kStartColor);
  if (!path) return name + ": the goal can't be reached";
  return name + ", d_min " + fixed_digits(path_length_m(*path), 2) + " m";
}

}  // namespace

void draw_goal_number(Picture& picture, std::size_t number, const Eigen::Vector2d& center_px,
                      double radius_px) {
  // draw_label() would move that of a goal outside of the picture into it.
  const Eigen::Array2d size_px(picture.width_px, picture.height_px);
  if ((center_px.array() < 0.0).any() || (center_px.array() > size_px).any()) return;
  draw_label(picture, std::to_string(number), static_cast<int>(center_px.x() + radius_px) + 4,
             static_cast<int>(center_px.y()) + 5, kGoalColor);
}

Color color_below(const Scene& scene, double x_m, double y_m, double from_z_m, double highest_m) {
  const World& world = scene.world();
  const Eigen::Vector3d from(x_m, y_m, from_z_m);
  const RayHit hit = scene.first_hit(from, -Eigen::Vector3d::UnitZ());
  if (!std::isfinite(hit.distance_m)) return kPaper;
  const std::string& kind = world.obstacles[world.instances[hit.instance].obstacle].kind;
  const double above_m = from.z() - hit.distance_m - ground_height_m(world, x_m, y_m);
  const Color flat = kind == "ground" ? kGround : height_color(above_m / highest_m);
  const Eigen::Vector3d up = hit.normal_world.z() < 0.0 ? -hit.normal_world : hit.normal_world;
  // Lambert's law with a light from the upper left of the plan, and an ambient part so that no side
  // is black.
  // A vector of length 1, 45° above the ground.
  const double light = std::max(0.0, up.dot(Eigen::Vector3d(-0.5, 0.5, 0.7071)));
  Color color{};
  for (std::size_t i = 0; i < 3; ++i) {
    color[i] = static_cast<std::uint8_t>(std::min(255.0, flat[i] * (0.45 + 0.75 * light)));
  }
  return color;
}

Color plan_color(const Scene& scene, double x_m, double y_m, double cut_z_m) {
  constexpr double kVeil = 0.3;
  const World& world = scene.world();
  const double highest_m = world.flight_bounds.sizes().z();
  // Above the cut and everything that the world has.
  const double top_z_m = std::max(cut_z_m, world.bounds.max().z()) + 1.0;
  const Color of_top = color_below(scene, x_m, y_m, top_z_m, highest_m);
  const RayHit top = scene.first_hit({x_m, y_m, top_z_m}, -Eigen::Vector3d::UnitZ());
  // From above, something is met before the cut: a crown, say, or the inside of what is cut.
  const bool is_covered = top_z_m - top.distance_m > cut_z_m;
  // Cut solids are filled with what is seen from above: their inside has no surface below the cut.
  if (!is_covered || is_inside(scene, {x_m, y_m, cut_z_m})) return of_top;
  return mixed(color_below(scene, x_m, y_m, cut_z_m, highest_m), of_top, kVeil);
}

void fit_plan(const World& world, int longest_px, MapView& view) {
  // A narrow map gets paper beside it.
  constexpr double kLeastWidth_px = 480.0, kLeastHeight_px = 240.0;  // for the captions
  const Eigen::Vector2d size_m =
      world.flight_bounds.sizes().head<2>() + Eigen::Vector2d::Constant(2.0 * kMargin_m);
  const double scale = (longest_px - 2.0 * kBand_px) / size_m.maxCoeff();
  view.width_px = static_cast<int>(std::lround(std::max(kLeastWidth_px, scale * size_m.x())));
  view.height_px =
      static_cast<int>(std::lround(std::max(kLeastHeight_px, scale * size_m.y() + 2.0 * kBand_px)));
}

Picture plan_view(const World& world, const TrialSpec& trial, const MapView& view,
                  std::string& note) {
  const Plan plan = lay_out(world, view);
  const double highest_m = world.flight_bounds.sizes().z();
  Picture picture = make_picture(view.width_px, view.height_px);
  // The roof would hide all; missions are laid out in the whole world, below.
  paint_ground_plan(without_roof(world), plan, view, picture);
  for (const Motion& motion : world.motions) {
    draw_line(picture, way_of(world, motion, plan), kMoving, 2);
  }
  if (view.listed_missions.empty()) {  // else they have no say
    draw_region(plan, world.start_region, kStartColor, picture);
    draw_region(plan, world.goal_region, kGoalColor, picture);
  }
  note = draw_mission(Scene(world), trial, view, plan, picture);
  add_scale_bar(picture, plan.pixels_per_m);
  add_height_scale(picture, highest_m);
  return picture;
}

}  // namespace avoidbench
