#include "page_output.hpp"

#include <iostream>

#include "base/number_text.hpp"
#include "output.hpp"
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

void write_page(const nlohmann::ordered_json& data, const std::string& file) {
  const std::string text = page_text(page_program(), data.at("title").get<std::string>(), data);
  write_text(text, file);
  if (file == "-") return;
  std::cerr << "wrote " << file << " (" << fixed_digits(static_cast<double>(text.size()) / 1e6, 1)
            << " MB): open it in a browser\n";
  for (const auto& warning : data.at("scene_warnings")) {
    std::cerr << "warning: " << file << ": " << warning.get<std::string>() << '\n';
  }
}

}  // namespace avoidbench
