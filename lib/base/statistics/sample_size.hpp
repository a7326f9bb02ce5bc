#pragma once

#include <cstdint>

namespace avoidbench {

/// Trials after which a rate is within `half_width` of the truth with this confidence, whatever it
/// is (Hoeffding 1963); round up.
double hoeffding_trials(double half_width, double confidence);

/// Trials a planner to tell success rates `rate_1` and `rate_2` apart by a two-sided test of level
/// `alpha` with this power (pooled variance under the hypothesis of equality); round up. Infinite
/// for equal rates.
double two_rates_trials(double rate_1, double rate_2, double power = 0.8, double alpha = 0.05);

/// Probability that Fisher's exact test finds p < `alpha` between `trials` trials at `rate_1` and
/// as many at `rate_2`: the sum over all outcomes. InputError for rates outside [0, 1].
double two_rates_power_exact(double rate_1, double rate_2, std::int64_t trials,
                             double alpha = 0.05);

/// The smallest number of trials a planner from which on Fisher's exact test has this power (it may
/// have it by luck at fewer, as the power is not monotonic), by two_rates_power_exact. Above 5,000
/// trials the approximation of Casagrande, Pike and Smith (1978), there right to 1 %. InputError
/// for rates that are equal or outside [0, 1].
std::int64_t two_rates_trials_exact(double rate_1, double rate_2, double power = 0.8,
                                    double alpha = 0.05);

/// The smallest number of missions, each flown by both planners, from which on McNemar's exact test
/// has this power, where the first succeeds at `rate`, the second at `rate + change`, and
/// `discordance` is the share of missions which one of them finishes and the other does not. Above
/// 20,000 missions the approximation of Connor (1987). InputError where no two planners are like
/// that.
std::int64_t paired_rates_trials(double rate, double change, double discordance, double power = 0.8,
                                 double alpha = 0.05);

/// The smallest number of trials whose Wilson interval reaches no more than `half_width` to each
/// side of its centre where the rate seen is `rate`.
std::int64_t wilson_width_trials(double rate, double half_width, double confidence = 0.95);

}  // namespace avoidbench
