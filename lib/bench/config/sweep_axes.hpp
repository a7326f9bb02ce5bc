#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweep/sweep_spec.hpp"
#include "yaml/yaml_reader.hpp"

namespace avoidbench {

/// Reads the block `axes`, {path: values}, into sweep.axes. Values are checked as the field itself
/// would be.
void read_axes(const GivenValue& given, SweepSpec& sweep);

/// The axis of this path, or null.
Axis* axis_of(SweepSpec& sweep, const std::string& path);

/// Calls `visit` with each value that the sweep has for a path, which it may change: those of its
/// axis, of which the base has the first, or the base's own.
template <class T, class Visit>
void for_each_value(SweepSpec& sweep, const std::string& path, T& base, Visit&& visit) {
  Axis* axis = axis_of(sweep, path);
  if (axis == nullptr) return visit(base);
  for (nlohmann::json& json : axis->values) {
    T value = json.get<T>();
    visit(value);
    json = value;
  }
  base = axis->values.front().get<T>();
}

/// Calls `check` with the sweep's TrialSpecs, planners and missions aside: with every combination
/// of the axes where there are up to 4096, else with each axis moved alone.
void for_each_combination(const SweepSpec& sweep,
                          const std::function<void(const TrialSpec&)>& check);

/// The sensors that the sweep flies with, each once.
std::vector<SensorSpec> swept_sensors(const SweepSpec& sweep);

/// What of the sweep's missions asks for AB_INPUT_GOALS: "several goals", "a goal that moves"; ""
/// for nothing.
std::string goals_demand(const SweepSpec& sweep);

}  // namespace avoidbench
