#pragma once

#include <string>
#include <vector>

#include "view/film.hpp"

namespace avoidbench {

/// Throws InputError where the file's name does not end in .mp4, .webm or .gif, it can't be
/// written, or there is no ffmpeg. For before a flight.
void check_film(const std::string& file);

/// Draws the flight and feeds it to ffmpeg; says on stderr how far it is.
void write_film(const StoredTrial& stored, const World& world, const TrialRecord& record,
                const std::vector<Moment>& moments, const std::string& file);

}  // namespace avoidbench
