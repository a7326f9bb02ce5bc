#include <string_view>

#include "base/check.hpp"
#include "conformance/conformance_run.hpp"
#include "process/isolated_run.hpp"

// The child writes one message before and one after each rule: fields that end with kFieldEnd,
// closed by kMessageEnd.
namespace avoidbench {
namespace {

// Unit and record separator of ASCII: no text for people has them, and send() takes them out.
constexpr char kFieldEnd = '\x1f';
constexpr char kMessageEnd = '\x1e';

void send(IsolatedOutput& output, char what, const ConformanceResult& result) {
  std::string message(1, what);
  for (std::string field :
       {result.name, result.doc, result.finding, std::string(result.was_tried ? "tried" : "")}) {
    std::erase_if(field, [](char c) { return c == kFieldEnd || c == kMessageEnd; });
    message += kFieldEnd;
    message += field;
  }
  output.write(message + kMessageEnd);
}

ConformanceResult parsed(std::string_view message) {
  std::vector<std::string> fields(1);
  for (const char c : message) {
    if (c == kFieldEnd) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  AB_CHECK(fields.size() == 5, fields.size());
  return {fields[1], fields[2], fields[3].empty(), fields[3], !fields[4].empty()};
}

using RunRules = std::function<void(const OnRule& begin, const OnRule& end)>;

/// Appends what comes of the rules that `run_rules` tries in a process of their own. Whether that
/// came to its end.
bool run_apart(const RunRules& run_rules, double time_limit_s,
               std::vector<ConformanceResult>& results) {
  const IsolatedEnd run = run_isolated(
      [&](IsolatedOutput& output) {
        run_rules([&](const ConformanceResult& rule) { send(output, 'b', rule); },
                  [&](const ConformanceResult& rule) { send(output, 'e', rule); });
      },
      // Shown: who checks a planner wants to see what it prints.
      time_limit_s, Prints::shown);

  std::optional<ConformanceResult> tried;
  // A message that was cut off by a crash has no end and is left out.
  std::string_view rest = run.output;
  for (std::size_t end = rest.find(kMessageEnd); end != std::string_view::npos;
       end = rest.find(kMessageEnd)) {
    const std::string_view message = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (message.front() == 'b') {
      tried = parsed(message);
    } else {
      tried.reset();
      results.push_back(parsed(message));
    }
  }
  // A rule that was begun and never ended is what the planner did not survive.
  if (tried) {
    tried->passed = false;
    tried->finding = run.problem;
    results.push_back(*tried);
  } else if (!run.problem.empty()) {
    results.push_back({"ends", "The check comes to its end.", false, run.problem});
  }
  return run.problem.empty();
}

}  // namespace

std::vector<ConformanceResult> check_conformance_isolated(const std::filesystem::path& file,
                                                          double time_limit_s) {
  std::vector<ConformanceResult> results;
  const bool has_ended =
      run_apart([&](const OnRule& begin, const OnRule& end) { run_first_rules(file, begin, end); },
                time_limit_s, results);
  // The first is loading.
  if (!has_ended || results.empty() || !results.front().passed) return results;
  // By this process, which has not loaded the planner: its forks have all that it starts.
  const bool repeats = results.emplace_back(run_repeats_rule(file)).passed;
  run_apart(
      [&](const OnRule& begin, const OnRule& end) { run_other_rules(file, repeats, begin, end); },
      time_limit_s, results);
  return results;
}

}  // namespace avoidbench
