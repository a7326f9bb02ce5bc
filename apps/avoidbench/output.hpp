#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "command_options.hpp"

namespace avoidbench {

/// A file, or standard output for "-", that is written piece by piece. Throws InputError where it
/// can't be written.
class Output {
 public:
  explicit Output(const std::string& path);
  void write(const std::string& text);
  void close();

 private:
  std::ostream& stream();
  void check();

  std::string path_;
  std::ofstream file_;
};

/// Throws InputError where the file's ending is that of another format than `format` ("png", "csv",
/// "markdown", …), or it can't be written; "-" can. For before a flight or other work that takes
/// its time. Makes no file.
void check_output(const std::string& file, std::string_view format);

/// All of it at once.
void write_text(const std::string& text, const std::string& output);
void write_table(const Table& table, const OutputOptions& options);
void write_sections(std::span<const Section> sections, const OutputOptions& options);

/// Warns on standard error of what a planner declares to need: `granted`, as text(SandboxRules) has
/// it.
void warn_of_granted(const std::string& planner_label, const std::string& granted);

/// The folder, made if it is missing. Throws InputError where it can't be made or written to.
std::filesystem::path made_folder(const std::string& folder);

}  // namespace avoidbench
