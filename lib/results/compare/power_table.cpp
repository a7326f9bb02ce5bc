#include "compare/power_table.hpp"

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/normal_quantile.hpp"
#include "base/number_text.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "report/table_rows.hpp"
#include "statistics/rates.hpp"
#include "statistics/sample_size.hpp"

namespace avoidbench {
namespace {

std::string percent(double ratio) { return significant_digits(100.0 * ratio, 4) + " %"; }

/// Ranges are asked as "not within", so that NaN is refused too.
void check(const PowerQuestion& question) {
  const auto is_ratio = [](double value) { return value > 0.0 && value < 1.0; };
  if (!(question.success_rate > 0.0 && question.success_rate <= 1.0)) {
    throw OptionError(
        shortest(question.success_rate) + ": a success rate above 0 and not above 1, such as 0.9",
        "sr");
  }
  if (!(question.detect > 0.0 && question.detect < question.success_rate)) {
    throw OptionError(
        shortest(question.detect) + ": a loss between 0 and the success rate, such as 0.05",
        "detect");
  }
  if (!is_ratio(question.power) || !is_ratio(question.alpha) || question.power <= question.alpha) {
    throw InputError("power and level are between 0 and 1, the power above the level");
  }
  const double least = question.detect;
  if (question.discordance && !(*question.discordance >= least && *question.discordance <= 1.0)) {
    throw OptionError(
        shortest(*question.discordance) + ": at least the loss to find, and not above 1",
        "discordance");
  }
  if (question.trials && *question.trials < 1)
    throw OptionError(std::to_string(*question.trials) + ": at least 1", "trials");
}

/// The same question by several tests: they differ by what they assume.
Table needed_table(const PowerQuestion& question, double lower_rate, double discordance) {
  Table table = make_table("trials", "Trials per planner",
                           {{.name = "test", .header = "by", .place = Place::key},
                            {.name = "trial_count", .header = "trials"}});
  const double rate = question.success_rate;
  const auto add = [&](const char* test, auto trials) {
    table.rows.push_back(make_row(test, static_cast<std::int64_t>(std::ceil(trials))));
  };
  add("two rates, normal approximation",
      two_rates_trials(rate, lower_rate, question.power, question.alpha));
  add("two rates, Fisher's exact test",
      two_rates_trials_exact(rate, lower_rate, question.power, question.alpha));
  add("the same missions, McNemar's exact test",
      paired_rates_trials(rate, -question.detect, discordance, question.power, question.alpha));
  add("95 % interval of one rate of ± half the loss",
      wilson_width_trials(rate, 0.5 * question.detect));
  add("± the loss at any rate (Hoeffding, 95 %)", hoeffding_trials(question.detect, 0.95));
  return table;
}

/// The other direction: what a number of trials that one can afford tells.
Table found_table(const PowerQuestion& question, double lower_rate) {
  Table table = make_table("found", "With " + counted(*question.trials, "trial") + " per planner",
                           {{.name = "measure", .place = Place::key},
                            {.name = "value", .decimals = 3, .has_interval = true}});
  const double power =
      two_rates_power_exact(question.success_rate, lower_rate, *question.trials, question.alpha);
  table.rows.push_back(make_row("power of Fisher's exact test", power, Cell{}, Cell{}));
  for (const double rate : {question.success_rate, lower_rate}) {
    // A whole number of trials near the rate.
    const auto finished =
        static_cast<std::int64_t>(std::nearbyint(rate * static_cast<double>(*question.trials)));
    table.rows.push_back(make_row("a success rate of " + percent(rate), rate,
                                  wilson_interval(finished, *question.trials)));
  }
  return table;
}

}  // namespace

Section speed_power_section(const SweepSummary& pilot, double detect_mps, double power,
                            double alpha) {
  if (!(power > alpha && power < 1.0 && alpha > 0.0)) {
    throw InputError("power and level are between 0 and 1, the power above the level");
  }
  Table table = make_table(
      "maps", "Maps that each planner flies",
      {planner_column(),
       {.name = "other_planner", .header = "against", .place = Place::key},
       {.name = "pilot_difference_mps", .header = "Δ v90", .unit = "m/s", .has_interval = true},
       {.name = "spread_mps",
        .header = "spread",
        .unit = "m/s",
        .doc = "spread_mps: standard deviation of this difference over draws of the pilot's maps"},
       {.name = "map_count", .header = "maps"}});
  const auto pilot_maps = static_cast<double>(pilot.maps.size());
  const double quantiles = normal_quantile(1.0 - 0.5 * alpha) + normal_quantile(power);
  for (const Contrast& c : pilot.contrasts) {
    if (std::isnan(c.v90.spread_mps) || std::isnan(c.v90.difference_mps)) continue;
    // The variance falls with the number of maps.
    const double ratio = quantiles * c.v90.spread_mps / detect_mps;
    const double maps = std::max(static_cast<double>(kLeastMaps), pilot_maps * ratio * ratio);
    table.rows.push_back(make_row(pilot.planners[c.planner_1], pilot.planners[c.planner_2],
                                  c.v90.difference_mps, c.v90.interval, c.v90.spread_mps,
                                  static_cast<std::int64_t>(std::ceil(maps))));
  }
  if (table.rows.empty()) {
    throw InputError("sweep " + pilot.name +
                     ": no pair of planners with a v90 each (29 missions) "
                     "on five maps or more");
  }
  Section section{.name = "power"};
  section.title = "To tell two v90 apart that differ by " + shortest(detect_mps) +
                  " m/s with power " + percent(power) + " at a level of " + percent(alpha) +
                  " (two-sided), by sweep " + pilot.name + " of " +
                  counted(pilot.maps.size(), "map");
  section.tables.push_back(std::move(table));
  return section;
}

Section power_section(const PowerQuestion& question) {
  check(question);
  const double lower_rate = question.success_rate - question.detect;
  // Two planners that know nothing of each other differ where one finishes and the other does not:
  // p (1 − q) + q (1 − p).
  const double independent =
      question.success_rate * (1.0 - lower_rate) + lower_rate * (1.0 - question.success_rate);
  const double discordance = question.discordance.value_or(independent);
  Section section{.name = "power"};
  section.title = "To tell a success rate of " + percent(question.success_rate) + " from " +
                  percent(lower_rate) + " with power " + percent(question.power) +
                  " at a level of " + percent(question.alpha) + " (two-sided)";
  section.tables.push_back(needed_table(question, lower_rate, discordance));
  if (question.trials) section.tables.push_back(found_table(question, lower_rate));
  section.notes.emplace_back(
      "paired",
      "planners that fly the same missions end differently on " + percent(discordance) +
          " of them" +
          (question.discordance ? "" : ", as if independent; less if they fail on the same ones"));
  section.notes.emplace_back("maps",
                             "all this holds for trials that are alike: if maps differ much, more "
                             "maps help, and more missions per map hardly do");
  return section;
}

}  // namespace avoidbench
