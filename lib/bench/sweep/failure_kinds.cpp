#include "sweep/failure_kinds.hpp"

#include <algorithm>
#include <map>

#include "base/visible_text.hpp"
#include "base/words.hpp"

namespace avoidbench {
namespace {

/// A planner's own reason may be a page: a line of it is enough, `replay` shows all.
constexpr std::size_t kMostReasonBytes = 160;

/// A comma or dash at a number's side becomes part of the mark, which does no harm.
bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

/// The reason with each number as one mark, so that two flights into trees have the same.
std::string pattern_of(const std::string& reason) {
  std::string pattern;
  for (const char c : reason) {
    if (!is_of_number(c)) {
      pattern += c;
    } else if (pattern.empty() || pattern.back() != '#') {
      pattern += '#';
    }
  }
  return pattern;
}

std::string shortened(std::string text) {
  if (text.size() <= kMostReasonBytes) return text;
  std::size_t end = kMostReasonBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // in a letter
  return text.substr(0, end) + "…";
}

/// Most first, then by name.
std::vector<std::pair<std::string, std::int64_t>> by_count(
    const std::map<std::string, std::int64_t>& counts) {
  std::vector<std::pair<std::string, std::int64_t>> sorted(counts.begin(), counts.end());
  // The map's order, by name, stays among equal counts.
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

/// Of the trials with one outcome: how many, whose, and a reason that stands for most.
FailureKind kind_of(Outcome outcome, const std::vector<const TrialListing*>& trials) {
  FailureKind kind{.outcome = outcome,
                   .count = static_cast<std::int64_t>(trials.size()),
                   .planners = {},
                   .alike_count = 0,
                   .example = {}};
  std::map<std::string, std::int64_t> planners;
  // Of reasons that are alike the most frequent one is told, by its first trial.
  std::map<std::string, std::vector<const TrialListing*>> reasons;
  for (const TrialListing* trial : trials) {
    ++planners[trial->planner_label];
    reasons[pattern_of(trial->reason)].push_back(trial);
  }
  kind.planners = by_count(planners);
  for (const auto& [pattern, alike] : reasons) {
    const auto count = static_cast<std::int64_t>(alike.size());
    // The first of equal ones, in order of patterns: the same each time.
    if (count <= kind.alike_count) continue;
    kind.alike_count = count;
    kind.example = *alike.front();
  }
  return kind;
}

}  // namespace

std::vector<FailureKind> failure_kinds(std::span<const TrialListing> trials) {
  std::map<Outcome, std::vector<const TrialListing*>> failed;
  for (const TrialListing& trial : trials) {
    if (trial.outcome != Outcome::reached_goal) failed[trial.outcome].push_back(&trial);
  }
  std::vector<FailureKind> kinds;
  for (const auto& [outcome, of_kind] : failed) kinds.push_back(kind_of(outcome, of_kind));
  std::stable_sort(kinds.begin(), kinds.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return kinds;
}

std::string failure_text(const FailureKind& kind) {
  std::vector<std::string> planners;
  for (const auto& [label, count] : kind.planners) {
    planners.push_back(visible_line(label) + " " + std::to_string(count));
  }
  std::string line = std::to_string(kind.count) + " " + std::string(text(kind.outcome)) + " (" +
                     joined(planners) + ")";
  if (kind.count > 1) {
    line += kind.alike_count == kind.count ? ", all" : ", " + std::to_string(kind.alike_count);
    line += " as trial " + std::to_string(kind.example.id);
  }
  return line + ": " + shortened(visible_line(kind.example.reason));
}

}  // namespace avoidbench
