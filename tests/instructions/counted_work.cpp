#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/math.hpp"
#include "control/tracking.hpp"
#include "maps/map_spec.hpp"
#include "metrics/map_record.hpp"
#include "render/depth.hpp"
#include "sensing/camera.hpp"
#include "sensing/stereo_matcher.hpp"
#include "support/planner_files.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"
#include "vehicle/dynamics.hpp"

/// Called once, with all that it needs there: instruction_counts.py counts what happens within it.
extern "C" [[gnu::noinline, gnu::visibility("default")]] void counted_work(
    const std::function<void()>& work) {
  work();
  asm volatile("" ::: "memory");  // no tail call: the count ends here
}

namespace avoidbench {
namespace {

/// Some work, and how many units of it are done.
struct Work {
  std::function<void()> run;
  double units;
};

SensorSpec preset(const std::string& name) {
  for (const SensorSpec& sensor : sensor_presets()) {
    if (sensor.name == name) return sensor;
  }
  AB_CHECK(false, name);
  return {};
}

World hall() { return make_world(HallSpec{.area_m = {20.0, 20.0}}, 1); }
World forest() {
  return make_world(ForestSpec{.area_m = {16.0, 16.0}, .poisson_radius_m = 3.0}, 1);
}

/// Where flights of these maps look from: level, along y.
std::vector<Pose> places(const Scene& scene) {
  std::vector<Pose> poses;
  for (double x_m = 4.0; x_m < 13.0; x_m += 4.0) {
    Pose pose = Pose::Identity();
    pose.linear().col(0) = Eigen::Vector3d::UnitX();
    pose.linear().col(1) = -Eigen::Vector3d::UnitZ();
    pose.linear().col(2) = Eigen::Vector3d::UnitY();
    pose.translation() = Eigen::Vector3d(x_m, 1.0, 1.5);
    while (scene.nearest(pose.translation(), 0.5).distance_m < 0.5) pose.translation().x() += 0.3;
    poses.push_back(pose);
  }
  return poses;
}

/// Depth of 160 × 120 pixels, a pixel.
Work depth(const World& world) {
  static World held;
  held = world;
  static const Scene scene(held);
  static const Pinhole camera = make_pinhole(160, 120, 90.0 * math::kDegree, 15.0);
  static std::vector<float> image(std::size_t{160} * 120);
  static const std::vector<Pose> poses = places(scene);
  return {[] {
            for (const Pose& pose : poses) render_depth(scene, camera, pose, image);
          },
          static_cast<double>(image.size() * poses.size())};
}

CameraSpec small_stereo() {
  CameraSpec spec = preset("stereo_sgm");
  spec.width_px = 160;
  spec.height_px = 120;
  return spec;
}

/// A pair of grey pictures, shaded and with noise, a pixel of the pair.
Work shaded_pair(const World& world) {
  static World held;
  held = world;
  static const Scene scene(held);
  static Camera camera(small_stereo());
  static CameraImages images;
  static const std::vector<Pose> poses = places(scene);
  return {[] {
            for (const Pose& pose : poses) {
              camera.expose(scene, pose, {}, {.stereo = true}, 1, images);
            }
          },
          2.0 * 160.0 * 120.0 * static_cast<double>(poses.size())};
}

/// Matching such a pair, a pixel of the depth image.
Work matcher(const std::string& sensor) {
  static CameraSpec spec = preset(sensor);
  spec.width_px = 160;
  spec.height_px = 120;
  static const World world = hall();
  static const Scene scene(world);
  static CameraImages images;
  Camera(spec).expose(scene, places(scene).front(), {}, {.stereo = true}, 1, images);
  static const auto made = make_stereo_matcher(spec);
  static std::vector<float> disparity(images.left.size());
  // Its buffers grow once.
  made->match(images.left, images.right, disparity);
  return {[] { made->match(images.left, images.right, disparity); },
          static_cast<double>(disparity.size())};
}

/// Tracking and dynamics of one millisecond, a step.
Work physics_step() {
  static const VehicleModel model = make_model(hummingbird_spec());
  static VehicleState state = hovering_at(model.spec, {0, 0, 2}, 0.3);
  static Tracker tracker = make_tracker(model, state);
  constexpr int kSteps = 4000;
  return {[] {
            Command command;
            command.kind = CommandKind::position;
            for (int i = 0; i < kSteps; ++i) {
              if (i % 100 == 0) {
                command.position_world = {i < kSteps / 2 ? 10.0 : -10.0, 1.0, 2.0};
                accept(tracker, model, command, state);
              }
              const RotorVector rotors = track(tracker, model, state);
              state = step(model, state, rotors, {}, kTicksPerMillisecond);
            }
          },
          kSteps};
}

/// Two seconds of a flight with small depth images and a planner that does next to nothing, a
/// simulated millisecond.
Work trial() {
  static TrialSpec spec;
  spec.sensor = preset("depth_ideal");
  spec.sensor.width_px = 64;
  spec.sensor.height_px = 48;
  spec.mission.time_limit_s = 2.0;
  spec.planner = test::preset_choice("straight_line");
  static const World world = hall();
  static const Scene scene(world);
  static const PlannerLibrary library = PlannerLibrary::load(spec.planner.file);
  static PlannerInstance planner(library, planner_setup(spec), parameter_values(spec.planner));
  static const auto mission = make_mission(scene, spec.mission, spec.seed, 0);
  return {[] { run_trial(spec, scene, *mission, planner); }, 2000.0};
}

/// Metrics of a map and the reference paths of four missions, a map.
Work map_record() {
  static TrialSpec spec;
  spec.map = HallSpec{.area_m = {12.0, 16.0}};
  static const World world = make_world(spec.map, 1);
  static const Scene scene(world);
  return {[] { make_map_record(spec, scene, 4); }, 1.0};
}

int count(const std::string& name) {
  const std::map<std::string, std::function<Work()>> works{
      {"depth_hall", [] { return depth(hall()); }},
      {"depth_forest", [] { return depth(forest()); }},
      {"shaded_pair_forest", [] { return shaded_pair(forest()); }},
      {"matcher_sgm", [] { return matcher("stereo_sgm"); }},
      {"matcher_opencv", [] { return matcher("stereo_sgbm"); }},
      {"matcher_census", [] { return matcher("stereo_original"); }},
      {"physics_step", physics_step},
      {"trial", trial},
      {"map_record", map_record}};
  if (name.empty()) {
    for (const auto& [known, make] : works) std::printf("%s\n", known.c_str());
    return 0;
  }
  const auto found = works.find(name);
  if (found == works.end()) {
    std::fprintf(stderr, "counted_work: no work '%s'\n", name.c_str());
    return 2;
  }
  const Work work = found->second();
  counted_work(work.run);
  std::printf("units %.17g\n", work.units);
  return 0;
}

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) { return avoidbench::count(argc > 1 ? argv[1] : ""); }
