#pragma once

#include <string>
#include <vector>

#include "export/trial_list.hpp"
#include "view/film.hpp"

namespace avoidbench {

/// "trial 7 (0123abcd): reactive, forest seed 1, mission 2"
std::string title_line(const TrialListing& listing);

/// Writes a sheet a moment: to `png`, of several with their numbers in its name; says so on stderr.
void write_sheets(const StoredTrial& stored, const World& world, const TrialRecord& record,
                  const std::vector<Moment>& moments, const std::string& title,
                  const std::string& png);

/// Throws InputError where the file's name does not end in .mp4, .webm or .gif, it can't be
/// written, or there is no ffmpeg. For before a flight.
void check_film(const std::string& file);

/// Draws the flight and feeds it to ffmpeg; says on stderr how far it is.
void write_film(const StoredTrial& stored, const World& world, const TrialRecord& record,
                const std::vector<Moment>& moments, const std::string& file);

}  // namespace avoidbench
