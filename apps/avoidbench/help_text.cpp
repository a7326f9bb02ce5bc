#include "help_text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "table/table_text.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostColumns = 100, kLeastColumns = 60;

std::size_t help_columns() {
  winsize size{};
  const bool is_known =
      ::isatty(STDOUT_FILENO) == 1 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
  return is_known && size.ws_col > 0
             ? std::clamp<std::size_t>(size.ws_col, kLeastColumns, kMostColumns)
             : kMostColumns;
}

/// Where a line's description begins: behind the first gap of two spaces after a name, else with
/// the line's first letter.
std::size_t description_column(std::string_view line) {
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", first);
  const std::size_t column = gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
  return column != std::string_view::npos && column <= kLeastColumns / 2 ? column : first;
}

/// Whether `next` goes on with the paragraph of `line`: footers are written in lines of their
/// source.
bool is_one_paragraph(std::string_view line, std::string_view next) {
  return line.size() >= kLeastColumns && line.front() != ' ' && !next.empty() &&
         next.front() != ' ' && !next.starts_with("Usage:") && !next.starts_with("Exit codes:");
}

std::string wrapped_lines(const std::string& text, std::size_t width) {
  std::istringstream lines(text);
  std::vector<std::string> paragraphs;
  for (std::string line; std::getline(lines, line);) {
    const bool is_next = !paragraphs.empty() && is_one_paragraph(paragraphs.back(), line);
    is_next ? paragraphs.back() += " " + line : paragraphs.emplace_back(std::move(line));
  }
  std::string all;
  for (const std::string& paragraph : paragraphs) {
    all += wrapped(paragraph, width, description_column(paragraph)) + "\n";
  }
  return all;
}

}  // namespace

std::string WrappedHelp::make_help(const CLI::App* app, std::string name,
                                   CLI::AppFormatMode mode) const {
  return wrapped_lines(CLI::Formatter::make_help(app, std::move(name), mode), help_columns());
}

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> option_spellings(const CLI::App& app) {
  std::vector<std::string> found;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_snames()) found.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) found.push_back("--" + name);
  }
  return found;
}

std::string full_name(const CLI::App& app) {
  const CLI::App* parent = app.get_parent();
  return parent == nullptr ? app.get_name() : full_name(*parent) + " " + app.get_name();
}

}  // namespace avoidbench
