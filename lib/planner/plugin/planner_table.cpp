#include "plugin/planner_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "base/number_text.hpp"
#include "base/utf8.hpp"
#include "plugin/command_check.hpp"

namespace avoidbench {
namespace {

// The structs as ABI 1 first had them: what is shorter can't be read, what is longer has fields
// that this host doesn't know.
constexpr std::size_t kLeastTableSize = offsetof(ab_planner, get_extension) + sizeof(void*);
constexpr std::size_t kLeastParameterSize = offsetof(ab_parameter, preset_text) + sizeof(char*);
constexpr std::size_t kProfilesEnd = offsetof(ab_planner, profiles) + sizeof(void*);
constexpr std::size_t kFovEnd = offsetof(ab_planner, least_fov_y_rad) + sizeof(double);
constexpr std::size_t kLeastProfileSize = offsetof(ab_profile, numbers) + sizeof(void*);
// A count beyond is rubbish: following it would read far behind the table.
constexpr std::uint32_t kMostParameters = 1000;
constexpr std::uint32_t kKnownNeeds =
    AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR | AB_INPUT_IMU |
    AB_INPUT_WORLD | AB_INPUT_STATES | AB_INPUT_REFERENCE | AB_INPUT_POINTS | AB_INPUT_TRACKS |
    AB_INPUT_ONE_CAMERA | AB_INPUT_GOALS | AB_INPUT_COMMAND | AB_USES_PROCESSES | AB_USES_DEVICES |
    AB_USES_NETWORK | AB_USES_GLOBALS;
constexpr std::uint32_t kKnownCommands = AB_COMMAND_POSITION | AB_COMMAND_VELOCITY |
                                         AB_COMMAND_ACCELERATION | AB_COMMAND_TRAJECTORY |
                                         AB_COMMAND_RATES;

constexpr std::size_t kMostNameBytes = 100, kMostTextBytes = 10'000;
constexpr const char* kNameRule = "a name has 1 to 100 characters of a-z, 0-9 and _";

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= kMostNameBytes &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

std::string in_quotes(const char* text) {
  return text != nullptr ? "'" + shortened(text, kMostNameBytes) + "'" : std::string("null");
}

/// "" for a text that may be shown; null is none.
std::string text_problem(const char* what, const char* text) {
  if (text == nullptr) return std::string(what) + " is null";
  if (::strnlen(text, kMostTextBytes + 1) <= kMostTextBytes) return "";
  return std::string(what) + " is longer than " + std::to_string(kMostTextBytes) + " bytes";
}

std::string number_problem(const ab_parameter& p) {
  if (!std::isfinite(p.lowest) || !std::isfinite(p.highest) || !std::isfinite(p.preset)) {
    return "lowest, highest and preset must be finite";
  }
  if (p.lowest > p.highest) return "lowest is above highest";
  if (p.preset < p.lowest || p.preset > p.highest) return "the preset is outside [lowest, highest]";
  const bool whole = std::floor(p.lowest) == p.lowest && std::floor(p.highest) == p.highest &&
                     std::floor(p.preset) == p.preset;
  if (p.kind == AB_INTEGER && !whole)
    return "an integer's lowest, highest and preset must be whole";
  return "";
}

std::string choice_problem(const ab_parameter& p) {
  if (p.choices == nullptr || p.preset_text == nullptr) return "choices or preset_text is null";
  const std::vector<std::string> words = choice_words(p.choices);
  for (const std::string& word : words) {
    if (word.empty()) return "an empty word in choices '" + std::string(p.choices) + "'";
  }
  const bool known = std::find(words.begin(), words.end(), p.preset_text) != words.end();
  return known ? "" : "the preset '" + std::string(p.preset_text) + "' is not one of the choices";
}

/// In this order: each pointer is looked at before it is followed.
std::string parameter_problem(const ab_parameter* p) {
  if (p == nullptr) return "is null";
  if (p->struct_size < kLeastParameterSize) {
    return "has struct_size " + std::to_string(p->struct_size) + ", less than " +
           std::to_string(kLeastParameterSize);
  }
  if (p->name == nullptr || !is_plain_name(p->name)) {
    return "has the name " + in_quotes(p->name) + "; " + kNameRule;
  }
  std::string problem = text_problem("unit", p->unit);
  if (problem.empty()) problem = text_problem("doc", p->doc);
  if (problem.empty() && p->choices != nullptr) problem = text_problem("choices", p->choices);
  if (problem.empty() && p->preset_text != nullptr) {
    problem = text_problem("preset_text", p->preset_text);
  }
  if (!problem.empty()) return in_quotes(p->name) + ": " + problem;
  switch (p->kind) {
    case AB_NUMBER:
    case AB_INTEGER:
      problem = number_problem(*p);
      break;
    case AB_CHOICE:
      problem = choice_problem(*p);
      break;
    case AB_TEXT:
      problem = p->preset_text == nullptr ? "preset_text is null" : "";
      break;
    default:
      problem = "kind " + std::to_string(p->kind) + " is unknown";
  }
  return problem.empty() ? "" : in_quotes(p->name) + ": " + problem;
}

/// All of them, so that an author mends them in one go.
void add_parameter_problems(const ab_planner& table, std::vector<std::string>& problems) {
  if (table.parameter_count > kMostParameters) {
    problems.push_back(std::to_string(table.parameter_count) + " parameters: more than " +
                       std::to_string(kMostParameters));
    return;
  }
  if (table.parameter_count > 0 && table.parameters == nullptr) {
    problems.emplace_back("parameters is null");
    return;
  }
  std::set<std::string> names;
  for (std::uint32_t i = 0; i < table.parameter_count; ++i) {
    const std::string problem = parameter_problem(table.parameters[i]);
    if (!problem.empty()) {
      problems.push_back("parameter " + std::to_string(i) + " " + problem);
    } else if (!names.insert(table.parameters[i]->name).second) {
      problems.push_back("two parameters are named " + in_quotes(table.parameters[i]->name));
    }
  }
}

/// The table's profiles; none in tables that were made before there were any.
std::span<const ab_profile* const> profiles_of(const ab_planner& table) {
  if (table.struct_size < kProfilesEnd || table.profiles == nullptr) return {};
  return {table.profiles, table.profile_count};
}

/// Of a table whose parameters are sound.
const ab_parameter* parameter_of(const ab_planner& table, const char* name) {
  if (name == nullptr) return nullptr;
  for (std::uint32_t i = 0; i < table.parameter_count; ++i) {
    if (std::string_view(table.parameters[i]->name) == name) return table.parameters[i];
  }
  return nullptr;
}

std::string profile_problem(const ab_planner& table, const ab_profile* profile) {
  if (profile == nullptr) return "is null";
  if (profile->struct_size < kLeastProfileSize) {
    return "has struct_size " + std::to_string(profile->struct_size) + ", less than " +
           std::to_string(kLeastProfileSize);
  }
  const ab_parameter* choice = parameter_of(table, profile->choice);
  if (choice == nullptr || choice->kind != AB_CHOICE) {
    return "is of " + in_quotes(profile->choice) + ", which is not a choice parameter";
  }
  const std::vector<std::string> words = choice_words(choice->choices);
  if (profile->word == nullptr ||
      std::find(words.begin(), words.end(), profile->word) == words.end()) {
    return "is of the word " + in_quotes(profile->word) + ", which is not a choice of '" +
           choice->name + "'";
  }
  // Each is of another parameter.
  if (profile->number_count > table.parameter_count) return "has more numbers than parameters";
  if (profile->number_count > 0 && profile->numbers == nullptr) return "has null for its numbers";
  for (std::uint32_t i = 0; i < profile->number_count; ++i) {
    const auto& [name, number] = profile->numbers[i];
    const ab_parameter* parameter = parameter_of(table, name);
    const bool is_number =
        parameter != nullptr && (parameter->kind == AB_NUMBER || parameter->kind == AB_INTEGER);
    if (!is_number) return "has " + in_quotes(name) + ", which is not a numeric parameter";
    const bool is_whole = parameter->kind == AB_NUMBER || std::floor(number) == number;
    // Negated, so that NaN is refused.
    if (!(number >= parameter->lowest && number <= parameter->highest) || !is_whole) {
      return "has a number for '" + std::string(name) + "' that the parameter can't have";
    }
  }
  return "";
}

void add_profile_problems(const ab_planner& table, std::vector<std::string>& problems) {
  if (table.struct_size < kProfilesEnd || table.profile_count == 0) return;
  if (table.profiles == nullptr || table.profile_count > kMostParameters) {
    problems.emplace_back("profiles is null, or there are more than " +
                          std::to_string(kMostParameters));
    return;
  }
  std::set<std::pair<std::string, std::string>> words;
  for (std::uint32_t i = 0; i < table.profile_count; ++i) {
    std::string problem = profile_problem(table, table.profiles[i]);
    if (problem.empty() &&
        !words.emplace(table.profiles[i]->choice, table.profiles[i]->word).second) {
      problem = "is the second of its word";
    }
    if (!problem.empty()) problems.push_back("profile " + std::to_string(i) + " " + problem);
  }
}

/// A demand on cameras that is never made would be one that nobody checks.
void add_camera_problems(const ab_planner& table, std::vector<std::string>& problems) {
  const bool has_fov = table.struct_size >= kFovEnd &&
                       (table.least_fov_x_rad != 0.0 || table.least_fov_y_rad != 0.0);
  if (has_fov) {
    for (const double fov_rad : {table.least_fov_x_rad, table.least_fov_y_rad}) {
      if (fov_rad >= 0.0 && fov_rad < math::kPi) continue;
      problems.emplace_back("its least field of view is not within [0, π)");
    }
  }
  if (sees_images(table.needs)) return;
  if ((table.needs & AB_INPUT_ONE_CAMERA) != 0 || has_fov) {
    problems.emplace_back("it says which cameras it can fly with, but sees no images");
  }
}

/// The files that the planner says it depends on. A table that is none is passed over: a planner
/// may answer any name of an extension with something of its own.
const ab_files* files_of(const ab_planner& table) {
  if (table.get_extension == nullptr) return nullptr;
  // Null, since there is no instance yet (planner.h).
  const auto* files =
      static_cast<const ab_files*>(table.get_extension(nullptr, AB_FILES_EXTENSION));
  const bool is_table = files != nullptr && files->struct_size >= sizeof(ab_files);
  return is_table && files->files != nullptr ? files : nullptr;
}

std::vector<std::string> file_names_of(const ab_planner& table) {
  std::vector<std::string> names;
  const ab_files* files = files_of(table);
  for (std::uint32_t i = 0; files != nullptr && i < files->file_count; ++i) {
    if (files->files[i] != nullptr) names.emplace_back(files->files[i]);
  }
  return names;
}

/// A file that is left out would change nothing that trials are known by.
void check_files(const ab_planner& table, std::vector<std::string>& problems) {
  constexpr std::uint32_t kMostFiles = 1000;
  const ab_files* files = files_of(table);
  if (files == nullptr || files->file_count <= kMostFiles) return;
  problems.push_back("it names " + std::to_string(files->file_count) +
                     " files that it depends on; at most " + std::to_string(kMostFiles) +
                     " are followed");
}

std::string view_text(double fov_x_rad, double fov_y_rad) {
  const auto degrees = [](double rad) { return significant_digits(rad / math::kDegree, 3) + "°"; };
  return degrees(fov_x_rad) + " × " + degrees(fov_y_rad);
}

/// From edge to edge of the pixels.
double fov_rad(std::int32_t size_px, double focal_px) {
  return 2.0 * math::atan2(0.5 * size_px, focal_px);
}

}  // namespace

bool is_filter(const PlannerDescription& planner) {
  return (planner.needs & AB_INPUT_COMMAND) != 0;
}

std::string filter_alone_problem(const PlannerDescription& planner) {
  if (!is_filter(planner)) return "";
  return planner.name +
         " is a filter and flies only on top of a planner: write {plugin: PLANNER, " +
         "filter: " + planner.name + "}";
}

std::string filter_problem(const PlannerDescription& filter, const PlannerDescription& planner) {
  if (!is_filter(filter)) {
    return filter.name + " is not a filter: it does not declare AB_INPUT_COMMAND";
  }
  std::string missing;
  for (std::uint32_t kind = 1; kind <= kKnownCommands; kind <<= 1U) {
    if ((planner.commands & ~filter.commands & kind) == 0) continue;
    missing += (missing.empty() ? "" : ", ") + command_kind_text(kind);
  }
  if (missing.empty()) return "";
  return "filter " + filter.name + " does not take all commands of " + planner.name + ": " +
         missing + " (of a filter, `commands` are the kinds that it takes and gives)";
}

/// Nothing between two bars is a word, too, for choice_problem() to refuse.
std::vector<std::string> choice_words(const std::string& choices) {
  std::vector<std::string> words(1);
  for (const char c : choices) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::vector<std::string> table_problems(const ab_planner& table) {
  // Nothing else is looked at where the layout is not known.
  if (table.struct_size < kLeastTableSize) {
    return {"its table has struct_size " + std::to_string(table.struct_size) + ", less than the " +
            std::to_string(kLeastTableSize) + " bytes of ABI " +
            std::to_string(AVOIDBENCH_ABI_VERSION)};
  }
  if (table.abi_version != AVOIDBENCH_ABI_VERSION) {
    return {"its table is of ABI " + std::to_string(table.abi_version) +
            ", this program needs ABI " + std::to_string(AVOIDBENCH_ABI_VERSION)};
  }
  std::vector<std::string> problems;
  if (table.name == nullptr || !is_plain_name(table.name)) {
    problems.push_back("its name is " + in_quotes(table.name) + "; " + kNameRule);
  }
  for (const std::string& problem :
       {text_problem("its version", table.version), text_problem("its summary", table.summary)}) {
    if (!problem.empty()) problems.push_back(problem);
  }
  // An unknown bit may ask for what this host does not give.
  const auto check_bits = [&](const char* what, std::uint32_t bits, std::uint32_t known) {
    if (bits == 0) problems.push_back(std::string("it declares no ") + what);
    if ((bits & ~known) != 0) {
      problems.push_back(std::string("its ") + what + " have bits that ABI " +
                         std::to_string(AVOIDBENCH_ABI_VERSION) + " doesn't know");
    }
  };
  check_bits("needs", table.needs, kKnownNeeds);
  check_bits("commands", table.commands, kKnownCommands);
  const auto check_function = [&](const char* what, bool there) {
    if (!there) problems.push_back(std::string("its function ") + what + " is null");
  };
  check_function("create", table.create != nullptr);
  check_function("destroy", table.destroy != nullptr);
  check_function("reset", table.reset != nullptr);
  check_function("plan", table.plan != nullptr);
  add_camera_problems(table, problems);
  const std::size_t before = problems.size();
  add_parameter_problems(table, problems);
  // Profiles name parameters, so these must be sound first.
  if (problems.size() == before) add_profile_problems(table, problems);
  if (problems.empty()) check_files(table, problems);
  return problems;
}

void require_sound_table(const std::filesystem::path& file, const ab_planner& table) {
  std::vector<InputProblem> problems;
  for (const std::string& problem : table_problems(table)) {
    problems.push_back({.file = file.string(), .message = problem});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// All is copied: descriptions go from process to process and outlive the table.
PlannerDescription describe_table(const ab_planner& table) {
  PlannerDescription planner;
  planner.name = table.name;
  planner.version = table.version;
  planner.summary = table.summary;
  planner.needs = table.needs;
  planner.commands = table.commands;
  for (std::uint32_t i = 0; i < table.parameter_count; ++i) {
    const ab_parameter& p = *table.parameters[i];
    ParameterDef def;
    def.name = p.name;
    def.unit = p.unit;
    def.doc = p.doc;
    def.kind = p.kind;
    def.lowest = p.lowest;
    def.highest = p.highest;
    def.preset = p.preset;
    if (p.kind == AB_CHOICE) def.choices = choice_words(p.choices);
    // Of numbers it may be null.
    if (p.preset_text != nullptr) def.preset_text = p.preset_text;
    planner.parameters.push_back(std::move(def));
  }
  if (table.struct_size >= kFovEnd) {
    planner.least_fov_x_rad = table.least_fov_x_rad;
    planner.least_fov_y_rad = table.least_fov_y_rad;
  }
  planner.file_names = file_names_of(table);
  for (const ab_profile* profile : profiles_of(table)) {
    ProfileDef& def = planner.profiles.emplace_back(ProfileDef{profile->choice, profile->word, {}});
    for (std::uint32_t i = 0; i < profile->number_count; ++i) {
      def.numbers.push_back({profile->numbers[i].name, profile->numbers[i].number});
    }
  }
  return planner;
}

std::string own_problem(const ab_planner& table) {
  if (table.get_extension == nullptr) return "";
  const auto* check =
      static_cast<const ab_check*>(table.get_extension(nullptr, AB_CHECK_EXTENSION));
  if (check == nullptr || check->struct_size < sizeof(ab_check) || check->problem == nullptr) {
    return "";
  }
  const char* problem = check->problem();
  return problem == nullptr ? "" : problem;
}

bool sees_images(std::uint32_t needs) {
  return (needs & (AB_INPUT_DEPTH | AB_INPUT_STEREO | AB_INPUT_COLOR)) != 0;
}

std::string camera_demand(const PlannerDescription& planner) {
  std::string text = (planner.needs & AB_INPUT_ONE_CAMERA) != 0 ? "one" : "";
  if (planner.least_fov_x_rad > 0.0 || planner.least_fov_y_rad > 0.0) {
    text += (text.empty() ? "" : ", ") +
            view_text(planner.least_fov_x_rad, planner.least_fov_y_rad) + " or more";
  }
  return text;
}

std::string sensor_problem(const PlannerDescription& planner, const PlannerSetup& setup) {
  const std::vector<CameraSetup>& cameras = setup.cameras;
  const bool sees_points = (planner.needs & AB_INPUT_POINTS) != 0;
  const bool has_points = sees_points && !setup.lidars.empty();
  if (sees_images(planner.needs) && cameras.empty() && !has_points) {
    return sees_points ? "it has neither a camera nor a lidar" : "it has no camera";
  }
  if (sees_points && !sees_images(planner.needs) && !has_points) return "it has no lidar";
  // Who sees no images is given no camera.
  if (!sees_images(planner.needs)) return "";
  if ((planner.needs & AB_INPUT_ONE_CAMERA) != 0 && cameras.size() > 1) {
    return "it handles one camera and gets " + std::to_string(cameras.size());
  }
  constexpr double kRounding_rad = 1e-6;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double x_rad = fov_rad(cameras[i].width_px, cameras[i].fx_px);
    const double y_rad = fov_rad(cameras[i].height_px, cameras[i].fy_px);
    if (x_rad >= planner.least_fov_x_rad - kRounding_rad &&
        y_rad >= planner.least_fov_y_rad - kRounding_rad) {
      continue;
    }
    return "it needs a view of " + view_text(planner.least_fov_x_rad, planner.least_fov_y_rad) +
           " or more, and " + (cameras.size() > 1 ? "camera " + std::to_string(i) : "the camera") +
           " has " + view_text(x_rad, y_rad);
  }
  return "";
}

}  // namespace avoidbench
