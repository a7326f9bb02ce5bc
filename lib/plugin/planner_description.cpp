#include "plugin/planner_description.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <mutex>
#include <optional>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "plugin/planner_library.hpp"
#include "plugin/planner_table.hpp"
#include "process/isolated_run.hpp"

namespace avoidbench {
namespace {

using Json = nlohmann::json;

/// What the child says: a description, or what is wrong with the library.
struct Answer {
  std::optional<PlannerDescription> planner;
  std::vector<std::string> problems;
};

}  // namespace

template <class Visitor, ConstOr<ParameterDef> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name, "");
  v.field("unit", p.unit, "");
  v.field("doc", p.doc, "");
  v.field("kind", p.kind, "");
  v.field("lowest", p.lowest, "");
  v.field("highest", p.highest, "");
  v.field("preset", p.preset, "");
  v.field("choices", p.choices, "");
  v.field("preset_text", p.preset_text, "");
}

template <class Visitor, ConstOr<ProfileDef::Number> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name, "");
  v.field("number", p.number, "");
}

template <class Visitor, ConstOr<ProfileDef> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("choice", p.choice, "");
  v.field("word", p.word, "");
  v.field("numbers", p.numbers, "");
}

template <class Visitor, ConstOr<PlannerDescription> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name, "");
  v.field("version", p.version, "");
  v.field("summary", p.summary, "");
  v.field("needs", p.needs, "");
  v.field("commands", p.commands, "");
  v.field("parameters", p.parameters, "");
  v.field("profiles", p.profiles, "");
}

namespace {

constexpr double kTimeLimit_s = 10.0;
constexpr const char* kTimeLimitName = "AVOIDBENCH_LOAD_LIMIT_S";

double time_limit_s() {
  const char* given = std::getenv(kTimeLimitName);
  if (given == nullptr) return kTimeLimit_s;
  double limit_s = 0.0;
  const char* end = given + std::strlen(given);
  const auto [rest, error] = std::from_chars(given, end, limit_s);
  if (error != std::errc() || rest != end || !(limit_s > 0.0 && limit_s <= 3600.0)) {
    throw InputError(std::string(kTimeLimitName) + "=" + given +
                     ": expected seconds, above 0 and at most 3600");
  }
  return limit_s;
}

/// The child's part. In CBOR doubles keep their bits and texts may be of any encoding.
void describe(const std::filesystem::path& file, IsolatedOutput& output) {
  Json answer = Json::object();
  enter_sandbox({}, sandbox_support());  // what it needs is not known before it was loaded
  try {
    answer["planner"] = spec_to_json(PlannerLibrary::load_checked(file).description());
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      answer["problems"].push_back(problem.message);
    }
  } catch (const std::exception& error) {
    answer["problems"] = {std::string("threw an exception while it was loaded: ") + error.what()};
  } catch (...) {
    answer["problems"] = {"threw an exception while it was loaded"};
  }
  const std::vector<std::uint8_t> bytes = Json::to_cbor(answer);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (output.write(text)) return;
  const auto too_long = Json::to_cbor({{"problems", {"its description is longer than 4 MiB"}}});
  output.write({reinterpret_cast<const char*>(too_long.data()), too_long.size()});
}

/// Why the child has not answered.
std::string failure_text(const IsolatedEnd& end) {
  std::string text = end.problem + " while it was loaded";
  if (end.problem.starts_with("did not return")) {
    text += std::string(" (") + kTimeLimitName + " sets another limit)";
  }
  if (!end.last_words.empty()) text += "; it printed: " + end.last_words;
  return text;
}

Answer asked(const std::filesystem::path& file, double limit_s) {
  const IsolatedEnd end =
      run_isolated([&](IsolatedOutput& output) { describe(file, output); }, limit_s);
  if (!end.problem.empty()) return {std::nullopt, {failure_text(end)}};
  Answer answer;
  try {
    const Json json = Json::from_cbor(end.output);
    if (json.contains("planner")) {
      answer.planner = spec_from_json<PlannerDescription>(json.at("planner"));
      answer.planner->file = file;
    } else {
      answer.problems = json.at("problems").get<std::vector<std::string>>();
    }
  } catch (const Json::exception& error) {
    answer = {std::nullopt, {std::string("damaged its own description: ") + error.what()}};
  }
  return answer;
}

PlannerDescription description_from(const Answer& answer, const std::filesystem::path& file,
                                    const std::string& digest) {
  if (!answer.planner) {
    std::vector<InputProblem> problems;
    for (const std::string& problem : answer.problems) {
      problems.push_back({file.string(), 0, 0, problem});
    }
    throw InputError(std::move(problems));
  }
  PlannerDescription planner = *answer.planner;
  planner.file = file;
  planner.file_digest = digest;
  return planner;
}

}  // namespace

SandboxRules sandbox_rules(std::uint32_t needs) {
  return {.processes = (needs & AB_USES_PROCESSES) != 0,
          .devices = (needs & AB_USES_DEVICES) != 0,
          .network = (needs & AB_USES_NETWORK) != 0};
}

PlannerDescription describe_planner(const std::filesystem::path& file, double time_limit_s) {
  PlannerLibrary::check(file);
  const std::string digest = file_digest(file);
  return description_from(asked(file, time_limit_s), file, digest);
}

PlannerDescription describe_planner(const std::filesystem::path& file) {
  if (own_planner(file) != nullptr) return PlannerLibrary::load(file).description();
  static std::mutex mutex;
  // By path and digest: a planner is asked once a run, again when its file changes. Failures are
  // kept, too, since a hang costs the whole time limit.
  static std::map<std::pair<std::filesystem::path, std::string>, Answer> known;
  PlannerLibrary::check(file);
  const std::string digest = file_digest(file);
  const std::lock_guard lock(mutex);
  const auto key = std::make_pair(std::filesystem::absolute(file), digest);
  auto answer = known.find(key);
  if (answer == known.end()) answer = known.emplace(key, asked(file, time_limit_s())).first;
  return description_from(answer->second, file, digest);
}

}  // namespace avoidbench
