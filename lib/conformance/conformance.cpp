#include "conformance/conformance.hpp"

#include "base/input_error.hpp"
#include "conformance/conformance_rules.hpp"
#include "conformance/conformance_run.hpp"

namespace avoidbench {

void run_conformance(const std::filesystem::path& file,
                     const std::function<void(const ConformanceResult&)>& begin,
                     const std::function<void(const ConformanceResult&)>& end) {
  ConformanceResult loading{
      "loads",
      "A shared library with the symbol, a whole table, sane names, ranges and "
      "function pointers.",
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
  if (!library) return;
  for (const ConformanceRule& rule : conformance_rules()) {
    ConformanceResult result{std::string(rule.name), std::string(rule.doc), false, ""};
    begin(result);
    try {
      result.finding = rule.finding(*library);
    } catch (...) {
      result.finding = "an exception crossed the interface";
    }
    result.passed = result.finding.empty();
    end(result);
  }
}

}  // namespace avoidbench
