#include "output.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string_view>

#include "base/output_file.hpp"
#include "base/visible_text.hpp"
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

/// What files of an ending hold; those that are not here may hold anything.
constexpr std::pair<std::string_view, std::string_view> kEndings[] = {
    {".png", "png"},   {".jpg", "jpeg"},    {".jpeg", "jpeg"}, {".gif", "gif"},
    {".pdf", "pdf"},   {".svg", "svg"},     {".mp4", "mp4"},   {".webm", "webm"},
    {".avi", "avi"},   {".csv", "csv"},     {".json", "json"}, {".jsonl", "jsonl"},
    {".tex", "latex"}, {".md", "markdown"}, {".db", "sqlite"}, {".xlsx", "xlsx"},
    {".yml", "yaml"},  {".yaml", "yaml"},   {".tum", "tum"},   {".html", "html"},
    {".mcap", "mcap"}};

void check_ending(const std::filesystem::path& file, std::string_view format) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  });
  const auto* const known = std::find_if(std::begin(kEndings), std::end(kEndings),
                                         [&](const auto& one) { return one.first == ending; });
  if (known == std::end(kEndings) || known->second == format) return;
  std::string message = "ends in " + ending + ", but the output is " + std::string(format);
  const auto* const wanted = std::find_if(std::begin(kEndings), std::end(kEndings),
                                          [&](const auto& one) { return one.second == format; });
  if (wanted != std::end(kEndings)) {
    message += ": name it " + std::filesystem::path(file).replace_extension(wanted->first).string();
  }
  if (wanted == std::end(kEndings) && enum_from_text<TableFormat>(known->second)) {
    message += ": --format " + std::string(known->second) + " writes this format";
  }
  refuse_file(file, message);
}

}  // namespace

void check_output(const std::string& file, std::string_view format) {
  if (file == "-") return;
  const std::filesystem::path path = file;
  check_ending(path, format);
  check_output_file(path);
}

Output::Output(const std::string& path) : path_(path) {
  if (path_ != "-") file_ = open_output(path_);
  check();
}

void Output::write(const std::string& text) {
  stream() << text;
  check();
}

void Output::close() {
  stream().flush();
  check();
  if (path_ != "-") close_output(file_, path_);
}

std::ostream& Output::stream() { return path_ == "-" ? data_output() : file_; }

void Output::check() {
  if (stream()) return;
  if (path_ == "-") throw InputError("standard output can't be written");
  refuse_file(path_, "can't be written");
}

void write_text(const std::string& text, const std::string& output) {
  Output out(output);
  out.write(text);
  out.close();
}

void write_table(const Table& table, const OutputOptions& options) {
  check_output(options.output, text(options.format));
  write_text(format_table(table, options.format, style_of_output(options.output)), options.output);
}

void write_sections(std::span<const Section> sections, const OutputOptions& options) {
  check_output(options.output, text(options.format));
  write_text(format_sections(sections, options.format, style_of_output(options.output)),
             options.output);
}

std::filesystem::path made_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) refuse_file(folder, "is not a folder and can't be created: " + error.message());
  if (::access(folder.c_str(), W_OK) != 0) {
    refuse_file(folder, std::string("can't be written: ") + std::strerror(errno));
  }
  return folder;
}

void warn_of_granted(const std::string& planner_label, const std::string& granted) {
  std::cerr << "warning: planner " << visible_line(planner_label) << " declares that it needs "
            << granted << ": its sandbox allows it\n";
}

}  // namespace avoidbench
