#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "plugin/planner_instance.hpp"

namespace avoidbench {

/// Who flies a trial: a planner, and the filter that its commands pass through, where there is one.
/// A planner alone is one by itself. The instances must outlive it.
struct Pilot {
  PlannerInstance* planner;
  PlannerInstance* filter;  ///< may be null

  // NOLINTNEXTLINE(google-explicit-constructor): most pilots are just a planner
  Pilot(PlannerInstance& of_planner, PlannerInstance* of_filter = nullptr)
      : planner(&of_planner), filter(of_filter) {}
};

std::uint32_t needs(const Pilot& pilot);  ///< AB_INPUT_… of both

void show_world(const Pilot& pilot, const PlannerWorld& world);

/// Both; empty text on success, else why it failed.
std::string reset(const Pilot& pilot, const PlannerMission& mission);

/// The planner's answer to the view, and then that of the filter, which sees the same and the
/// planner's command: what the filter answers is the result. It is not asked where the planner
/// gives up or fails. Times are those of both calls.
PlanResult plan(const Pilot& pilot, const PlannerView& view);

/// Whether the call that failed last did so since the program of one of them had ended.
bool has_crashed(const Pilot& pilot);
bool was_killed(const Pilot& pilot);  ///< as PlannerInstance::was_killed(), one of them

/// Of both since the last call.
std::vector<std::string> take_log(const Pilot& pilot);
std::vector<Drawing> take_drawings(const Pilot& pilot);
void want_drawings(const Pilot& pilot, bool wanted);

}  // namespace avoidbench
