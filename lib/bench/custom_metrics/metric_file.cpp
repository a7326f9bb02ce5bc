#include "custom_metrics/metric_file.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/data_folder.hpp"
#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "process/program.hpp"

namespace avoidbench {
namespace {

/// 1 MiB: nobody writes more SQL or Python for a metric.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 20U;

/// What scripts/custom_metrics.py printed: {"metrics": [{"name", "doc"}], "values": {KEY: [1.5,
/// null]}}.
ComputedMetrics metrics_from(const std::string& printed) {
  ComputedMetrics computed;
  // Throws json's own exceptions, which run_python() catches: whatever else stands on standard
  // output is not JSON.
  const nlohmann::json result = nlohmann::json::parse(printed);
  for (const nlohmann::json& metric : result.at("metrics")) {
    computed.metrics.push_back(described_metric(metric.at("name").get<std::string>(),
                                                metric.at("doc").get<std::string>()));
    computed.metrics.back().formula = "a function of the flight, in Python";
  }
  for (const auto& [key, numbers] : result.at("values").items()) {
    std::vector<double>& values = computed.values[key];
    for (const nlohmann::json& number : numbers) {
      values.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                        : number.get<double>());
    }
    if (values.size() != computed.metrics.size()) throw InputError("printed too few numbers");
  }
  return computed;
}

ComputedMetrics run_python(const std::filesystem::path& file, const Database& database) {
  // -B: no bytecode beside the user's file.
  const ProgramEnd end = run_program({python_with({"numpy"}, "metrics in Python need"), "-B",
                                      (data_folder() / "scripts" / "custom_metrics.py").string(),
                                      file.string(), database.path().string()},
                                     Standard::kept);
  // Python has written its traceback to standard error, which was left open to the user.
  if (end.code != 0) throw InputError("failed: see above");
  try {
    return metrics_from(end.output);
  } catch (const nlohmann::json::exception&) {
    throw InputError("printed something on standard output; print to sys.stderr");
  }
}

}  // namespace

ComputedMetrics computed_by(const std::filesystem::path& file, const Database& database) {
  const std::string text = read_input_file(file, kMostBytes);
  try {
    if (file.extension() != ".sql" && file.extension() != ".py") {
      throw InputError("is neither .sql nor .py");
    }
    ComputedMetrics computed =
        file.extension() == ".sql" ? query_metrics(database, text) : run_python(file, database);
    for (MetricRow& metric : computed.metrics) {
      const std::string source =
          // The digest tells later which text of the file gave the numbers.
          file.filename().string() + ", SHA-256 " + file_digest(file).substr(0, 12);
      metric.doc += " (" + source + ")";
      metric.source = source;
    }
    return computed;
  } catch (const InputError& error) {
    throw InputError(InputProblem{file.string(), 0, 0, error.what()});
  }
}

}  // namespace avoidbench
