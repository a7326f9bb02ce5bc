#include "conformance/conformance.hpp"

#include <algorithm>
#include <span>

#include "base/input_error.hpp"
#include "conformance/conformance_rules.hpp"
#include "conformance/conformance_run.hpp"
#include "conformance/repeats.hpp"

namespace avoidbench {
namespace {

/// How many rules come before `repeats`.
std::size_t first_count() {
  const std::span<const ConformanceRule> rules = conformance_rules();
  const auto compares = [](const ConformanceRule& rule) { return rule.compares_flights; };
  return static_cast<std::size_t>(std::find_if(rules.begin(), rules.end(), compares) -
                                  rules.begin());
}

void run_rules(const PlannerLibrary& library, std::span<const ConformanceRule> rules, bool repeats,
               const OnRule& begin, const OnRule& end) {
  for (const ConformanceRule& rule : rules) {
    ConformanceResult result{std::string(rule.name), std::string(rule.doc), false, ""};
    begin(result);
    if (rule.compares_flights && !repeats) {
      result.was_tried = false;
      result.finding = "not tried: its flights don't repeat";
      end(result);
      continue;
    }
    try {
      result.finding = rule.finding(library);
    } catch (...) {
      result.finding = "an exception crossed the interface";
    }
    result.passed = result.finding.empty();
    end(result);
  }
}

}  // namespace

bool run_first_rules(const std::filesystem::path& file, const OnRule& begin, const OnRule& end) {
  ConformanceResult loading{"loads",
                            "A shared library with the symbol, a complete table, sane names, "
                            "ranges and function pointers.",
                            false, ""};
  begin(loading);
  std::optional<PlannerLibrary> library;
  try {
    library = PlannerLibrary::load(file);
  } catch (const InputError& error) {
    loading.finding = error.what();
  }
  loading.passed = library.has_value();
  end(loading);
  // Every other rule calls it.
  if (!library) return false;
  run_rules(*library, conformance_rules().first(first_count()), true, begin, end);
  return true;
}

ConformanceResult run_repeats_rule(const std::filesystem::path& file) {
  ConformanceResult result = repeats_rule();
  result.finding = repeats_finding(file);
  result.passed = result.finding.empty();
  return result;
}

void run_other_rules(const std::filesystem::path& file, bool repeats, const OnRule& begin,
                     const OnRule& end) {
  const PlannerLibrary library = PlannerLibrary::load(file);
  run_rules(library, conformance_rules().subspan(first_count()), repeats, begin, end);
}

void run_conformance(const std::filesystem::path& file, const OnRule& begin, const OnRule& end) {
  if (!run_first_rules(file, begin, end)) return;
  begin(repeats_rule());
  const ConformanceResult repeats = run_repeats_rule(file);
  end(repeats);
  run_other_rules(file, repeats.passed, begin, end);
}

}  // namespace avoidbench
