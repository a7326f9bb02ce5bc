#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/enum_text.hpp"
#include "base/option_error.hpp"
#include "base/words.hpp"
#include "export/trial_list.hpp"
#include "table/table.hpp"

// Commands, and options that several of them have.
namespace avoidbench {

/// Adds a subcommand that calls `work` with its options.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& app, const std::string& name,
                                           const std::string& doc, void (*work)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(name, doc);
  command->callback([options, work] { work(*options); });
  return {*command, *options};
}

/// Adds an option whose value is one of `names`. Any other word is an InputError that names them.
CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::vector<std::string>& names, const std::string& doc);

/// The same for the texts of an enum.
template <TextEnum E>
CLI::Option* add_choice(CLI::App& command, const std::string& name, E& value,
                        const std::string& doc) {
  const auto take = [&value, name](const std::string& word) {
    const std::optional<E> known = enum_from_text<E>(word);
    const std::vector<std::string> names = enum_texts<E>();
    if (!known) {
      throw InputError(name + " " + word + ": unknown" + did_you_mean(word, names) +
                       "; it is one of " + joined(names));
    }
    value = *known;
  };
  return command.add_option_function<std::string>(name, take, doc)
      ->default_str(std::string(text(value)));
}

/// Adds --set, which overrides values of a sweep or map; `example`: "maps.poisson_radius_m=3".
void add_overrides(CLI::App& command, std::vector<std::string>& overrides,
                   const std::string& example);

/// Adds --sweep, which chooses among the sweeps of databases.
void add_sweep_choice(CLI::App& command, std::string& sweep);

/// Adds an option whose value is a number within the range.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, Number& number,
                        const CLI::Validator& range, const std::string& doc) {
  return command.add_option(name, number, doc)->check(range);
}

/// Adds an option whose value help calls `type`, such as FILE.
template <class Value>
CLI::Option* add_typed(CLI::App& command, const std::string& name, Value& value,
                       const std::string& type, const std::string& doc) {
  return command.add_option(name, value, doc)->type_name(type);
}

/// Adds an option whose value is a list separated by commas; given more than once, all of them. It
/// takes one word: the next one is no part of it, but may be the database.
CLI::Option* add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                      const std::string& doc);

/// Adds an option that can be given more than once and takes one word each time.
template <class Value>
CLI::Option* add_repeatable(CLI::App& command, const std::string& name, std::vector<Value>& values,
                            const std::string& type, const std::string& doc) {
  return add_typed(command, name, values, type, doc)->allow_extra_args(false);
}

/// Adds --output: a file, or "-" for standard output.
CLI::Option* add_output_file(CLI::App& command, std::string& output);

/// Adds --page-size, MB: the maximum of the page that the option `page` asks for.
void add_page_size(CLI::App& command, CLI::Option* page, std::optional<double>& page_mb);

/// Adds --where, which chooses trials by conditions.
void add_where(CLI::App& command, std::vector<std::string>& where);

/// Adds --sort and --limit.
void add_order_options(CLI::App& command, TrialOrder& order);

/// What is wrong, with options in this program's spelling.
std::string option_message(const OptionError& error);

/// How and where a command writes its tables.
struct OutputOptions {
  TableFormat format = TableFormat::table;
  std::string output = "-";
  bool is_for_people() const { return format == TableFormat::table; }
};

/// Adds --format and --output.
void add_output_options(CLI::App& command, OutputOptions& options);

}  // namespace avoidbench
