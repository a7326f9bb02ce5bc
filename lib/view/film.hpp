#pragma once

#include <memory>
#include <vector>

#include "drawing/picture.hpp"
#include "view/replay_sheet.hpp"

namespace avoidbench {

struct FilmSpec {
  int width_px = 1280, height_px = 720;
  double rate_hz = 25.0;  ///< frames a second
};

inline constexpr double kFilmMoments_hz = 10.0;  ///< of what the planner saw and drew

/// A replayed flight as a film, frame by frame: from behind the vehicle, shaded; what the planner
/// saw; from above. References must outlive it.
class Film {
 public:
  /// `moments` are those of kFilmMoments_hz, in order.
  Film(const StoredTrial& stored, const World& world, const TrialRecord& record,
       const std::vector<Moment>& moments, const FilmSpec& spec);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  std::size_t frame_count() const;
  Picture frame(std::size_t index);  ///< in any order; all have the film's size

 private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};

}  // namespace avoidbench
