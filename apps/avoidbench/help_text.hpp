#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace avoidbench {

/// Help that fits the terminal: lines wrap at its width, at 100 columns at most, under the place
/// where their description begins.
class WrappedHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

/// A command's subcommands that users see, in the order of its help.
std::vector<const CLI::App*> visible_commands(const CLI::App& app);

/// A command's options, each as "-j" or "--jobs".
std::vector<std::string> option_spellings(const CLI::App& app);

/// "avoidbench suite run".
std::string full_name(const CLI::App& app);

/// The manual page of a command with those of its subcommands as sections, as roff (man(7)).
std::string manual_page(const CLI::App& app, const std::string& version);

/// What completes command lines in a shell: bash, zsh or fish. Throws InputError for another.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace avoidbench
