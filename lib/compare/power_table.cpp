#include "compare/power_table.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/input_error.hpp"
#include "report/table_rows.hpp"
#include "statistics/rates.hpp"
#include "statistics/sample_size.hpp"

namespace avoidbench {
namespace {

std::string percent(double ratio) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.4g %%", 100.0 * ratio);
  return buffer.data();
}

void check(const PowerQuestion& question) {
  const auto is_ratio = [](double value) { return value > 0.0 && value < 1.0; };
  if (!(question.success_rate > 0.0 && question.success_rate <= 1.0)) {
    throw InputError("--sr: a success rate above 0 and not above 1, such as 0.9");
  }
  if (!(question.detect > 0.0 && question.detect < question.success_rate)) {
    throw InputError("--detect: a loss between 0 and the success rate, such as 0.05");
  }
  if (!is_ratio(question.power) || !is_ratio(question.alpha) || question.power <= question.alpha) {
    throw InputError("--power and --alpha: between 0 and 1, the power above the level");
  }
  const double least = question.detect;
  if (question.discordance && !(*question.discordance >= least && *question.discordance <= 1.0)) {
    throw InputError("--discordance: at least the loss to find, and not above 1");
  }
  if (question.trials && *question.trials < 1) throw InputError("--trials: at least 1");
}

Table needed_table(const PowerQuestion& question, double lower_rate, double discordance) {
  Table table{.name = "trials", .title = "Trials per planner", .columns = {}, .rows = {}};
  table.columns = {{.name = "test", .header = "by", .unit = "", .doc = "", .place = Place::key},
                   {.name = "trial_count", .header = "trials", .unit = "", .doc = ""}};
  const auto add = [&](const std::string& test, double trials) {
    std::vector<Cell> row;
    append(row, test);
    append(row, static_cast<std::int64_t>(std::ceil(trials)));
    table.rows.push_back(std::move(row));
  };
  const double rate = question.success_rate;
  add("two rates, normal approximation",
      two_rates_trials(rate, lower_rate, question.power, question.alpha));
  add("two rates, Fisher's exact test", static_cast<double>(two_rates_trials_exact(
                                            rate, lower_rate, question.power, question.alpha)));
  add("the same missions, McNemar's exact test",
      static_cast<double>(paired_rates_trials(rate, -question.detect, discordance, question.power,
                                              question.alpha)));
  add("95 % interval of one rate of ± half the loss",
      static_cast<double>(wilson_width_trials(rate, 0.5 * question.detect)));
  add("± the loss whatever the rate (Hoeffding, 95 %)", hoeffding_trials(question.detect, 0.95));
  return table;
}

Table found_table(const PowerQuestion& question, double lower_rate) {
  Table table{.name = "found",
              .title = "With " + std::to_string(*question.trials) + " trials per planner",
              .columns = {},
              .rows = {}};
  table.columns = {
      {.name = "measure", .header = "", .unit = "", .doc = "", .place = Place::key},
      {.name = "value",
       .header = "value",
       .unit = "",
       .doc = "",
       .place = Place::value,
       .decimals = 3},
      {.name = "value_lower", .header = "", .unit = "", .doc = "", .place = Place::bound},
      {.name = "value_upper", .header = "", .unit = "", .doc = "", .place = Place::bound}};
  std::vector<Cell> row;
  append(row, std::string("power of Fisher's exact test"));
  append(row, two_rates_power_exact(question.success_rate, lower_rate, *question.trials,
                                    question.alpha));
  row.resize(4);
  table.rows.push_back(row);
  for (const double rate : {question.success_rate, lower_rate}) {
    row.clear();
    append(row, "a success rate of " + percent(rate));
    append(row, rate);
    const auto finished =
        static_cast<std::int64_t>(std::nearbyint(rate * static_cast<double>(*question.trials)));
    append(row, wilson_interval(finished, *question.trials));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

Section power_section(const PowerQuestion& question) {
  check(question);
  const double lower_rate = question.success_rate - question.detect;
  const double independent =
      question.success_rate * (1.0 - lower_rate) + lower_rate * (1.0 - question.success_rate);
  const double discordance = question.discordance.value_or(independent);
  Section section{.name = "power", .title = {}, .tables = {}, .notes = {}, .warnings = {}};
  section.title = "To tell a success rate of " + percent(question.success_rate) + " from " +
                  percent(lower_rate) + " with power " + percent(question.power) +
                  " at a level of " + percent(question.alpha) + " (two-sided)";
  section.tables.push_back(needed_table(question, lower_rate, discordance));
  if (question.trials) section.tables.push_back(found_table(question, lower_rate));
  section.notes.emplace_back(
      "paired",
      "planners that fly the same missions end differently on " + percent(discordance) +
          " of them" +
          (question.discordance ? ""
                                : ", as if one knew nothing of the other; less where they "
                                  "fail on the same ones (--discordance)"));
  section.notes.emplace_back("maps",
                             "all this is for trials that are alike: where maps differ much, more "
                             "maps help, more missions per map hardly");
  return section;
}

}  // namespace avoidbench
