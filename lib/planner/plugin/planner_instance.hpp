#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugin/call_clock.hpp"
#include "plugin/drawings.hpp"
#include "plugin/planner_library.hpp"

namespace avoidbench {

/// What an instance is made for, in the host's types; see ab_setup.
struct CameraSetup {
  std::int32_t width_px = 0, height_px = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  Eigen::Isometry3d T_body_camera = Eigen::Isometry3d::Identity();
  double rate_hz = 0, min_range_m = 0, max_range_m = 0, baseline_m = 0;
};
struct LidarSetup {
  bool is_deskewed = true;
  Eigen::Isometry3d T_body_lidar = Eigen::Isometry3d::Identity();
  double rate_hz = 0, min_range_m = 0, max_range_m = 0;
  double lowest_elevation_rad = 0, highest_elevation_rad = 0;
  std::uint32_t shots = 0;
};
struct PlannerSetup {
  double max_speed_mps = 0, max_acceleration_mps2 = 0, max_yaw_rate_radps = 0;
  Eigen::Vector3d body_size_m = Eigen::Vector3d::Zero();
  double plan_period_s = 0, gravity_mps2 = 0;
  std::vector<CameraSetup> cameras;
  std::vector<LidarSetup> lidars = {};
};
struct PlannerMission {
  std::uint64_t seed = 0;
  Eigen::Vector3d start_world = Eigen::Vector3d::Zero(), goal_world = Eigen::Vector3d::Zero();
  double start_yaw_rad = 0, goal_radius_m = 0, time_limit_s = 0;
  Eigen::Vector3d lowest_world = Eigen::Vector3d::Zero(), highest_world = Eigen::Vector3d::Zero();
  double command_latency_s = 0;  ///< NaN: measured
  /// All in order, the first one goal_world; empty: that alone.
  std::vector<Eigen::Vector3d> goals_world = {};
};

/// The map of a trial, for planners that see it (AB_INPUT_WORLD).
struct PlannerWorld {
  /// From a place to the nearest surface, m, at most 2.5.
  std::function<double(const Eigen::Vector3d& place_world)> distance_m;
  /// The mission's shortest path for a ball of this radius, m; empty where it has none.
  std::function<std::vector<Eigen::Vector3d>(double radius_m)> shortest_path_world;
};

/// What a planner sees in one call. Images newest first; their pixels must live until plan()
/// returns. Poses are the (left) camera's; `camera` is an index into PlannerSetup::cameras.
struct DepthView {
  double time_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::uint32_t camera = 0;
  std::span<const float> depth_m;
};
struct StereoView {
  double time_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::uint32_t camera = 0;
  std::span<const std::uint8_t> left, right;
};
struct ColorView {
  double time_s = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::uint32_t camera = 0;
  std::span<const std::uint8_t> rgb;
};
/// `lidar` is an index into PlannerSetup::lidars.
struct CloudView {
  double time_s = 0;
  Eigen::Isometry3d T_world_lidar = Eigen::Isometry3d::Identity();
  std::uint32_t lidar = 0;
  std::span<const ab_lidar_point> points;
  std::span<const Eigen::Vector3f> misses_lidar;
};
struct ImuView {
  double time_s = 0;
  Eigen::Vector3d rates_body, specific_force_body_mps2;
};
/// As the odometry says it.
struct StateView {
  double time_s = 0;
  Eigen::Vector3d position_world, velocity_world, rates_body;
  Eigen::Quaterniond q_world_body;
};
/// Where the vehicle is told to be, at a call.
struct ReferenceView {
  Eigen::Vector3d position_world, velocity_world, acceleration_world, jerk_world;
  double yaw_rad = 0, yaw_rate_radps = 0;
};
/// The goal to reach now.
struct GoalView {
  std::uint32_t index = 0;  ///< into PlannerMission::goals_world
  Eigen::Vector3d place_world = Eigen::Vector3d::Zero();
};
/// Something that moves, at the time of a scan.
struct TrackView {
  std::uint32_t id = 0, kind = 0;  ///< kind: AB_TRACK_…
  double time_s = 0;
  Eigen::Vector3d center_world, velocity_world, size_m;
};
/// The newest state, and what came since the last call.
struct PlannerView : StateView {
  double call_time_s = 0;  ///< now; time_s is older where the odometry has a delay
  std::vector<DepthView> depth;
  std::vector<StereoView> stereo;
  std::vector<ColorView> color;
  std::vector<ImuView> imu;                     ///< oldest first
  std::vector<StateView> states;                ///< oldest first
  std::optional<ReferenceView> reference = {};  ///< nothing while rates are commanded
  std::vector<CloudView> clouds = {};           ///< newest first
  std::optional<GoalView> goal = {};            ///< nothing: the mission's first
  std::vector<TrackView> tracks = {};           ///< of the newest scan
};

/// What a planner knows of a place: AB_PLACE_….
enum class PlaceKnown : std::uint8_t { unknown, free, occupied };

enum class PlanStatus { command, no_plan, gave_up, error };

/// What came back from one plan() call, copied out of the planner's memory and checked: a command
/// of an undeclared kind, with NaN or inf, with too few or unordered points is an error with a
/// reason.
struct PlanResult {
  PlanStatus status = PlanStatus::error;
  std::string reason;        ///< of an error, or why it gave up
  bool has_crashed = false;  ///< of an error: the planner's program has ended
  ab_command command{};  ///< valid for PlanStatus::command; its `points` member is null, see below
  std::vector<ab_point> points;
  /// CPU time of the calling thread in the call, and of the planner's other threads in it and since
  /// its last call; see CpuMeter. Of a program also what all its threads used since its last call.
  double cpu_time_s = 0;
  double wall_time_s = 0;
};

/// One planner instance. Move-only; destroys itself. Not for two threads at once.
class PlannerInstance {
 public:
  /// Throws InputError with the planner's own text when create fails.
  /// `clock`, where given, must outlive the instance.
  PlannerInstance(const PlannerLibrary& library, const PlannerSetup& setup,
                  const std::vector<ParameterValue>& values, CallClock* clock = nullptr);
  ~PlannerInstance();
  PlannerInstance(PlannerInstance&&) noexcept;
  PlannerInstance& operator=(PlannerInstance&&) noexcept;

  std::uint32_t needs() const;  ///< AB_INPUT_…
  const std::string& name() const;

  /// What it sees of the map, for who declared that, until the next one; its functions are called
  /// during reset() and plan().
  void show_world(PlannerWorld world);

  /// Empty text on success, else why it failed.
  std::string reset(const PlannerMission& mission);
  /// `wanted`: the answer of the planner below, for a filter, which sees its command; null if
  /// there is no planner below.
  PlanResult plan(const PlannerView& view, const PlanResult* wanted = nullptr);

  /// Whether it says what it knows of places (AB_MAP_EXTENSION).
  bool has_map() const;
  /// What it knows of each; nothing where it has no map or can't say. Commands do not depend on it.
  std::optional<std::vector<PlaceKnown>> look_up(std::span<const Eigen::Vector3d> places_world);

  /// Whether the call that failed last did so since the planner's program had ended.
  bool has_crashed() const;
  /// Whether it had ended by SIGKILL, which may be somebody else's doing.
  bool was_killed() const;

  /// Lines the planner logged since the last call.
  std::vector<std::string> take_log();

  /// Whether the planner is told that someone looks at what it draws; it is not at first. Commands
  /// do not depend on it.
  void want_drawings(bool wanted);
  /// What it drew since the last call.
  std::vector<Drawing> take_drawings();

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
