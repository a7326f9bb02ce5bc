#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugin/host_buffers.hpp"
#include "plugin/planner_instance.hpp"

namespace avoidbench {

/// One made-up moment of a flight. `images` are newest first, of their cameras' size.
struct Frame {
  double time_s = 0.0;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_world = Eigen::Vector3d::Zero();
  std::vector<std::vector<float>> images;
  std::vector<std::uint32_t> cameras = {};  ///< of the images, by index; empty: all of the first
  /// A sweep of the lidar that ends now, where the setup has one, and how often it is given.
  std::vector<ab_lidar_point> points = {};
  std::vector<Eigen::Vector3f> misses_lidar = {};
  int sweep_count = 1;
  std::vector<TrackView> tracks = {};
  std::optional<GoalView> goal = {};  ///< nothing: the mission's first
  /// What a filter sees of the planner below; nothing: see wanted_in_turn().
  std::optional<PlanResult> wanted = {};

  std::uint32_t camera_of(std::size_t image) const { return cameras.empty() ? 0 : cameras[image]; }
};

struct ConformanceFlight {
  PlannerMission mission;
  std::vector<Frame> frames;
};

/// A vehicle of half a metre with a camera of 160 × 120 pixels and 90° looking forward, and a
/// lidar.
PlannerSetup conformance_setup();

/// Twenty frames along +x at 2 m height and 3 m/s over level ground toward a wall at x = 6 m with a
/// gap of 2 m. Somebody comes toward it.
ConformanceFlight wall_flight();

/// wall_flight() in which every pixel of every image is `depth_m`, and every point so far off.
ConformanceFlight uniform_flight(float depth_m);

/// What one call gave.
struct Reply {
  ab_status status = AB_ERROR;
  bool is_plan = false;  ///< of plan(), not of reset()
  ab_command command{};  ///< its points are null
  std::vector<ab_point> points;
  std::string error;         ///< given to set_error
  std::string escaped;       ///< an exception that crossed the interface
  std::string changed;       ///< an input that the planner wrote to
  std::string map_problem;   ///< of what it said of places after the call
  double wall_time_s = 0.0;  ///< of the call
  double cpu_time_s = 0.0;   ///< in it: of the whole process, and of a planner's program
};

/// Whether both gave the same bits.
bool equal(const Reply& a, const Reply& b);

/// Where two flights part first: "call 3 gives another answer"; empty when nowhere.
std::string first_difference(const std::vector<Reply>& a, const std::vector<Reply>& b);

/// "reset" or "call 3": which of the replies of Probe::fly.
std::string reply_place(std::size_t index);

/// Why this reply breaks the interface, whatever was asked; empty when it does not.
std::string reply_problem(const Reply& reply, const ab_planner& table);

/// What a host does with drawings: it has no such extension, nobody looks, or somebody does. The
/// last: it asks what the planner knows of places (AB_MAP_EXTENSION), after each call.
enum class Looking { impossible, nobody, somebody, asking };

/// An instance called through its bare table, with inputs in buffers that are compared and, when
/// `poisoned`, overwritten with rubbish after each call.
class Probe {
 public:
  Probe(const ab_planner& table, const std::vector<ParameterValue>& values, bool poisoned = false,
        Looking looking = Looking::nobody, const PlannerSetup& setup = conformance_setup());
  ~Probe();
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  bool is_created() const { return instance_ != nullptr; }
  /// Why create failed.
  const std::string& problem() const { return problem_; }

  Reply reset(const PlannerMission& mission);
  Reply plan(const Frame& frame);
  std::vector<Drawing> take_drawings() { return host_.take_drawings(); }
  /// Asks what the planner knows of places around this one; why its answer is none, or "".
  std::string ask_map(const Eigen::Vector3d& around_world);
  /// reset and then every frame; where somebody is asking, after each of these.
  std::vector<Reply> fly(const ConformanceFlight& flight);

 private:
  PlannerView view_of(const Frame& frame);

  const ab_planner* table_;
  bool poisoned_, is_asking_;
  PlannerMission mission_;
  PlannerSetup setup_;
  HostSide host_;
  ObservationBuffers observation_;
  std::vector<std::vector<float>> pixels_;
  std::vector<std::vector<float>> old_pixels_;         ///< kept, so that a late read is no crash
  std::vector<std::vector<std::uint8_t>> grey_, rgb_;  ///< by image
  std::vector<ab_lidar_point> points_;
  std::vector<Eigen::Vector3f> misses_lidar_;
  std::size_t call_count_ = 0;  ///< since reset()
  void* instance_ = nullptr;
  std::string problem_;
};

}  // namespace avoidbench
