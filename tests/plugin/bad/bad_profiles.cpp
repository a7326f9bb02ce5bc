#include "avoidbench/planner.hpp"
#include "honest.hpp"

namespace {
constexpr ab_parameter kSpeed =
    avoidbench::parameter("speed_mps", "m/s", 3.0, 0.0, 20.0, "A number.");
constexpr ab_parameter kCount = avoidbench::integer_parameter("rays", "", 3, 1, 9, "A count.");
constexpr ab_parameter kMode =
    avoidbench::choice_parameter("mode", "safe", "safe|fast", "A choice.");
constexpr const ab_parameter* kParameters[] = {&kSpeed, &kCount, &kMode};

constexpr std::array kTooFast{ab_named_number{"speed_mps", 30.0}};
constexpr std::array kHalf{ab_named_number{"rays", 2.5}};
constexpr std::array kUnknown{ab_named_number{"speed", 2.0}};
constexpr std::array kText{ab_named_number{"mode", 2.0}};
constexpr std::array kSound{ab_named_number{"speed_mps", 2.0}};
constexpr ab_profile kProfiles[] = {
    avoidbench::profile("mode", "fast", kTooFast), avoidbench::profile("mode", "fast", kHalf),
    avoidbench::profile("mode", "fast", kUnknown), avoidbench::profile("mode", "fast", kText),
    avoidbench::profile("rays", "fast", kSound),   avoidbench::profile("mode", "slow", kSound),
    avoidbench::profile("mode", "safe", kSound),   avoidbench::profile("mode", "safe", kSound)};
constexpr const ab_profile* kPointers[] = {&kProfiles[0], &kProfiles[1], &kProfiles[2],
                                           &kProfiles[3], &kProfiles[4], &kProfiles[5],
                                           &kProfiles[6], &kProfiles[7], nullptr};
}  // namespace

BAD_PLANNER(table.parameters = kParameters; table.parameter_count = 3; table.profiles = kPointers;
            table.profile_count = 9)
