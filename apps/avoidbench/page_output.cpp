#include "page_output.hpp"

#include <iostream>

#include "base/number_text.hpp"
#include "base/output_file.hpp"
#include "output.hpp"
#include "page/flight_choice.hpp"
#include "page_program.hpp"
#include "version.hpp"

namespace avoidbench {
namespace {

/// The command as it was typed; words with anything but plain letters in quotes.
std::string own_command() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string command;
  for (std::string word; std::getline(file, word, '\0');) {
    const bool is_first = command.empty();
    // Not where this program lies.
    if (is_first) word = std::filesystem::path(word).filename().string();
    const bool is_plain =
        !word.empty() && word.find_first_not_of(
                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                             "_-./=,:@%+") == std::string::npos;
    command += (is_first ? "" : " ") + (is_plain ? word : "'" + word + "'");
  }
  return command;
}

}  // namespace

void check_page(const std::string& file) { check_output(file, "html"); }

PageOrigin page_origin() {
  return {
      .version = kVersion, .git_hash = kGitHash, .compiler = kCompiler, .command = own_command()};
}

std::size_t page_room(std::optional<double> limit_mb, std::size_t trial_count) {
  const PageProgram program = page_program();
  const std::size_t own = program.head.size() + program.body.size() + program.tail.size();
  const std::size_t wanted =
      limit_mb ? static_cast<std::size_t>(1e6 * *limit_mb) : usual_page_bytes(trial_count);
  return wanted > own ? wanted - own : 0;
}

void replace_page(const nlohmann::ordered_json& data, const std::filesystem::path& file) {
  WholeFile out(file);
  out.stream() << page_text(page_program(), data.at("title").get<std::string>(), data);
  out.finish();
}

void say_written(const nlohmann::ordered_json& data, const std::filesystem::path& file) {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, error));
  std::cerr << "wrote " << file.string();
  // Pipes and devices have no size.
  if (!error) std::cerr << " (" << fixed_digits(bytes / 1e6, 1) << " MB)";
  std::cerr << ": open it in a browser\n";
  for (const auto& warning : data.at("scene_warnings")) {
    std::cerr << "warning: " << file.string() << ": " << warning.get<std::string>() << '\n';
  }
}

void write_page(const nlohmann::ordered_json& data, const std::string& file) {
  write_text(page_text(page_program(), data.at("title").get<std::string>(), data), file);
  if (file != "-") say_written(data, file);
}

}  // namespace avoidbench
