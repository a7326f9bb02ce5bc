#include "page/comparison_page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/words.hpp"
#include "compare/compare_formats.hpp"
#include "page/flight_filling.hpp"
#include "page/sweep_data.hpp"
#include "table/table_text.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

/// What became of a pair, in the order in which pairs are put into a page.
enum class Fate { lost, won, failed_otherwise, failed_alike, finished };

Fate fate_of(const TrialPair& pair) {
  const bool was_good = pair.before->outcome == Outcome::reached_goal;
  const bool is_good = pair.after->outcome == Outcome::reached_goal;
  if (was_good != is_good) return is_good ? Fate::won : Fate::lost;
  if (is_good) return Fate::finished;
  return pair.before->outcome == pair.after->outcome ? Fate::failed_alike : Fate::failed_otherwise;
}

/// The pairs that have both sides, by their fates, then by identity.
std::vector<TrialPair> shown_pairs(const TrialTable& base, const TrialTable& now) {
  std::vector<TrialPair> pairs = paired_trials(base, now);
  std::erase_if(pairs, [](const TrialPair& pair) { return !pair.is_whole(); });
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const TrialPair& a, const TrialPair& b) { return fate_of(a) < fate_of(b); });
  return pairs;
}

/// Words, each once, in the order in which they come.
class Words {
 public:
  std::size_t index_of(const std::string& word) {
    const auto [entry, is_new] = index_.emplace(word, words_.size());
    if (is_new) words_.push_back(word);
    return entry->second;
  }
  ordered_json take() { return std::move(words_); }

 private:
  std::map<std::string, std::size_t> index_;
  ordered_json words_ = ordered_json::array();
};

std::string map_text(const TrialIdentity& identity) {
  return identity.generator + " " + std::to_string(identity.map_seed) +
         (identity.setting.empty() ? "" : ", " + identity.setting);
}

/// [planner, map, mission, outcome before, outcome after] of each, by index.
ordered_json pairs_json(std::span<const TrialPair> pairs) {
  Words planners, maps;
  ordered_json rows = ordered_json::array();
  for (const TrialPair& pair : pairs) {
    const TrialIdentity& identity = pair.identity();
    rows.push_back({planners.index_of(identity.planner), maps.index_of(map_text(identity)),
                    identity.mission_index, static_cast<int>(pair.before->outcome),
                    static_cast<int>(pair.after->outcome)});
  }
  ordered_json outcomes = ordered_json::array();
  for (const auto& [outcome, word] : EnumText<Outcome>::entries) outcomes.push_back(word);
  return {
      {"planners", planners.take()}, {"maps", maps.take()}, {"outcomes", outcomes}, {"rows", rows}};
}

/// The section's tables but that of flips, of which the page has all.
ordered_json tables_json(const Section& section) {
  ordered_json tables = ordered_json::array();
  for (const Table& table : section.tables) {
    if (table.name != "flips") tables.push_back(table_json(table));
  }
  return tables;
}

/// One side's flights while they are put into a page.
class SideFlights {
 public:
  SideFlights(std::string_view name, const ComparedSide& side, const Comparison& comparison,
              std::vector<std::string> keys, std::size_t ahead_bytes)
      : name_(name), side_(side), ahead_bytes_(ahead_bytes) {
    for (const MetricComparison& row : comparison.rows) {
      if (row.planner != comparison.rows.front().planner) break;
      for (std::size_t i = 0; i < side.table->metrics.size(); ++i) {
        if (side.table->metrics[i].name == row.metric) metrics_.emplace_back(row.metric, i);
      }
    }
    if (side.database.database != nullptr) {
      reader_.emplace(std::span(&side_.database, 1), std::move(keys), ahead_bytes_);
    }
  }

  /// The next one, that of `trial`. False where it has no room.
  bool add_next(std::size_t pair, const TableTrial& trial, FlightFilling& filling) {
    if (!reader_) return true;
    PackedFlight flight = reader_->next();
    ordered_json marks = {{"pair", pair}, {"side", name_}};
    if (flight.stored) marks["head"] = head(trial, flight.stored->row.record);
    return add_flight(std::move(flight), marks, side_.database.files, filling);
  }

