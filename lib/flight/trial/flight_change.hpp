#pragma once

#include <optional>

namespace avoidbench {

/// What a flight does otherwise than its trial says, to find out what decides it (the room
/// what_if). No part of a TrialSpec, so that trials keep their keys. The default changes nothing.
struct FlightChange {
  /// The vehicle is at each step where its reference is, with the attitude and the rates that the
  /// reference asks for: nothing pushes it off, and no controller or rotor lags. What it believes
  /// of itself is where the reference is: a drifting odometry takes it along. Under body rates,
  /// which are no reference, it flies by its dynamics.
  bool tracks_perfectly = false;
  /// What moves stands still all the time where it stands at this moment.
  std::optional<double> still_at_s = {};
};

}  // namespace avoidbench
