#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "page/page.hpp"
#include "trial/trial_observer.hpp"
#include "view/seen_points.hpp"

namespace avoidbench {

/// How often a page shows what the planner saw and drew, and how large; enough to follow a flight.
inline constexpr double kSeen_hz = 6.0;
inline constexpr std::int64_t kMostSeenWidth_px = 160;
inline constexpr std::size_t kMostSeenImages = 1500;
inline constexpr std::size_t kMostDrawnCorners = 2500;  ///< of one drawing; more are thinned out

/// Depth as one byte: 0 invalid, 255 no return, between them 1 … 254 evenly in the logarithm from
/// `nearest_m` to `farthest_m`.
std::uint8_t depth_byte(double depth_m, double nearest_m, double farthest_m);
double depth_of_byte(std::uint8_t byte, double nearest_m, double farthest_m);

/// Gathers for a page what a planner saw, drew, commanded and logged while a trial is flown.
class SeenRecorder {
 public:
  explicit SeenRecorder(const TrialSpec& spec);
  void planned(const PlanStep& step);
  nlohmann::ordered_json json() const;

 private:
  bool is_due(double time_s);
  void see(const PlannerView& view);

  std::vector<RigCamera> cameras_;
  SeenPoints points_{kMostDrawnCorners};
  double next_s_ = 0.0;
  nlohmann::ordered_json images_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json drawings_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json log_ = nlohmann::ordered_json::array();
  std::vector<double> times_s_, cpu_ms_, speeds_mps_, accelerations_mps2_, thrusts_mps2_;
  std::vector<std::int64_t> statuses_;
};

/// The data of a page of one flight that was flown again, with the stored flights of the other
/// planners on the same mission. `seen` is a SeenRecorder's.
nlohmann::ordered_json flight_page(const Database& database, const StoredTrial& stored,
                                   const World& world, const TrialRecord& flown,
                                   const nlohmann::ordered_json& seen, const TrialListing& listing,
                                   const std::string& title, const PageOrigin& origin);

}  // namespace avoidbench
