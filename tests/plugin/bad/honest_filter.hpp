#pragma once

#include "honest.hpp"

/// A filter that keeps every rule: it lets all commands pass.
namespace honest {

inline ab_status pass_on(void*, const ab_observation* seen, ab_command* command) {
  if (seen->wanted == nullptr) return AB_NO_PLAN;
  *command = *seen->wanted;
  return AB_OK;
}

inline void become_filter(ab_planner& table) {
  table.name = "honest_filter";
  table.summary = "Lets all commands pass.";
  table.needs = AB_INPUT_STATE | AB_INPUT_COMMAND;
  table.commands = AB_COMMAND_POSITION | AB_COMMAND_VELOCITY | AB_COMMAND_ACCELERATION |
                   AB_COMMAND_TRAJECTORY | AB_COMMAND_RATES;
  table.plan = pass_on;
}

}  // namespace honest

/// Exports it after `change` was made to it.
#define HONEST_FILTER(change) BAD_PLANNER(honest::become_filter(table); change)
