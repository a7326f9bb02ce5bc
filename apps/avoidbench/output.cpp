#include "output.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "visible_streams.hpp"

namespace avoidbench {
namespace {

/// As wide as the terminal, within reason, and coloured there if nobody objects (no-color.org).
TextStyle style_of_output(const std::string& output) {
  TextStyle style;
  if (output != "-" || ::isatty(STDOUT_FILENO) != 1) return style;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.width = std::clamp<std::size_t>(size.ws_col, 60, 100);
  }
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  style.is_coloured = !is_dumb && (no_color == nullptr || *no_color == '\0');
  return style;
}

}  // namespace

Output::Output(const std::string& path) : path_(path) {
  if (path_ != "-") file_.open(path_, std::ios::binary);
  check();
}

void Output::write(const std::string& text) {
  stream() << text;
  check();
}

void Output::close() {
  stream().flush();
  if (path_ != "-") file_.close();
  check();
}

std::ostream& Output::stream() { return path_ == "-" ? data_output() : file_; }

void Output::check() {
  if (stream()) return;
  if (path_ == "-") throw InputError("standard output can't be written");
  throw InputError({.file = path_, .message = "can't be written"});
}

void write_text(const std::string& text, const std::string& output) {
  Output out(output);
  out.write(text);
  out.close();
}

void write_table(const Table& table, const OutputOptions& options) {
  write_text(format_table(table, options.format, style_of_output(options.output)), options.output);
}

void write_sections(std::span<const Section> sections, const OutputOptions& options) {
  write_text(format_sections(sections, options.format, style_of_output(options.output)),
             options.output);
}

std::filesystem::path made_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError({.file = folder, .message = "is no folder and can't be made one"});
  }
  return folder;
}

}  // namespace avoidbench
