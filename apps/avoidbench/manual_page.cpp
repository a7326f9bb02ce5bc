#include <string>
#include <string_view>
#include <utility>

#include "base/words.hpp"
#include "help_text.hpp"

namespace avoidbench {
namespace {

/// Text as roff takes it: nothing in it is a request or an escape.
std::string roff(std::string_view text) {
  std::string all;
  bool is_line_start = true;
  for (const char c : text) {
    if (is_line_start && (c == '.' || c == '\'')) all += "\\&";
    if (c == '\\') {
      all += "\\e";
    } else if (c == '-') {
      all += "\\-";
    } else {
      all += c;
    }
    is_line_start = c == '\n';
  }
  return all;
}

/// Options, each a tagged paragraph: its spelling and value, then what it means.
std::string option_list(const CLI::App& app, const CLI::Formatter& formatter) {
  std::string all;
  for (const CLI::Option* option : app.get_options()) {
    const bool is_positional = option->get_positional();
    all += ".TP\n.B " +
           roff(formatter.make_option_name(option, is_positional) +
                formatter.make_option_opts(option)) +
           "\n" + roff(formatter.make_option_desc(option)) + "\n";
  }
  return all;
}

std::string section(const CLI::App& app, const CLI::Formatter& formatter) {
  std::string all = ".SH " + roff(full_name(app)) + "\n" + roff(app.get_description()) + "\n.PP\n" +
                    option_list(app, formatter);
  if (!app.get_footer().empty()) all += ".PP\n.nf\n" + roff(app.get_footer()) + "\n.fi\n";
  for (const CLI::App* command : visible_commands(app)) all += section(*command, formatter);
  return all;
}

}  // namespace

std::string manual_page(const CLI::App& app, const std::string& version) {
  const bool is_program = app.get_parent() == nullptr;
  constexpr std::pair<std::string_view, std::string_view> kSpace[] = {{" ", "-"}};
  const std::string name = replaced(full_name(app), kSpace);
  const CLI::Formatter formatter;
  std::string all = ".TH " + roff(name) + " 1 \"\" \"avoidbench " + roff(version) +
                    "\"\n.SH NAME\n" + roff(name + " - " + app.get_description()) +
                    "\n.SH SYNOPSIS\n.B " + roff(full_name(app)) + "\n" +
                    (is_program ? "COMMAND [OPTIONS]" : "[OPTIONS]") + "\n";
  if (!is_program) return all + section(app, formatter);
  all += ".SH COMMANDS\n";
  for (const CLI::App* command : visible_commands(app)) {
    all += ".TP\n.BR avoidbench\\-" + roff(command->get_name()) + " (1)\n" +
           roff(command->get_description()) + "\n";
  }
  return all + ".SH OPTIONS\n" + option_list(app, formatter) + ".PP\n.nf\n" +
         roff(app.get_footer()) + "\n.fi\n";
}

}  // namespace avoidbench
