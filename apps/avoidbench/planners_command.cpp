#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "commands.hpp"
#include "conformance/conformance.hpp"
#include "conformance/planner_project.hpp"
#include "output.hpp"
#include "plugin/planner_library.hpp"
#include "plugin/planner_table.hpp"
#include "process/program.hpp"
#include "program_planner/planner_source.hpp"
#include "report/table_rows.hpp"
#include "yaml/yaml_values.hpp"

namespace avoidbench {
namespace {

using Name = std::pair<std::uint32_t, const char*>;

constexpr Name kSeen[] = {{AB_INPUT_STATE, "state"},
                          {AB_INPUT_DEPTH, "depth"},
                          {AB_INPUT_STEREO, "stereo"},
                          {AB_INPUT_COLOR, "color"},
                          {AB_INPUT_IMU, "imu"},
                          {AB_INPUT_STATES, "states"},
                          {AB_INPUT_REFERENCE, "reference"},
                          {AB_INPUT_POINTS, "points"},
                          {AB_INPUT_GOALS, "goals"},
                          {AB_INPUT_TRACKS, "tracks"},
                          {AB_INPUT_COMMAND, "command (filter)"},
                          {AB_INPUT_WORLD, "world (privileged)"}};
constexpr Name kUsed[] = {{AB_USES_PROCESSES, "processes"},
                          {AB_USES_DEVICES, "devices"},
                          {AB_USES_NETWORK, "network"},
                          {AB_USES_GLOBALS, "globals"}};
constexpr Name kCommands[] = {{AB_COMMAND_POSITION, "position"},
                              {AB_COMMAND_VELOCITY, "velocity"},
                              {AB_COMMAND_ACCELERATION, "acceleration"},
                              {AB_COMMAND_TRAJECTORY, "trajectory"},
                              {AB_COMMAND_RATES, "rates"}};

std::string bit_names(std::uint32_t bits, std::span<const Name> names) {
  std::vector<std::string> all;
  for (const auto& [bit, name] : names) {
    if ((bits & bit) != 0) all.emplace_back(name);
  }
  return joined(all);
}

void list(const OutputOptions& options) {
  std::vector<std::string> problems;
  std::string depends_on;
  Table table = make_list({"name", "version", "inputs", "commands", "parameters", "summary"});
  for (const PlannerDescription& planner : list_planners(problems)) {
    table.rows.push_back(make_row(planner.name, planner.version, bit_names(planner.needs, kSeen),
                                  bit_names(planner.commands, kCommands), planner.parameters.size(),
                                  planner.summary));
    for (std::size_t i = 1; i < planner.files.size(); ++i) {
      depends_on += planner.name + " depends on " + planner.files[i].name + " (SHA-256 " +
                    planner.files[i].digest.substr(0, 12) + ")\n";
    }
  }
  write_table(table, options);
  std::cout << std::flush;
  std::cerr << depends_on;
  for (const std::string& problem : problems) std::cerr << "warning: " << problem << '\n';
  if (!table.rows.empty()) return;
  std::cerr << "no planner on the search path:\n";
  for (const auto& folder : planner_search_path()) std::cerr << "  " << folder.string() << '\n';
}

std::string values_of(const ParameterDef& def) {
  if (def.kind == AB_TEXT) return "any text";
  if (def.kind == AB_CHOICE) return joined(def.choices, " | ");
  return "[" + number_text(def.lowest) + ", " + number_text(def.highest) + "]" +
         (def.kind == AB_INTEGER ? " whole" : "");
}

/// Which Python runs a planner's .py, and why that one. Throws InputError where there is none.
std::string python_of(const std::filesystem::path& file) {
  const char* named = std::getenv("AVOIDBENCH_PYTHON");
  const bool is_named = named != nullptr && *named != '\0';
  return words_to_start(file).front() +
         (is_named ? " (named by AVOIDBENCH_PYTHON)"
                   : " (the first of python3 on the PATH and /usr/bin/python3 that has NumPy; "
                     "AVOIDBENCH_PYTHON names another)");
}

void describe(const std::string& plugin, const OutputOptions& options) {
  const PlannerDescription planner = describe_planner(find_planner(plugin, "."));
  Table table = make_list({"parameter", "unit", "values", "default", "doc"});
  for (const ParameterDef& def : planner.parameters) {
    const bool is_text = def.kind == AB_TEXT || def.kind == AB_CHOICE;
    table.rows.push_back(make_row(def.name, def.unit, values_of(def),
                                  is_text ? def.preset_text : number_text(def.preset), def.doc));
  }
  if (!options.is_for_people()) return write_table(table, options);
  std::string text = planner.name + " " + planner.version + ": " + planner.summary + "\n";
  text += "  inputs    " + bit_names(planner.needs, kSeen) + "\n";
  const std::string cameras = camera_demand(planner);
  if (!cameras.empty()) text += "  cameras   " + cameras + "\n";
  const std::string used = bit_names(planner.needs, kUsed);
  if (!used.empty()) text += "  uses      " + used + " (beyond the sandbox)\n";
  text += "  commands  " + bit_names(planner.commands, kCommands) + "\n";
  for (const ProfileDef& profile : planner.profiles) {
    text += "  defaults  with " + profile.choice + ": " + profile.word + ":";
    std::string separator = " ";
    for (const auto& [name, number] : profile.numbers) {
      text += std::exchange(separator, ", ") + name + " " + number_text(number);
    }
    text += "\n";
  }
  if (planner.file.extension() == ".py") text += "  python    " + python_of(planner.file) + "\n";
  text += "  file      " + planner.file.string() + "\n";
  text += "  sha256    " + planner.file_digest + "\n";
  for (const PlannerFile& file : planner.files) {
    text += "  of        " + file.digest + "  " + file.name + "\n";
  }
  if (!table.rows.empty()) text += "\n" + format_table(table, TableFormat::table);
  write_text(text, options.output);
}

/// What a call takes, and why that is too long or not all.
void print_call_times(const std::filesystem::path& file) {
  const std::optional<CallTimes> times = measure_calls_isolated(file);
  if (!times) return;
  const auto ms = [](double time_s) { return significant_digits(1000.0 * time_s, 3) + " ms"; };
  std::cerr << "a call takes " << ms(times->wall_s) << " (most " << ms(times->most_wall_s)
            << ", CPU " << ms(times->cpu_s)
            << ") with an image of 160 × 120 px; larger ones may take longer\n";
  for (const std::string& concern :
       {lateness(*times, measured_plan_period_s(), 0.0), hidden_time(*times)}) {
    if (!concern.empty()) std::cerr << "warning: " << concern << '\n';
  }
}

void check(const std::string& plugin, const OutputOptions& options) {
  // A file of this name goes before the search path: `check my_planner.so` is what one types.
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(plugin, error);
  const std::filesystem::path file =
      is_file ? std::filesystem::path(plugin) : find_planner(plugin, ".");
  const std::vector<ConformanceResult> results = check_conformance_isolated(file);
  Table table = options.is_for_people()
                    ? make_list({"", "rule", "what is checked, or what was found"})
                    : make_list({"passed", "rule", "doc", "finding"});
  std::size_t failed = 0, untried = 0;
  for (const ConformanceResult& result : results) {
    untried += result.was_tried ? 0 : 1;
    failed += result.passed || !result.was_tried ? 0 : 1;
    const char* const mark = result.passed ? "✓" : result.was_tried ? "✗" : "–";
    table.rows.push_back(
        options.is_for_people()
            ? make_row(mark, result.name, result.passed ? result.doc : result.finding)
            : make_row(result.passed ? "true" : "false", result.name, result.doc, result.finding));
  }
  write_table(table, options);
  std::cout << std::flush;  // before what goes to stderr
  std::cerr << file.string() << ": " << results.size() - failed - untried << " of "
            << results.size() << " rules hold"
            << (untried > 0 ? ", " + std::to_string(untried) + " were not tried" : "")
            << (failed > 0 ? "" : ": it can be benchmarked") << '\n';
  for (const std::string& note : import_notes(file)) std::cerr << "note: " << note << '\n';
  if (failed > 0) throw CLI::RuntimeError(1);
  print_call_times(file);
}

/// In a folder of its name, or here.
void make_new(const std::string& name, const std::string& kind_word, bool is_here) {
  const std::map<std::string, ProjectKind> kinds{{"example", ProjectKind::example},
                                                 {"class", ProjectKind::cpp_class},
                                                 {"python", ProjectKind::python},
                                                 {"weights", ProjectKind::weights}};
  const ProjectKind kind = kinds.at(kind_word);
  const std::string folder = is_here ? "." : name;
  const std::filesystem::path templates = data_folder() / "planners" / "template";
  const std::vector<std::string> written = write_planner_project(name, kind, folder, templates);
  const std::string inside = is_here ? "" : name + "/";
  const std::string plugin =
      (std::filesystem::path(folder) / project_plugin(name, kind)).lexically_normal().string();
  std::cout << "wrote " << inside << joined(written) << ". Next:\n";
  if (!plugin.ends_with(".py")) {
    std::cout << "  cmake -S " << folder << " -B " << inside
              << "build -DCMAKE_PREFIX_PATH=" << installation_prefix().string() << '\n'
              << "  cmake --build " << inside << "build\n";
  }
  std::cout << "  avoidbench planners check " << (is_here ? "./" : "") << plugin << '\n'
            << "  avoidbench run " << inside << "sweep.yaml\n";
  if (!plugin.ends_with(".py")) return;
  try {
    const std::string python = python_of(plugin);
    std::cout << "It is run by " << python << '\n';
  } catch (const InputError& error) {
    std::cerr << "warning: " << error.what() << '\n';  // the project is written all the same
  }
}

struct WrapOptions {
  std::filesystem::path launch, workspace, folder;
  std::string name;
  std::vector<std::string> arguments;  ///< NAME:=VALUE, as for roslaunch
};

/// By the shim's own script: what it knows of topics files and messages stands in Python.
void wrap(const WrapOptions& options) {
  const std::filesystem::path script = data_folder() / "planners" / "ros_shim" / "wrap" / "wrap.py";
  std::vector<std::string> words{python_with({"yaml"}, "planners wrap"), "-B", script.string(),
                                 "--prefix=" + installation_prefix().string()};
  if (!options.workspace.empty()) words.push_back("--workspace=" + options.workspace.string());
  if (!options.folder.empty()) words.push_back("--folder=" + options.folder.string());
  if (!options.name.empty()) words.push_back("--name=" + options.name);
  words.insert(words.end(), {"--", options.launch.string()});
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::cout << std::flush;
  const int code = run_program(words, Standard::shown).code;
  if (code != 0) throw CLI::RuntimeError(code < 0 ? 1 : code);
}

void add_wrap_command(CLI::App& planners) {
  const auto options = std::make_shared<WrapOptions>();
  CLI::App* command =
      planners.add_subcommand("wrap",
                              "Make a planner from a ROS 1 launch file: write the CMakeLists.txt "
                              "and the topics.yaml that compile its nodes unchanged (docs/ros.md)");
  command->add_option("launch", options->launch, "Launch file of a catkin package")->required();
  command->add_option("arguments", options->arguments, "Its arguments: NAME:=VALUE");
  command
      ->add_option("--workspace", options->workspace,
                   "Folder of its packages [the src folder or repository above it]")
      ->option_text("FOLDER");
  command->add_option("--folder", options->folder, "Folder for the two files [NAME]")
      ->option_text("FOLDER");
  command->add_option("--name", options->name, "Planner's name [that of the launch file's package]")
      ->option_text("NAME");
  command->footer(
      "Sources are read, not changed; nothing is built or started. Both files mark what was "
      "guessed, and have\n"
      "a line to fill in for each value that can't be found.\n\n"
      "Example:\n"
      "  avoidbench planners wrap ~/catkin_ws/src/my_planner/launch/fly.launch max_vel:=3");
  command->callback([options] { wrap(*options); });
}

}  // namespace

void add_planners_command(CLI::App& app) {
  struct Options {
    std::string plugin, name, kind = "example";
    bool is_here = false;
    OutputOptions output;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("planners", "List, describe, check, create and wrap planners");
  command->footer(
      "Planners are looked up in AVOIDBENCH_PLANNER_PATH (folders separated by colons), the build "
      "tree's planners/\n"
      "and the install's plugin folder; a name with a slash is a file. Each is loaded in a "
      "separate process, which\n"
      "has 10 s to answer, or AVOIDBENCH_LOAD_LIMIT_S.\n\n"
      "Examples:\n"
      "  avoidbench planners list\n"
      "  avoidbench planners describe reactive\n"
      "  avoidbench planners check ./build/my_planner.so\n"
      "  avoidbench planners new my_planner\n"
      "  avoidbench planners wrap my_package/launch/fly.launch");
  CLI::App* list_command = command->add_subcommand("list", "All planners on the search path");
  CLI::App* describe_command =
      command->add_subcommand("describe", "A planner's inputs, commands and parameters");
  CLI::App* check_command = command->add_subcommand(
      "check",
      "Test a library against every rule of the planner interface, in a separate process, and "
      "measure its calls; exit code 1 if a rule fails");
  for (CLI::App* each : {list_command, describe_command, check_command}) {
    add_output_options(*each, options->output);
  }
  for (CLI::App* each : {describe_command, check_command}) {
    each->add_option("planner", options->plugin, "Name or file of a planner")->required();
  }
  CLI::App* new_command = command->add_subcommand(
      "new",
      "Write a small planner that builds and flies, as a starting point, and a sweep for it");
  new_command->add_option("name", options->name, "Of a-z, 0-9 and _; also the name of its folder")
      ->required();
  new_command->add_flag("--here", options->is_here,
                        "Folder to write into, instead of one of its name");
  new_command
      ->add_option("--kind", options->kind,
                   "example: in C++; class: your own C++ class, with plain inputs; python; "
                   "weights: a Python class with a network's weights")
      ->check(CLI::IsMember({"example", "class", "python", "weights"}))
      ->option_text("KIND [example]");
  new_command->callback([options] { make_new(options->name, options->kind, options->is_here); });
  add_wrap_command(*command);
  list_command->callback([options] { list(options->output); });
  describe_command->callback([options] { describe(options->plugin, options->output); });
  check_command->callback([options] { check(options->plugin, options->output); });
}

}  // namespace avoidbench
