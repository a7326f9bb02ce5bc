#include "export_choice.hpp"

#include <filesystem>
#include <iostream>

#include "base/option_error.hpp"
#include "base/output_file.hpp"
#include "database_choice.hpp"
#include "export/trial_list.hpp"
#include "output.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kKeyLetters = 12;

}  // namespace

bool is_database(const std::string& word) {
  std::error_code error;
  const std::filesystem::path path = word;
  return path.extension() == ".db" || path.extension() == ".yaml" || path.extension() == ".yml" ||
         word.find('/') != std::string::npos || std::filesystem::exists(path, error) ||
         std::filesystem::exists(std::filesystem::path("results") / (word + ".db"), error);
}

std::pair<Database, std::vector<TrialListing>> chosen_of(const std::vector<std::string>& words) {
  const bool has_database = is_database(words.front());
  if (has_database && words.size() == 1) {
    throw OptionError("no trial given: an id or the beginning of a key", "", "list");
  }
  Database database = Database::open_for_reading(has_database ? database_of(words.front())
                                                              : newest_database("trials"));
  const std::vector<TrialListing> all = database.list_trials(listed_fields(database));
  std::vector<TrialListing> trials;
  for (std::size_t i = has_database ? 1 : 0; i < words.size(); ++i) {
    trials.push_back(the_trial(all, {.trial = words[i]}));
  }
  return {std::move(database), std::move(trials)};
}

void warn_of_no_path(const TrialListing& trial, const TrialRecord& record) {
  if (!record.samples.empty()) return;
  std::cerr << "warning: trial " << trial.id << " (" << trial.key.substr(0, kKeyLetters)
            << ") has no trajectory: " << text(trial.outcome) << '\n';
}

void write_files(const std::vector<TrialListing>& trials, const std::string& output,
                 const std::string& extension,
                 const std::function<void(const TrialListing&, const std::string& file)>& write) {
  std::error_code error;
  const bool is_one =
      trials.size() == 1 && !output.ends_with('/') && !std::filesystem::is_directory(output, error);
  if (is_one) check_output(output, extension);
  if (!is_one && output == "-") {
    throw InputError("several trials need --output FOLDER: one file each is written there");
  }
  const std::filesystem::path folder = is_one ? "" : made_folder(output);
  for (const TrialListing& trial : trials) {
    const std::string name = safe_file_name(trial.key.substr(0, kKeyLetters)) + "." + extension;
    const std::string file = is_one ? output : (folder / name).string();
    write(trial, file);
    if (!is_one) std::cerr << "wrote " << file << ": " << trial_text(trial) << '\n';
  }
}

}  // namespace avoidbench
