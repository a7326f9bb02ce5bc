#pragma once

#include <functional>
#include <optional>

#include "avoidbench/planner.hpp"
#include "explain/explain.hpp"
#include "plugin/planner_library.hpp"
#include "support/flight_worlds.hpp"
#include "trial/flown_world.hpp"
#include "trial/planner_view.hpp"
#include "trial/run_trial.hpp"

/// Planners whose every word a test writes, and flights of them that are explained.
namespace avoidbench::scripted {

/// What they do and say, for the test that runs.
inline std::function<std::optional<ab_command>(const ab_observation&)> act;
inline std::function<std::uint8_t(const Vec3&)> knows;
/// Of the planner that flies, which is in no library.
inline const ab_planner* table = nullptr;

/// Sees depth; does not say what it knows.
struct Silent {
  static constexpr const char* name = "silent";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_DEPTH;
  static constexpr std::uint32_t commands = AB_COMMAND_VELOCITY | AB_COMMAND_TRAJECTORY;
  explicit Silent(const ab_setup&) {}
  void reset(const ab_mission&) {}
  std::optional<ab_command> plan(const ab_observation& seen) { return act(seen); }
};

/// The same, and says it.
struct Telling : Silent {
  static constexpr const char* name = "telling";
  using Silent::Silent;
  std::uint8_t place_at(const Vec3& place) const { return knows(place); }
};

/// Sees points; does not say what it knows.
struct Pointed : Silent {
  static constexpr const char* name = "pointed";
  static constexpr std::uint32_t needs = AB_INPUT_STATE | AB_INPUT_POINTS;
  using Silent::Silent;
};

/// Looks at nothing.
struct Blind : Silent {
  static constexpr const char* name = "blind";
  static constexpr std::uint32_t needs = AB_INPUT_STATE;
  using Silent::Silent;
};

template <class Planner>
TrialSpec spec_of() {
  table = &detail::Table<Planner>::value;
  TrialSpec spec;
  spec.sensor.width_px = 160;
  spec.sensor.height_px = 120;
  spec.mission.time_limit_s = 20.0;
  return spec;
}

inline std::optional<ab_command> velocity(double x_mps, double y_mps, double z_mps,
                                          double yaw_rad = 0.5 * math::kPi) {
  return make_velocity_command({x_mps, y_mps, z_mps}, yaw_rad);
}

/// The flight, and its explanation as `avoidbench explain` finds it: from the stored flight and a
/// second one that is watched.
struct Told {
  TrialRecord record;
  CauseFound explanation;
};

inline Told fly_and_explain(const TrialSpec& spec, const World& world, const Mission& mission,
                            double reference_length_m = 30.0) {
  const Scene scene(world);
  const PlannerLibrary library = PlannerLibrary::with_table({}, *table, new_thread_owner());
  const auto fly = [&](const TrialObserver& observer) {
    PlannerInstance planner(library, planner_setup(spec), {});
    return run_trial(spec, scene, mission, planner, observer);
  };
  Told told{.record = fly({}), .explanation = {}};
  const std::optional<World> with_movers = world_with_movers(spec, scene, mission);
  const World& flown = with_movers ? *with_movers : world;
  const auto patch = struck_patch(flown, told.record);
  const FailedFlight flight{spec, flown, mission, told.record, reference_length_m, table->needs};
  if (!needs_watch(told.record) || !patch) {
    told.explanation = explained(flight, nullptr, nullptr);
    return told;
  }
  FlightWatch watch(spec, told.record.samples, *patch);
  const TrialRecord again =
      fly({.planning = {}, .planned = [&](const PlanStep& step) { watch.planned(step); }});
  EXPECT_EQ(again.samples.size(), told.record.samples.size());
  EXPECT_EQ(again.samples.back().position_world, told.record.samples.back().position_world);
  told.explanation = explained(flight, &*patch, &watch);
  return told;
}

}  // namespace avoidbench::scripted

namespace avoidbench {

/// For messages of tests.
inline void PrintTo(Cause cause, std::ostream* out) { *out << text(cause); }

}  // namespace avoidbench
