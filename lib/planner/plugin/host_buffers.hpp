#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "avoidbench/planner.h"
#include "plugin/drawings.hpp"
#include "plugin/planner_instance.hpp"
#include "plugin/world_door.hpp"

namespace avoidbench {

/// The table that one instance gets, and what the instance said through it. Stays at its address.
class HostSide {
 public:
  /// `has_debug` false: a host without AB_DEBUG_EXTENSION.
  /// `needs` are the planner's: AB_INPUT_WORLD gives AB_WORLD_EXTENSION.
  explicit HostSide(bool has_debug = true, std::uint32_t needs = 0);
  HostSide(const HostSide&) = delete;
  HostSide& operator=(const HostSide&) = delete;

  const ab_host& table() const { return table_; }
  /// Longer errors, and lines of the log, are cut.
  static constexpr std::size_t kMostTextBytes = 10'000;

  /// The text of the last set_error, which is forgotten then.
  std::string take_error();
  /// What was logged since it was taken last, a MiB at most.
  std::vector<std::string> take_log();

  /// What the planner sees through AB_WORLD_EXTENSION from now on.
  void show_world(PlannerWorld world) { world_.world = std::move(world); }

  void want_drawings(bool wanted) { board_.is_wanted = wanted; }
  /// With a line in the log where some were left out.
  std::vector<Drawing> take_drawings();

 private:
  ab_host table_{};
  bool has_debug_;
  DrawingBoard board_;
  WorldDoor world_;
  void add_to_log(std::string line);

  std::string error_;
  std::mutex log_mutex_;  ///< threads of the planner may log at once
  std::vector<std::string> log_;
  std::size_t log_bytes_ = 0;
};

/// An ab_setup with all that it points to. Stays at its address.
class SetupBuffers {
 public:
  /// `needs` are the planner's: without images there are no cameras, without points no lidars.
  SetupBuffers(const PlannerSetup& setup, const std::vector<ParameterValue>& values,
               std::uint32_t needs);
  SetupBuffers(const SetupBuffers&) = delete;
  SetupBuffers& operator=(const SetupBuffers&) = delete;

  const ab_setup& setup() const { return setup_; }
  /// Overwrites everything with rubbish: whoever still reads it will be found out.
  void poison();

 private:
  ab_setup setup_{};
  std::vector<ab_camera> cameras_;
  std::vector<const ab_camera*> camera_pointers_;
  std::vector<ab_lidar> lidars_;
  std::vector<const ab_lidar*> lidar_pointers_;
  std::vector<std::string> texts_;
  std::vector<ab_value> values_;
  std::vector<const ab_value*> pointers_;
};

/// Points into `mission`.
ab_mission to_mission(const PlannerMission& mission);

/// An ab_observation with all that it points to except pixels and points, which stay the view's.
class ObservationBuffers {
 public:
  ObservationBuffers() = default;
  ObservationBuffers(const ObservationBuffers&) = delete;
  ObservationBuffers& operator=(const ObservationBuffers&) = delete;

  /// The view as the planner of these `needs` sees it, valid until the next call. Every image of
  /// `view` has its camera's size. `goal` is shown where the view has none: who declares goals has
  /// one in each call. `wanted`: the
  /// answer of the planner below, whose command a filter sees.
  const ab_observation& fill(const PlannerView& view, const std::vector<CameraSetup>& cameras,
                             std::uint32_t needs, const GoalView& goal = {},
                             const PlanResult* wanted = nullptr);
  void poison();

 private:
  void fill_stereo(const std::vector<StereoView>& seen, const std::vector<CameraSetup>& cameras);
  void fill_color(const std::vector<ColorView>& seen, const std::vector<CameraSetup>& cameras);
  void fill_imu(const std::vector<ImuView>& seen);
  void fill_clouds(const std::vector<CloudView>& seen);
  void fill_wanted(const PlanResult* wanted);

  ab_observation observation_{};
  ab_state state_{};
  ab_point reference_{};
  std::vector<ab_track> tracks_;
  std::vector<ab_depth_image> images_;
  std::vector<const ab_depth_image*> pointers_;
  std::vector<ab_picture> eyes_, colors_;  ///< left and right in turns; left alone
  std::vector<ab_stereo_pair> pairs_;
  std::vector<const ab_stereo_pair*> pair_pointers_;
  std::vector<const ab_picture*> color_pointers_;
  std::vector<ab_imu_sample> imu_;
  std::vector<ab_state> states_;
  std::vector<const ab_state*> state_pointers_;
  std::vector<ab_cloud> clouds_;
  std::vector<const ab_cloud*> cloud_pointers_;
  ab_command wanted_{};
  std::vector<ab_point> wanted_points_;
};

}  // namespace avoidbench
