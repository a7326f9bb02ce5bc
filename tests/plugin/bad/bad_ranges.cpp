#include "avoidbench/planner.hpp"
#include "honest.hpp"

namespace {
constexpr ab_parameter kParameters[] = {
    avoidbench::parameter("speed_mps", "m/s", 30.0, 0.0, 20.0, "Preset above highest."),
    avoidbench::parameter("speed_mps", "m/s", 3.0, 20.0, 0.0, "Turned round."),
    avoidbench::choice_parameter("mode", "slow", "safe|fast", "Preset is no choice."),
    avoidbench::text_parameter("gain", "", "Sound."),
    avoidbench::text_parameter("gain", "", "Named twice."),
};
constexpr const ab_parameter* kPointers[] = {&kParameters[0], &kParameters[1], &kParameters[2],
                                             &kParameters[3], &kParameters[4]};
}  // namespace

BAD_PLANNER(table.parameters = kPointers; table.parameter_count = 5)
