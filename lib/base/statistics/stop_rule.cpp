#include "statistics/stop_rule.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "statistics/rates.hpp"

namespace avoidbench {
namespace {

constexpr std::string_view kMeasure = "success_rate", kInterval = "ci", kSign = "<";
// Each look makes the interval a little too sure, and few looks stop late: ten are a compromise,
// and part of the rule, since they decide which trials are flown.
constexpr std::int64_t kLooks = 10;

void skip_spaces(std::string_view& text) {
  text.remove_prefix(std::min(text.size(), text.find_first_not_of(' ')));
}

bool take(std::string_view& text, std::string_view word) {
  skip_spaces(text);
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

}  // namespace

std::string StopRule::text() const {
  if (!is_set()) return "";
  return std::string(kMeasure) + " " + std::string(kInterval) + std::string(kSign) +
         shortest(half_width);
}

StopRule parse_stop_rule(const std::string& text) {
  std::string_view rest = text;
  StopRule rule;
  const bool has_words = take(rest, kMeasure) && take(rest, kInterval) && take(rest, kSign);
  skip_spaces(rest);
  const auto [end, error] =
      std::from_chars(rest.data(), rest.data() + rest.size(), rule.half_width);
  const bool is_number = error == std::errc{} && end == rest.data() + rest.size();
  if (!has_words || !is_number || !(rule.half_width > 0.0 && rule.half_width < 0.5)) {
    throw InputError("until: '" + text +
                     "' is not a rule; expected one like 'success_rate ci<0.05' (a planner stops "
                     "when its success rate is known to ± 0.05), with a number between 0 and 0.5");
  }
  return rule;
}

bool is_enough(const StopRule& rule, std::int64_t finished_count, std::int64_t trial_count) {
  if (!rule.is_set() || trial_count == 0) return false;
  const Interval interval = wilson_interval(finished_count, trial_count);
  return 0.5 * (interval.upper - interval.lower) < rule.half_width;
}

std::vector<std::int64_t> looks(std::int64_t mission_count) {
  std::vector<std::int64_t> counts;
  for (std::int64_t look = 1; look <= kLooks; ++look) {
    // Each tenth of the missions, rounded up; few missions have fewer looks.
    const std::int64_t count = (look * mission_count + kLooks - 1) / kLooks;
    if (counts.empty() || count > counts.back()) counts.push_back(count);
  }
  return counts;
}

}  // namespace avoidbench
