#include "report/sweep_choice.hpp"

#include <algorithm>

#include "base/input_error.hpp"

namespace avoidbench {

std::vector<std::vector<SweepInfo>> chosen_sweeps(std::span<const Database> databases,
                                                  std::string_view wanted,
                                                  std::vector<std::string>* unflown) {
  std::vector<std::vector<SweepInfo>> chosen;
  std::vector<std::string> names;
  bool is_known = false, has_trials = false;
  for (const Database& database : databases) {
    const std::vector<SweepInfo> sweeps = database.read_sweeps();  // by name, then revision
    std::vector<SweepInfo>& of_this = chosen.emplace_back();
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      // The last of its name: older revisions are taken only where one is named.
      const bool is_latest = i + 1 == sweeps.size() || sweeps[i + 1].name != sweeps[i].name;
      const std::string exact = sweeps[i].name + "@" + std::to_string(sweeps[i].revision);
      // What one may type, for the hint.
      names.push_back(is_latest ? sweeps[i].name : exact);
      const bool is_wanted =
          wanted == exact || (is_latest && (wanted.empty() || wanted == sweeps[i].name));
      is_known = is_known || is_wanted;
      if (!is_wanted) continue;
      if (sweeps[i].trial_count > 0) {
        has_trials = true;
        of_this.push_back(sweeps[i]);
      } else if (unflown != nullptr) {
        unflown->push_back(database.path().string() + ": sweep " + sweeps[i].name +
                           " has no finished trial yet");
      }
    }
  }
  if (!is_known && !wanted.empty()) {
    const std::string name(wanted);
    throw InputError("no sweep " + name + did_you_mean(name, names));
  }
  if (!has_trials) throw InputError("no finished trial");
  return chosen;
}

}  // namespace avoidbench
