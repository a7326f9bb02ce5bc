#include "command_options.hpp"

#include <algorithm>

namespace avoidbench {
namespace {

/// How this program takes what would help.
std::string hint_text(const std::string& hint) {
  if (hint.empty()) return "";
  if (hint == "list") return ": avoidbench replay DB --list shows them";
  if (hint == "bless") return ": avoidbench compare DB --bless FILE writes one";
  if (hint == "command") return " (--sweep-file FILE or --library FILE)";
  return " (--" + hint + ")";
}

}  // namespace

std::string option_message(const OptionError& error) {
  const std::string option = error.option().empty() ? "" : "--" + error.option() + " ";
  return option + error.what() + hint_text(error.hint());
}

CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::vector<std::string>& names, const std::string& doc) {
  const auto take = [&value, name, names](const std::string& word) {
    if (std::find(names.begin(), names.end(), word) == names.end()) {
      throw InputError(name + " " + word + ": unknown" + did_you_mean(word, names) +
                       "; it is one of " + joined(names));
    }
    value = word;
  };
  return command.add_option_function<std::string>(name, take, doc)->default_str(value);
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides,
                   const std::string& example) {
  add_repeatable(command, "--set", overrides, "PATH=VALUE",
                 "Override one value, as in " + example + "; repeatable (default: none)");
}

CLI::Option* add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                      const std::string& doc) {
  return add_repeatable(command, name, values, "LIST", doc)->delimiter(',');
}

void add_sweep_choice(CLI::App& command, std::string& sweep) {
  command.add_option(
      "--sweep", sweep,
      "Only this sweep; NAME@2 for its revision 2 (default: the latest revision of every sweep)");
}

CLI::Option* add_output_file(CLI::App& command, std::string& output) {
  return command.add_option("--output", output, "File to write, - for standard output");
}

void add_page_size(CLI::App& command, CLI::Option* page, std::optional<double>& page_mb) {
  add_number(
      command, "--page-size", page_mb, CLI::Range(1.0, 1000.0),
      "Maximum size of the page, MB; flights that don't fit are left out, failures last, tables "
      "and numbers of trials never (default: 3 for each 1,000 trials, at least 3, at most 15)")
      ->needs(page)
      ->type_name("MB");
}

void add_where(CLI::App& command, std::vector<std::string>& where) {
  add_repeatable(command, "--where", where, "CONDITION",
                 "Only trials that match this: FIELD OP VALUE, such as 'map.poisson_radius_m < 3' "
                 "or 'planner = ego, reactive'; repeatable, all must hold");
}

void add_order_options(CLI::App& command, TrialOrder& order) {
  add_typed(command, "--sort", order.field, "METRIC",
            "Sort by a metric (`avoidbench metrics`), worst trials first, or by another field of "
            "trials, smallest first; trials without a value come last");
  add_number(command, "--limit", order.limit, CLI::Range(1, 1'000'000'000),
             "At most this many trials, the first ones");
}

void add_output_options(CLI::App& command, OutputOptions& options) {
  add_choice(command, "--format", options.format, "table, csv, json, markdown or latex");
  add_output_file(command, options.output);
}

}  // namespace avoidbench
