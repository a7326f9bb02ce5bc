#include "base/digest.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {

std::vector<const PluginChoice*> plugins_of(const PlannerChoice& planner) {
  std::vector<const PluginChoice*> plugins{&planner};
  if (planner.filter) plugins.push_back(&*planner.filter);
  return plugins;
}

std::uint32_t needs_of(const PlannerChoice& planner) {
  return planner.needs | (planner.filter ? planner.filter->needs : 0U);
}

std::string flown_digest(const PlannerChoice& planner) {
  if (!planner.filter) return planner.file_digest;
  return Digest().add(planner.file_digest).add(planner.filter->file_digest).hex();
}

}  // namespace avoidbench
