#pragma once

#include <vector>

#include "smooth_line.hpp"

namespace omniscient {

struct Limits {
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
  bool ends_at_rest = false;
};

/// A motion along a line, as a function of time.
struct Motion {
  Eigen::Vector3d position_world, velocity_world, acceleration_world;
};

/// The line flown as fast as the limits let it: from rest, and through its end at full speed unless
/// it is to end at rest.
class TimedLine {
 public:
  TimedLine() = default;
  /// `line` is evenly spaced, of at least three points.
  TimedLine(const Line& line, const Limits& limits);

  /// After the end it goes straight on, or rests.
  Motion at(double time_s) const;

 private:
  double step_m_ = 0.0;
  Line line_;                  ///< by way along it, step_m_ apart
  std::vector<double> way_m_;  ///< by time
};

}  // namespace omniscient
