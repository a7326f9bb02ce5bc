#include "base/input_error.hpp"

#include <algorithm>
#include <numeric>

namespace avoidbench {
namespace {

std::string joined(const std::vector<InputProblem>& problems) {
  std::string all;
  for (const InputProblem& problem : problems) {
    if (!all.empty()) all += '\n';
    all += text(problem);
  }
  return all;
}

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
/// Damerau's distance in its simple form (optimal string alignment): three rows of the table are
/// enough.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({substituted, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

/// Whether the words of `name` between underscores are all among those of `longer`, in the same
/// order.
bool lacks_words_only(std::string_view name, std::string_view longer) {
  const auto next_word = [](std::string_view& rest) {
    const std::string_view word = rest.substr(0, rest.find('_'));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    return word;
  };
  while (!name.empty()) {
    const std::string_view word = next_word(name);
    // Words of `longer` that `name` lacks are passed over.
    while (!longer.empty() && !longer.starts_with(word)) next_word(longer);
    if (next_word(longer) != word) return false;
  }
  return true;
}

}  // namespace

std::string text(const InputProblem& problem) {
  std::string place = problem.file;
  if (problem.line > 0) place += ":" + std::to_string(problem.line);
  if (problem.line > 0 && problem.column > 0) place += ":" + std::to_string(problem.column);
  return place.empty() ? problem.message : place + ": " + problem.message;
}

InputError::InputError(InputProblem problem)
    : InputError(std::vector<InputProblem>{std::move(problem)}) {}

InputError::InputError(std::string message)
    : InputError(InputProblem{.file = "", .line = 0, .column = 0, .message = std::move(message)}) {}

InputError::InputError(std::vector<InputProblem> problems)
    : std::runtime_error(joined(problems)), problems_(std::move(problems)) {}

void refuse_file(const std::filesystem::path& file, std::string message) {
  throw InputError(InputProblem{.file = file.string(), .message = std::move(message)});
}

std::string_view nearest_word(std::string_view word, std::span<const std::string> candidates) {
  std::string_view best;
  // Two slips, or one in three letters; more is another word. Of equal ones the first counts.
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    // A word that lacks or adds a unit suffix is a likely slip: fov_deg for fov_x_deg, speed for
    // speed_mps.
    std::size_t distance = edit_distance(word, candidate);
    const bool is_shortened = candidate.starts_with(word) || lacks_words_only(word, candidate);
    if (is_shortened && word.size() >= 3) distance = std::min<std::size_t>(distance, 2);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string_view nearest = nearest_word(word, candidates);
  return nearest.empty() ? "" : " (did you mean " + std::string(nearest) + "?)";
}

}  // namespace avoidbench