 private:
  ordered_json head(const TableTrial& trial, const TrialRecord& record) const {
    ordered_json metrics = ordered_json::array();
    for (const auto& [metric, at] : metrics_) {
      const double value = trial.metrics[at];
      metrics.push_back({metric, std::isfinite(value) ? ordered_json(value) : nullptr});
    }
    constexpr std::size_t kKeyDigits = 12, kMostReason = 300;
    return {{"key", trial.key.substr(0, kKeyDigits)},
            {"planner", trial.identity.planner},
            {"outcome", text(trial.outcome)},
            {"reason", cut_to_width(record.reason, kMostReason)},
            {"cause", trial.cause},
            {"end_s", record.end_time_s},
            {"metrics", metrics}};
  }

  std::string_view name_;
  ComparedSide side_;
  std::size_t ahead_bytes_;
  std::vector<std::pair<std::string, std::size_t>> metrics_;  ///< name, place in the table
  std::optional<FlightReader> reader_;
};

/// Where a filling page goes back to if only one flight of a pair has room.
struct FillingMark {
  PageScenes::Mark scenes;
  std::size_t flight_count = 0, bytes = 0;
};

void back_to(const FillingMark& mark, FlightFilling& filling) {
  filling.scenes.back_to(mark.scenes);
  auto& flights = filling.flights;
  flights.erase(flights.begin() + static_cast<std::ptrdiff_t>(mark.flight_count), flights.end());
  filling.bytes = mark.bytes;
}

/// Puts in the flights of as many pairs as have room, both of each. Returns for how many.
std::size_t add_pairs(std::span<const TrialPair> pairs, SideFlights& base, SideFlights& now,
                      FlightFilling& filling) {
  std::size_t shown = 0;
  while (shown < pairs.size() && !filling.is_full()) {
    const FillingMark mark{.scenes = filling.scenes.mark(),
                           .flight_count = filling.flights.size(),
                           .bytes = filling.bytes};
    const TrialPair& pair = pairs[shown];
    if (!base.add_next(shown, *pair.before, filling) ||
        !now.add_next(shown, *pair.after, filling)) {
      back_to(mark, filling);
      break;
    }
    ++shown;
  }
  return shown;
}

}  // namespace

ordered_json comparison_page(const Comparison& comparison, const ComparedSide& base,
                             const ComparedSide& now, const PageOrigin& origin,
                             std::size_t limit_bytes) {
  const std::vector<TrialPair> pairs = shown_pairs(*base.table, *now.table);
  const Section section = comparison_section(comparison);
  ordered_json page =
      page_start("comparison", comparison.now + " against " + comparison.base, origin);
  ordered_json found = comparison_json(comparison);
  found.erase("flips");  // the pairs have them
  found["title"] = section.title;
  found["tables"] = tables_json(section);
  found["notes"] = section.notes;
  found["no_flights"] = ordered_json::array();
  std::vector<std::string> base_keys, new_keys;
  std::size_t side_count = 0;
  for (const auto& [side, name] : {std::pair(&base, "base"), std::pair(&now, "new")}) {
    if (side->database.database != nullptr)
      ++side_count;
    else
      found["no_flights"].push_back(name);
  }
  page["comparison"] = std::move(found);
  page["pairs"] = pairs_json(pairs);
  for (const TrialPair& pair : pairs) {
    base_keys.push_back(pair.before->key);
    new_keys.push_back(pair.after->key);
  }
  FlightFilling filling = filling_beside(page, limit_bytes, 0);
  if (filling.is_full()) warn_of_size(2 * pairs.size(), filling);
  // Each side reads ahead what would fit if it had the room alone.
  SideFlights of_base("base", base, comparison, std::move(base_keys), filling.room() / 2);
  SideFlights of_now("new", now, comparison, std::move(new_keys), filling.room() / 2);
  const std::size_t shown =
      side_count == 0 ? pairs.size() : add_pairs(pairs, of_base, of_now, filling);
  add_filling(std::move(filling), side_count * (pairs.size() - shown), page);
  return page;
}

}  // namespace avoidbench
