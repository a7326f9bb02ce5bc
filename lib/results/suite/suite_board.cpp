#include "suite/suite_board.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The file as a link from the page, null where the result has no such file.
ordered_json link_to(const fs::path& file, const fs::path& page_folder) {
  std::error_code error;
  if (!fs::exists(file, error)) return nullptr;
  const fs::path from = fs::absolute(page_folder.empty() ? "." : page_folder);
  return fs::absolute(file).lexically_normal().lexically_relative(from.lexically_normal()).string();
}

/// How failures ended: by cause where that was told, else by outcome; the most frequent first.
ordered_json failures_json(const SuiteResult& result) {
  std::map<std::string, std::int64_t> counts;
  for (const SuiteRow& row : result.rows) {
    if (row.outcome == Outcome::reached_goal) continue;
    ++counts[row.cause.empty() ? std::string(text(row.outcome)) : row.cause];
  }
  std::vector<std::pair<std::string, std::int64_t>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  ordered_json failures = ordered_json::array();
  for (const auto& [cause, count] : sorted) failures.push_back({cause, count});
  return failures;
}

ordered_json entry_json(const BoardEntry& entry, const fs::path& page_folder) {
  ordered_json steps = ordered_json::array();
  for (const SpeedStep& step : entry.score.all.curve) steps.push_back({step.speed_mps, step.share});
  const SuiteResult& result = entry.result;
  return {{"label", result.label},
          {"name", result.planner_name},
          {"version", result.planner_version},
          {"digest", result.planner_digest},
          {"is_privileged", result.is_privileged},
          {"settings", flow_text(result.planner.entry)},
          {"licence", result.planner.licence},
          {"source", result.planner.source},
          {"tuned_on", result.planner.tuned_on},
          {"program", result.program},
          {"failures", failures_json(result)},
          {"curve", steps},
          {"links",
           {{"flights", link_to(entry.folder / "page.html", page_folder)},
            {"report", link_to(entry.folder / "report.md", page_folder)},
            {"causes", link_to(entry.folder / "causes.md", page_folder)},
            {"trials", link_to(entry.folder / kTrialsFile, page_folder)},
            {"planner", link_to(entry.folder / kPlannerFile, page_folder)}}}};
}

BoardEntry entry_of(const fs::path& folder, const SuiteTrack& track, SuiteResult result) {
  if (track.sha256 != result.track_sha256) {
    refuse_file(folder / kPlannerFile, "it was flown in a different " + result.suite + "/" +
                                           result.track +
                                           " than the one that is here (track_sha256)");
  }
  if (const std::string problem = rows_problem(track.suite, result); !problem.empty()) {
    refuse_file(folder / kTrialsFile, problem);
  }
  SuiteScore score = score_of(track.suite, result);
  return {.result = std::move(result), .score = std::move(score), .folder = folder};
}

/// The entries in the order of their scores.
void rank(Board& board) {
  std::vector<SuiteScore> scores;
  for (const BoardEntry& entry : board.entries) scores.push_back(entry.score);
  std::vector<BoardEntry> sorted;
  for (SuiteScore& score : ranked(std::move(scores))) {
    const auto entry = std::find_if(
        board.entries.begin(), board.entries.end(),
        [&](const auto& of) { return of.result.label == score.label && !of.folder.empty(); });
    sorted.push_back({std::move(entry->result), std::move(score), entry->folder});
    entry->folder.clear();  // taken: two results may share a label
  }
  board.entries = std::move(sorted);
}

}  // namespace

std::vector<Table> Board::tables() const {
  std::vector<SuiteScore> scores;
  for (const BoardEntry& entry : entries) scores.push_back(entry.score);
  return score_tables(track.suite, scores);
}

std::vector<Board> boards_of(const std::vector<std::string>& folders,
                             const std::string& own_track) {
  std::map<std::tuple<std::string, std::string, Split>, Board> boards;
  for (const std::string& folder : folders) {
    SuiteResult result = read_result(folder);
    const std::string track = result.suite + "/" + result.track;
    Board& board = boards[{result.suite, result.track, result.split}];
    if (board.title.empty()) {
      board.track = suite_track(own_track.empty() ? track : own_track);
      board.title = track + ", " + std::string(text(result.split));
    }
    board.entries.push_back(entry_of(folder, board.track, std::move(result)));
  }
  std::vector<Board> all;
  for (auto& [place, board] : boards) {
    rank(board);
    all.push_back(std::move(board));
  }
  return all;
}

ordered_json board_page(const std::vector<Board>& boards, const PageOrigin& origin,
                        const fs::path& page_folder) {
  std::string title;
  for (const Board& board : boards) title += (title.empty() ? "" : "; ") + board.title;
  ordered_json page = page_start("board", title, origin);
  page["boards"] = ordered_json::array();
  for (const Board& board : boards) {
    ordered_json tables = ordered_json::array(), results = ordered_json::array();
    for (const Table& table : board.tables()) tables.push_back(table_json(table));
    for (const BoardEntry& entry : board.entries) results.push_back(entry_json(entry, page_folder));
    page["boards"].push_back({{"title", board.title}, {"tables", tables}, {"results", results}});
  }
  page["flights"] = ordered_json::array();
  add_scenes({}, page);
  return page;
}

}  // namespace avoidbench
