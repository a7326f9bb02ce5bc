#include "plugin/pilot.hpp"

#include <iterator>

namespace avoidbench {
namespace {

/// Of two that fly together it must be said whose a reason is.
std::string told_by(const char* who, const PlannerInstance& instance, const std::string& reason) {
  return who + (" " + instance.name()) + (reason.empty() ? " gave up" : ": " + reason);
}

template <class Element>
std::vector<Element> joined(std::vector<Element> first, std::vector<Element> second) {
  first.insert(first.end(), std::make_move_iterator(second.begin()),
               std::make_move_iterator(second.end()));
  return first;
}

bool has_failed(const PlanResult& result) {
  return result.status == PlanStatus::error || result.status == PlanStatus::gave_up;
}

}  // namespace

std::uint32_t needs(const Pilot& pilot) {
  return pilot.planner->needs() | (pilot.filter != nullptr ? pilot.filter->needs() : 0U);
}

void show_world(const Pilot& pilot, const PlannerWorld& world) {
  pilot.planner->show_world(world);
  if (pilot.filter != nullptr) pilot.filter->show_world(world);
}

std::string reset(const Pilot& pilot, const PlannerMission& mission) {
  const std::string problem = pilot.planner->reset(mission);
  if (pilot.filter == nullptr) return problem;
  if (!problem.empty()) return told_by("planner", *pilot.planner, problem);
  const std::string of_filter = pilot.filter->reset(mission);
  return of_filter.empty() ? "" : told_by("filter", *pilot.filter, of_filter);
}

PlanResult plan(const Pilot& pilot, const PlannerView& view) {
  PlanResult wanted = pilot.planner->plan(view);
  if (pilot.filter == nullptr) return wanted;
  if (has_failed(wanted)) {
    wanted.reason = told_by("planner", *pilot.planner, wanted.reason);
    return wanted;
  }
  PlanResult result = pilot.filter->plan(view, &wanted);
  result.cpu_time_s += wanted.cpu_time_s;
  result.wall_time_s += wanted.wall_time_s;
  if (has_failed(result)) result.reason = told_by("filter", *pilot.filter, result.reason);
  return result;
}

bool has_crashed(const Pilot& pilot) {
  return pilot.planner->has_crashed() || (pilot.filter != nullptr && pilot.filter->has_crashed());
}

bool was_killed(const Pilot& pilot) {
  return pilot.planner->was_killed() || (pilot.filter != nullptr && pilot.filter->was_killed());
}

std::vector<std::string> take_log(const Pilot& pilot) {
  std::vector<std::string> log = pilot.planner->take_log();
  return pilot.filter == nullptr ? log : joined(std::move(log), pilot.filter->take_log());
}

std::vector<Drawing> take_drawings(const Pilot& pilot) {
  std::vector<Drawing> drawings = pilot.planner->take_drawings();
  return pilot.filter == nullptr ? drawings
                                 : joined(std::move(drawings), pilot.filter->take_drawings());
}

void want_drawings(const Pilot& pilot, bool wanted) {
  pilot.planner->want_drawings(wanted);
  if (pilot.filter != nullptr) pilot.filter->want_drawings(wanted);
}

}  // namespace avoidbench
