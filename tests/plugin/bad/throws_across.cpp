#include <stdexcept>
#include <string>

#include "avoidbench/planner.hpp"
#include "honest.hpp"

// Exceptions that leave the C functions, where the parameter says.
namespace {

constexpr ab_parameter kWhere =
    avoidbench::choice_parameter("where", "plan", "create|reset|plan", "Which call throws.");
constexpr const ab_parameter* kPointers[] = {&kWhere};

struct Thrower {
  std::string where;
};

void throw_in(const std::string& where, const char* here) {
  if (where == here) throw std::runtime_error("thrown in " + where);
}

void* create(const ab_host*, const ab_setup* setup) {
  throw_in(setup->values[0]->text, "create");
  return new Thrower{setup->values[0]->text};
}
void destroy(void* instance) { delete static_cast<Thrower*>(instance); }
ab_status reset(void* instance, const ab_mission*) {
  throw_in(static_cast<Thrower*>(instance)->where, "reset");
  return AB_OK;
}
ab_status plan(void* instance, const ab_observation*, ab_command*) {
  throw_in(static_cast<Thrower*>(instance)->where, "plan");
  return AB_NO_PLAN;
}

}  // namespace

BAD_PLANNER(table.parameters = kPointers; table.parameter_count = 1; table.create = create;
            table.destroy = destroy; table.reset = reset; table.plan = plan)
