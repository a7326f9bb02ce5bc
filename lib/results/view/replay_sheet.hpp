#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/scene.hpp"
#include "replay/replay.hpp"
#include "trial/trial_observer.hpp"
#include "view/replay_panel.hpp"
#include "view/seen_points.hpp"
#include "view/struck_obstacle.hpp"

namespace avoidbench {

/// The last image of one camera that the planner was shown.
struct SeenImage {
  double time_s = 0.0;
  int width_px = 0, height_px = 0;
  std::vector<float> depth_m;       ///< of depth images; else empty
  std::vector<std::uint8_t> bytes;  ///< grey or RGB, of planners that see light
};

/// What there is to show of one moment of a flight: the last call of the planner before it.
struct Moment {
  double time_s = 0.0;
  double call_s = 0.0;  ///< of that call
  VehicleState believed;
  PlanResult result;
  std::vector<Drawing> drawings;
  std::vector<SeenImage> images;  ///< by camera
};

/// Gathers the moments of a flight that are asked for.
class MomentRecorder {
 public:
  /// Moments at `at_s` and, where `every_s` is more than 0, at its multiples; where neither is
  /// given, the end alone.
  MomentRecorder(std::vector<double> at_s, double every_s, const TrialSpec& spec);

  void planned(const PlanStep& step);
  /// A call from which the planner does not come back: what it is shown is seen, too.
  void planning(const PlanCallAhead& call);
  /// At the end of the flight: all moments, in order of time.
  std::vector<Moment> finish(double end_s);

 private:
  double next_s() const;
  void keep(double time_s);
  void see(double time_s, const VehicleState& believed, const PlannerView& view);

  std::vector<double> at_s_;  // ascending
  double every_s_;
  std::vector<RigCamera> cameras_;
  std::size_t at_index_ = 0;
  std::int64_t every_index_ = 0;
  SeenPoints points_{kMostDrawnPoints};
  Moment latest_;
  std::vector<Moment> moments_;
};

/// The last sample not after `time_s`.
const Sample& sample_at(const TrialRecord& record, double time_s);

/// What a camera saw, depths up to `shown_m`.
Picture image_picture(const SeenImage& image, double shown_m);

/// A legend: how far the vehicle is from where it was told to be, and whether its body would be
/// clear there, with its attitude: a reference has none.
std::string reference_text(const Scene& scene, const std::array<double, 3>& body_size_m,
                           const Sample& now);

/// The path with start and goal, from above.
Eigen::AlignedBox2d extent_of(const StoredTrial& stored, const TrialRecord& record);

/// The map around this extent, cut at the median height of the flight, which one climb does not
/// move. Captions take `bands_px` of the height.
Panel flight_plan(const Scene& roofless, const TrialRecord& record,
                  const Eigen::AlignedBox2d& extent, double margin_m, int width_px, int height_px,
                  int bands_px);

/// The sizes of a sheet's parts.
struct SheetLayout {
  bool is_wide = false;  ///< the overview above the details, not beside them
  int overview_width_px = 700, overview_height_px = 1169;
  int side_width_px = 540, image_height_px = 405;  ///< the images are as wide as the side
  int width_px = 1244, height_px = 1213;
};

/// Draws sheets of one replayed flight: the map from above with the path, a piece of it around the
/// vehicle from above and from the side, and what the planner saw. References must outlive it.
class ReplaySheets {
 public:
  ReplaySheets(const StoredTrial& stored, const World& world, const TrialRecord& record,
               std::string title);
  ReplaySheets(const ReplaySheets&) = delete;
  ReplaySheets& operator=(const ReplaySheets&) = delete;

  Picture sheet(const Moment& moment);

 private:
  bool shows_contact(const Moment& moment) const;
  void build(double time_s);
  Panel overview(const Moment& moment) const;
  Panel detail(const Moment& moment, const Panel& empty, bool from_above) const;
  Panel from_above(const Moment& moment) const;
  Panel from_aside(const Moment& moment) const;
  Picture images(const Moment& moment) const;

  const StoredTrial& stored_;
  const World& world_;
  const TrialRecord& record_;
  std::string title_;
  double most_mps_ = 0.1;  ///< of the flight, so that all sheets have one scale; not 0 at rest
  double radius_m_;
  Eigen::AlignedBox2d extent_;
  SheetLayout layout_;
  std::unique_ptr<StruckObstacle> struck_;
  std::vector<CameraSetup> cameras_;
  std::optional<double> built_s_;  ///< what follows; it changes only where things move
  World frozen_, roofless_;
  std::optional<Scene> scene_, roofless_scene_;
  std::optional<Panel> map_;
};

}  // namespace avoidbench
