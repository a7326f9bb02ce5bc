#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drawing/picture.hpp"
#include "render/scene.hpp"
#include "replay/replay.hpp"
#include "trial/trial_record.hpp"

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
  void see(const PlannerView& view);

  std::vector<double> at_s_;  // ascending
  double every_s_;
  std::vector<RigCamera> cameras_;
  std::size_t at_index_ = 0;
  std::int64_t every_index_ = 0;
  Moment latest_;
  std::vector<Moment> moments_;
};

/// Draws sheets of one replayed flight: the map from above with the path, a piece of it around the
/// vehicle from above and from the side, and what the planner saw. References must outlive it.
class ReplaySheets {
 public:
  ReplaySheets(const StoredTrial& stored, const World& world, const TrialRecord& record,
               std::string title);
  ~ReplaySheets();
  ReplaySheets(const ReplaySheets&) = delete;
  ReplaySheets& operator=(const ReplaySheets&) = delete;

  Picture sheet(const Moment& moment);

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
