#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "page/page.hpp"
#include "suite/suite_score.hpp"

namespace avoidbench {

/// A result on a board.
struct BoardEntry {
  SuiteResult result;
  SuiteScore score;
  std::filesystem::path folder;  ///< of the result
};

/// The results of one track and split, ranked.
struct Board {
  SuiteTrack track;
  std::string title;  ///< avoidbench-1/depth, public
  std::vector<BoardEntry> entries;

  std::vector<Table> tables() const;
};

/// The boards of these folders, by suite, track and split. `own_track`, FOLDER/TRACK, is a suite of
/// the user's own that they were flown in; "": one that comes with the program. Throws InputError
/// where a folder is no result, is of a suite that is not there or has changed, or lacks trials.
std::vector<Board> boards_of(const std::vector<std::string>& folders,
                             const std::string& own_track = "");

/// How far rankings agree: of each board with three competitors or more, Kendall's τ between their
/// scores and their v90 of each cell, and between their scores on two boards (splits or tracks, for
/// results of the same label). Intervals are over draws of maps. Empty where there are fewer.
Table agreement_table(const std::vector<Board>& boards);

/// Their page: tables, S(v) of all results, and of each what flew, how it failed and links to its
/// files, relative to `page_folder`.
nlohmann::ordered_json board_page(const std::vector<Board>& boards, const PageOrigin& origin,
                                  const std::filesystem::path& page_folder);

}  // namespace avoidbench
