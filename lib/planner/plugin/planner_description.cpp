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
#include <tuple>

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

// Between child and parent only: no person reads these names, so they have no docs.
template <class Visitor, ConstOr<ParameterDef> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name);
  v.field("unit", p.unit);
  v.field("doc", p.doc);
  v.field("kind", p.kind);
  v.field("lowest", p.lowest);
  v.field("highest", p.highest);
  v.field("preset", p.preset);
  v.field("choices", p.choices);
  v.field("preset_text", p.preset_text);
}

template <class Visitor, ConstOr<ProfileDef::Number> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name);
  v.field("number", p.number);
}

template <class Visitor, ConstOr<ProfileDef> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("choice", p.choice);
  v.field("word", p.word);
  v.field("numbers", p.numbers);
}

template <class Visitor, ConstOr<PlannerDescription> Spec>
void visit(Visitor& v, Spec& p) {
  v.field("name", p.name);
  v.field("version", p.version);
  v.field("summary", p.summary);
  v.field("needs", p.needs);
  v.field("commands", p.commands);
  v.field("parameters", p.parameters);
  v.field("profiles", p.profiles);
  v.field("least_fov_x_rad", p.least_fov_x_rad);
  v.field("least_fov_y_rad", p.least_fov_y_rad);
  v.field("file_names", p.file_names);
}

namespace {

// Loading runs constructors alone; what takes long belongs into create().
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
void describe(const PlannerSource& source, IsolatedOutput& output) {
  Json answer = Json::object();
  // What it needs is not known before it was asked; a program has at least to be started.
  const SandboxRules rules{.processes = PlannerLibrary::is_program(source)};
  enter_sandbox(rules, sandbox_support());
  try {
    const PlannerLibrary library = PlannerLibrary::load_checked(source);
    if (const std::string problem = own_problem(library.table()); !problem.empty()) {
      answer["problems"] = {"can't fly: " + problem};
    } else {
      answer["planner"] = spec_to_json(library.description());
    }
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
  // The size is IsolatedOutput::kMostBytes.
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

Answer asked(const PlannerSource& source, double limit_s) {
  find_python(source);
  const IsolatedEnd end =
      run_isolated([&](IsolatedOutput& output) { describe(source, output); }, limit_s);
  if (!end.problem.empty()) return {std::nullopt, {failure_text(end)}};
  Answer answer;
  try {
    const Json json = Json::from_cbor(end.output);
    if (json.contains("planner")) {
      answer.planner = spec_from_json<PlannerDescription>(json.at("planner"));
    } else {
      answer.problems = json.at("problems").get<std::vector<std::string>>();
    }
  } catch (const Json::exception& error) {
    // The planner shares the child's memory, so it may have written over the answer.
    answer = {std::nullopt, {std::string("damaged its own description: ") + error.what()}};
  }
  return answer;
}

PlannerDescription description_from(const Answer& answer, const PlannerSource& source) {
  if (!answer.planner) {
    std::vector<InputProblem> problems;
    for (const std::string& problem : answer.problems) {
      problems.push_back({source.file.string(), 0, 0, problem});
    }
    throw InputError(std::move(problems));
  }
  // A copy: the answer is kept as it came, for whoever asks next.
  PlannerDescription planner = *answer.planner;
  planner.file = source.file;
  planner.command = source.command;
  planner.is_program = PlannerLibrary::is_program(source);
  // By this process, from the files as they lie there: a planner can't say its own digest.
  planner.files = planner_files(source.file, planner.file_names);
  planner.file_digest = planner_digest(source.file, planner.files);
  return planner;
}

}  // namespace

SandboxRules sandbox_rules(std::uint32_t needs) {
  return {.processes = (needs & AB_USES_PROCESSES) != 0,
          .devices = (needs & AB_USES_DEVICES) != 0,
          .network = (needs & AB_USES_NETWORK) != 0};
}

std::vector<PlannerFile> planner_files(const std::filesystem::path& file,
                                       const std::vector<std::string>& names) {
  std::vector<PlannerFile> files;
  if (names.empty()) return files;
  files.push_back({file.filename().string(), file_digest(file)});
  for (const std::string& name : names) {
    try {
      files.push_back({name, file_digest(file.parent_path() / name)});
    } catch (const InputError& error) {
      throw InputError(
          {.file = file.string(),
           .message = "names a file that it depends on: " + std::string(error.what())});
    }
  }
  return files;
}

std::string planner_digest(const std::filesystem::path& file,
                           const std::vector<PlannerFile>& files) {
  if (files.empty()) return file_digest(file);
  // The name goes first, so that no file's own digest is that of several.
  Digest digest;
  digest.add(std::string_view(AB_FILES_EXTENSION)).add(files.front().digest);
  for (std::size_t i = 1; i < files.size(); ++i) {
    // Of an absolute path only the name: the same planner in another place is the same planner.
    const std::filesystem::path name(files[i].name);
    digest.add(name.is_absolute() ? name.filename().string() : files[i].name);
    digest.add(files[i].digest);
  }
  return digest.hex();
}

std::string digest_now(const std::filesystem::path& file, const std::vector<PlannerFile>& files) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < files.size(); ++i) names.push_back(files[i].name);
  return planner_digest(file, planner_files(file, names));
}

PlannerDescription describe_planner(const PlannerSource& source, double time_limit_s) {
  PlannerLibrary::check(source);
  return description_from(asked(source, time_limit_s), source);
}

PlannerDescription describe_planner(const PlannerSource& source) {
  static std::mutex mutex;
  // By path, command and digest: a planner is asked once a run, again when its file changes.
  // Failures are kept, too, since a hang costs the whole time limit.
  struct Known {
    Answer answer;
    std::string digest;  ///< with the files that it names: they may be what decides them
  };
  static std::map<std::tuple<std::filesystem::path, std::vector<std::string>, std::string>, Known>
      known;
  PlannerLibrary::check(source);
  const std::lock_guard lock(mutex);
  const auto key = std::make_tuple(std::filesystem::absolute(source.file), source.command,
                                   file_digest(source.file));
  auto found = known.find(key);
  if (found != known.end() && found->second.answer.planner) {
    // Digested anew: a file that it names may have changed.
    const PlannerDescription now = description_from(found->second.answer, source);
    if (now.file_digest == found->second.digest) return now;
    known.erase(found);
    found = known.end();
  }
  if (found == known.end()) {
    found = known.emplace(key, Known{asked(source, time_limit_s()), ""}).first;
  }
  const PlannerDescription planner = description_from(found->second.answer, source);
  found->second.digest = planner.file_digest;
  return planner;
}

}  // namespace avoidbench
