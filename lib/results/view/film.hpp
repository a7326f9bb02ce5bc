#pragma once

#include "view/replay_sheet.hpp"

namespace avoidbench {

inline constexpr int kFilmWidth_px = 1280, kFilmHeight_px = 720;
inline constexpr double kFilmRate_hz = 25.0;     ///< frames a second
inline constexpr double kFilmMoments_hz = 10.0;  ///< of what the planner saw and drew

/// A replayed flight as a film, frame by frame: from behind the vehicle, shaded; what the planner
/// saw; from above. References must outlive it.
class Film {
 public:
  /// `moments` are those of kFilmMoments_hz, in order.
  Film(const StoredTrial& stored, const World& world, const TrialRecord& record,
       const std::vector<Moment>& moments);
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  std::size_t frame_count() const;
  Picture frame(std::size_t index);  ///< in any order; all have the film's size

 private:
  double time_of(std::size_t frame) const;
  Picture chase(std::size_t frame) const;
  Picture from_above(double time_s, const Moment* moment) const;
  const Moment* moment_at(double time_s) const;

  const StoredTrial& stored_;
  const TrialRecord& record_;
  const std::vector<Moment>& moments_;
  Scene scene_;
  int seen_height_px_;
  Panel plan_;                    ///< of the map, where nothing moves
  std::vector<double> yaws_rad_;  ///< of the chasing camera, a frame each
  std::unique_ptr<StruckObstacle> struck_;
};

}  // namespace avoidbench
