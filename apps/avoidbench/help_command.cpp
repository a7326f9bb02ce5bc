#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "base/input_error.hpp"
#include "base/words.hpp"
#include "command_options.hpp"
#include "commands.hpp"
#include "help_text.hpp"
#include "output.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

/// The command that these words name.
const CLI::App& named_command(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = &app;
  for (const std::string& word : words) {
    std::vector<std::string> names;
    const CLI::App* next = nullptr;
    for (const CLI::App* sub : visible_commands(*command)) {
      names.push_back(sub->get_name());
      if (sub->get_name() == word) next = sub;
    }
    if (next == nullptr) {
      throw InputError("'" + full_name(*command) + "' has no command '" + word + "'" +
                       did_you_mean(word, names) +
                       (names.empty() ? "" : "; commands: " + joined(names)));
    }
    command = next;
  }
  return *command;
}

/// avoidbench.1 and avoidbench-COMMAND.1 in a folder, for packages.
void write_manual_pages(const CLI::App& app, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  write_text(manual_page(app, kVersion), (folder / "avoidbench.1").string());
  for (const CLI::App* command : visible_commands(app)) {
    const std::string file = "avoidbench-" + command->get_name() + ".1";
    write_text(manual_page(*command, kVersion), (folder / file).string());
  }
}

struct HelpOptions {
  const CLI::App* app = nullptr;
  std::vector<std::string> words;
  bool is_manual = false;
  std::string folder, shell;
};

void print_help(const HelpOptions& options) {
  if (!options.folder.empty()) return write_manual_pages(*options.app, options.folder);
  const CLI::App& named = named_command(*options.app, options.words);
  const CLI::App* parent = named.get_parent();
  std::cout << (options.is_manual ? manual_page(named, kVersion)
                                  : named.help(parent == nullptr ? "" : full_name(*parent)));
}

void print_completion(const HelpOptions& options) {
  std::cout << completion_script(*options.app, options.shell);
}

}  // namespace

void add_help_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "help", "Help for a command, as its --help; manual pages", print_help);
  options.app = &app;
  command.add_option("command", options.words, "Words of a command, as suite run")
      ->type_name("WORD");
  command.add_flag("--man", options.is_manual, "Its manual page, as roff");
  command.add_option("--man-folder", options.folder, "Write all manual pages into this folder")
      ->type_name("FOLDER");
  command.footer(
      "Examples:\n"
      "  avoidbench help suite run\n"
      "  avoidbench help run --man | man -l -");
}

void add_completion_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "completion", "Completion of commands and options in bash, zsh or fish",
                  print_completion);
  options.app = &app;
  command.add_option("shell", options.shell, "bash, zsh or fish")->required();
  command.footer(
      "Examples:\n"
      "  source <(avoidbench completion bash)        # or in ~/.bashrc\n"
      "  avoidbench completion zsh > ~/.zfunc/_avoidbench\n"
      "  avoidbench completion fish > ~/.config/fish/completions/avoidbench.fish");
}

}  // namespace avoidbench
