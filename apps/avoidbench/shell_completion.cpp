#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "base/words.hpp"
#include "help_text.hpp"

namespace avoidbench {
namespace {

void for_each_command(const CLI::App& app, const std::function<void(const CLI::App&)>& done) {
  done(app);
  for (const CLI::App* command : visible_commands(app)) for_each_command(*command, done);
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

/// The tables of words that follow each command, as associative arrays: bash and zsh read them.
std::string word_tables(const CLI::App& app) {
  std::string commands, options;
  for_each_command(app, [&](const CLI::App& command) {
    const std::string key = "  ['" + full_name(command) + "']='";
    commands += key + joined(names_of(visible_commands(command)), " ") + "'\n";
    options += key + joined(option_spellings(command), " ") + "'\n";
  });
  return "declare -gA _avoidbench_commands=(\n" + commands +
         ")\ndeclare -gA _avoidbench_options=(\n" + options + ")\n";
}

constexpr std::string_view kBash = R"(
_avoidbench() {
  local current=${COMP_WORDS[COMP_CWORD]} command=avoidbench word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ " ${_avoidbench_commands[$command]} " != *" $word "* ]] || command+=" $word"
  done
  local words=${_avoidbench_commands[$command]}
  [[ $current != -* ]] || words=${_avoidbench_options[$command]}
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -o default -o bashdefault -F _avoidbench avoidbench
)";

constexpr std::string_view kZsh = R"(
_avoidbench() {
  local current=${words[CURRENT]} command=avoidbench word
  for word in "${(@)words[2,CURRENT-1]}"; do
    [[ " ${_avoidbench_commands[$command]} " != *" $word "* ]] || command+=" $word"
  done
  if [[ $current == -* ]]; then
    compadd -- ${=_avoidbench_options[$command]}
  elif [[ -n ${_avoidbench_commands[$command]} ]]; then
    compadd -- ${=_avoidbench_commands[$command]}
  else
    _files
  fi
}
if [[ ${zsh_eval_context[-1]} == loadautofunc ]]; then _avoidbench "$@"; else compdef _avoidbench avoidbench; fi
)";

/// 'text' for fish.
std::string fish_quoted(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kSigns[] = {{"\\", "\\\\"}, {"'", "\\'"}};
  return "'" + replaced(text, kSigns) + "'";
}

std::string fish_script(const CLI::App& app) {
  std::string names, lines;
  for_each_command(app, [&](const CLI::App& command) {
    names += " " + fish_quoted(full_name(command));
    const std::string at =
        "complete -c avoidbench -n 'test (__avoidbench_command) = \"" + full_name(command) + "\"' ";
    for (const CLI::App* sub : visible_commands(command)) {
      lines +=
          at + "-f -a " + sub->get_name() + " -d " + fish_quoted(sub->get_description()) + "\n";
    }
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) {
        lines += at + "-l " + name + " -d " + fish_quoted(option->get_description()) + "\n";
      }
    }
  });
  return "set -g __avoidbench_commands" + names + R"(
function __avoidbench_command
  set -l command avoidbench
  for word in (commandline -opc)[2..-1]
    contains -- "$command $word" $__avoidbench_commands; and set command "$command $word"
  end
  echo $command
end
)" + lines;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  const std::string head =
      "# Completes avoidbench's command lines: avoidbench completion " + shell + "\n";
  if (shell == "bash") return head + word_tables(app) + std::string(kBash);
  if (shell == "zsh") return "#compdef avoidbench\n" + head + word_tables(app) + std::string(kZsh);
  if (shell == "fish") return head + fish_script(app);
  throw InputError("no completion for '" + shell + "'; shells: bash, zsh, fish");
}

}  // namespace avoidbench
