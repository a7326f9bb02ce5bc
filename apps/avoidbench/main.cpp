#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/visible_text.hpp"
#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "help_text.hpp"
#include "plugin/planner_library.hpp"
#include "version.hpp"
#include "visible_streams.hpp"

namespace avoidbench {
namespace {

constexpr int kUsageError = 2, kOurError = 3;

std::string version_text() {
  return std::string("avoidbench ") + kVersion + " (" + kGitHash + ")\nbuilt with " + kCompiler +
         ", " + kCompilerFlags;
}

/// What CITATION.cff says, for LaTeX.
std::string citation_text() {
  return std::string(
             "@software{avoidbench,\n"
             "  title   = {avoidbench: a headless, reproducible benchmark of "
             "obstacle-avoidance planners for multirotors},\n"
             "  author  = {{avoidbench contributors}},\n"
             "  version = {") +
         kVersion + " (" + kGitHash +
         ")},\n"
         "}\n\n"
         "% The benchmark's maps and metrics:\n"
         "@article{yu2023avoidbench,\n"
         "  title   = {{AvoidBench}: A high-fidelity vision-based obstacle avoidance benchmarking "
         "suite for multi-rotors},\n"
         "  author  = {Yu, Hang and de Croon, Guido C. H. E. and De Wagter, Christophe},\n"
         "  journal = {arXiv preprint arXiv:2301.07430},\n"
         "  year    = {2023},\n"
         "  url     = {https://arxiv.org/abs/2301.07430},\n"
         "}\n";
}

/// The subcommand that the words of the command line led to.
const CLI::App& deepest(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : deepest(*chosen.front());
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : visible_commands(app)) names.push_back(command->get_name());
  return names;
}

/// Our option for one that other programs have, "" if there is none: no spelling leads there.
std::string option_elsewhere(const std::string& name) {
  for (const std::string_view jobs :
       {"-j", "--workers", "--threads", "--parallel", "--processes"}) {
    if (name == jobs) return "--jobs";
  }
  return "";
}

std::string unknown_option(const CLI::App& app, const std::string& name) {
  const std::vector<std::string> ours = option_spellings(app);
  const std::string meant = option_elsewhere(name);
  const bool is_ours = std::find(ours.begin(), ours.end(), meant) != ours.end();
  return "unknown option " + name +
         (is_ours ? " (did you mean " + meant + "?)" : did_you_mean(name, ours));
}

/// What is wrong with a word that nothing on the command line takes.
std::string unknown_word(const CLI::App& app, const std::string& word) {
  if (word.starts_with("-")) return unknown_option(app, word.substr(0, word.find('=')));
  const std::vector<std::string> commands = command_names(app);
  if (commands.empty()) return "unexpected argument '" + word + "'";
  return "unknown command '" + word + "'" + did_you_mean(word, commands) +
         "; commands: " + joined(commands);
}

/// Prints what is wrong with the command line and returns the exit code.
int explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = deepest(app);
  const std::vector<std::string> unknown = app.remaining(true);
  bool is_value = false;
  for (const std::string& word : unknown) {
    const bool is_option = word.starts_with("-");
    // The word after an option that is not known is its value, most likely: one message is enough.
    if (is_option || !is_value) std::cerr << unknown_word(command, word) << '\n';
    is_value = is_option && word.find('=') == std::string::npos;
  }
  if (unknown.empty()) std::cerr << error.what() << '\n';
  std::cerr << "see " << full_name(command) << " --help\n";
  return kUsageError;
}

void add_commands(CLI::App& app) {
  for (const auto& add :
       {add_run_command,     add_limit_command,    add_suite_command,   add_grade_command,
        add_report_command,  add_power_command,    add_predict_command, add_export_command,
        add_compare_command, add_replay_command,   add_explain_command, add_merge_command,
        add_import_command,  add_planners_command, add_maps_command,    add_sensors_command,
        add_metrics_command, add_config_command,   add_help_command,    add_completion_command}) {
    add(app);
  }
}

/// Help says what an option is where it is not given, but for lists without anything in them.
void show_defaults(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (!option->get_required()) option->capture_default_str();
    if (option->get_default_str() == "[]") option->default_str("");
  }
  for (CLI::App* command : app.get_subcommands({})) show_defaults(*command);
}

int run_program(int argc, const char* const* argv) {
  CLI::App app("Benchmark of obstacle-avoidance planners for multirotors.", "avoidbench");
  app.formatter(std::make_shared<WrappedHelp>());
  app.set_version_flag("--version", version_text(), "Print version, git hash and compiler");
  app.add_flag_callback(
      "--cite",
      [] {
        std::cout << citation_text();
        throw CLI::Success();
      },
      "Print what to cite, as BibTeX");
  app.require_subcommand(0, 1);  // so that `config explain maps` means the key, not the command
  add_commands(app);
  show_defaults(app);
  add_worker_command(app);
  add_run_page_command(app);
  // After the commands, which would take it over.
  app.footer(
      "First steps:\n"
      "  avoidbench run quick             fly a small sweep\n"
      "  avoidbench report                see its results\n"
      "  avoidbench config sweeps         other sweeps that come with it\n"
      "  avoidbench config defaults       every key of a sweep file\n"
      "  avoidbench planners new NAME     write a first planner\n"
      "  avoidbench suite list            frozen maps, to compare it with others\n\n"
      "Exit codes: 0 done, 1 done but a check failed, 2 usage or input, 3 an error of this "
      "program");
  try {
    // argc may be 0.
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::RuntimeError& stop) {
    return stop.get_exit_code();
  } catch (const CLI::Success& answer) {  // --help, --version
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    return explain(app, error);
  }
  const CLI::App& command = deepest(app);
  if (command_names(command).empty()) return 0;
  std::cerr << command.help();  // one of its subcommands is missing
  return kUsageError;
}

/// What the system has no more of, where that is what went wrong; else "".
std::string shortage(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return "out of memory: the system gives this program no more (ulimit -v, or the limit of a "
           "container or of the machine)";
  }
  const auto* of_system = dynamic_cast<const std::system_error*>(&error);
  if (of_system == nullptr || of_system->code() != std::errc::resource_unavailable_try_again) {
    return "";
  }
  return "the system can't start another process or thread (ulimit -u, or the limit of a "
         "container): raise the limit, or end other processes";
}

/// Runs the program, prints what is wrong with its input, and returns the exit code.
int guarded_program(int argc, const char* const* argv) {
  try {
    return run_program(argc, argv);
  } catch (const OptionError& error) {
    std::cerr << visible_line(option_message(error)) << '\n';
    return kUsageError;
  } catch (const InputError& error) {
    for (const InputProblem& problem : error.problems()) {
      std::cerr << visible_line(text(problem)) << '\n';
    }
    return kUsageError;
  } catch (const std::exception& error) {
    if (const std::string text = shortage(error); !text.empty()) {
      std::cerr << text << '\n';
      return kUsageError;
    }
    std::cerr << "avoidbench: an error of this program, not of its input: " << error.what() << '\n';
    return kOurError;
  }
}

}  // namespace
}  // namespace avoidbench

int main(int argc, char** argv) {
  avoidbench::make_streams_visible();
  const int code = avoidbench::guarded_program(argc, argv);
  std::cout.flush();
  // Planners' destructors may change the code, or hang.
  if (avoidbench::PlannerLibrary::is_any_loaded()) {
    std::fflush(nullptr);
    ::_exit(code);
  }
  return code;
}
