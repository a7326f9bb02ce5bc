#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "base/enum_text.hpp"
#include "base/fields.hpp"

namespace avoidbench {

/// Gusts of the air; see gust.hpp.
struct GustSpec {
  std::array<double, 3> amplitude_world_mps{0.0, 0.0, 0.0};
  double start_s = 3.0;
  double rise_s = 1.0;
  double hold_s = 0.0;
  double period_s = 0.0;
  double start_jitter_s = 0.0;
  bool random_heading = false;
};

/// A force for a while, as RotorS models gusts.
struct ForceGustSpec {
  std::array<double, 3> force_world_n{0.0, 0.0, 0.0};
  double start_s = 10.0;
  double duration_s = 2.0;
};

enum class TurbulenceModel { none, mil_f_8785c, given };

template <>
struct EnumText<TurbulenceModel> {
  static constexpr std::pair<TurbulenceModel, std::string_view> entries[] = {
      {TurbulenceModel::none, "none"},
      {TurbulenceModel::mil_f_8785c, "mil_f_8785c"},
      {TurbulenceModel::given, "given"}};
};

/// Dryden turbulence; see turbulence.hpp.
struct TurbulenceSpec {
  TurbulenceModel model = TurbulenceModel::none;
  double intensity_ratio = 1.0;
  double wind_6m_mps = 7.7;
  double height_m = 3.048;
  std::array<double, 3> sigma_mps{1.0, 1.0, 0.5};
  std::array<double, 3> length_m{25.0, 25.0, 3.0};
  double airspeed_mps = 5.0;
  double rate_hz = 200.0;
};

/// Pushes and twists out of nowhere; see kicks.hpp.
struct KickSpec {
  double rate_per_min = 0.0;
  double force_n = 0.0;
  double torque_nm = 0.0;
  double duration_s = 0.1;
};

/// A steady wind that differs from place to place; see wind_field.hpp.
struct WindFieldSpec {
  std::string file;         ///< absolute once a sweep file is read; not part of a trial's key
  std::string file_digest;  ///< SHA-256 of the file; part of a trial's key. "": any file will do
  double scale = 1.0;
};

/// All that acts from outside: the parts are added up. The default is still air.
struct WindSpec {
  std::array<double, 3> mean_world_mps{0.0, 0.0, 0.0};
  std::array<double, 3> force_world_n{0.0, 0.0, 0.0};
  std::array<double, 3> torque_body_nm{0.0, 0.0, 0.0};
  GustSpec gust;
  TurbulenceSpec turbulence;
  WindFieldSpec field;
  ForceGustSpec force_gust;
  KickSpec kicks;
  std::uint64_t seed = 1;
};

/// Throws InputError, with all the reasons at once as "field: what is wrong", where the spec
/// contradicts itself. Does not look at files.
void check_wind(const WindSpec& wind);

template <class Visitor, ConstOr<GustSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("amplitude_world_mps", s.amplitude_world_mps, Range{-40, 40},
          "Greatest velocity that a gust adds to the wind, ENU.");
  v.field("start_s", s.start_s, Range{0, 3600}, "When the first gust begins.");
  v.field("rise_s", s.rise_s, Range{0.01, 60}, "Time from calm to the greatest, and back, each.");
  v.field("hold_s", s.hold_s, Range{0, 600}, "Time at the greatest; 0: a full 1-cosine.");
  v.field("period_s", s.period_s, Range{0, 3600},
          "From one gust's start to the next; 0: only one.");
  v.field("start_jitter_s", s.start_jitter_s, Range{0, 600},
          "Each gust begins later by a random time up to this.");
  v.field("random_heading", s.random_heading,
          "Whether each gust is turned about the vertical by a random angle.");
}

template <class Visitor, ConstOr<ForceGustSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("force_world_n", s.force_world_n, Range{-100, 100},
          "Force at the centre of gravity, ENU.");
  v.field("start_s", s.start_s, Range{0, 3600}, "When it begins.");
  v.field("duration_s", s.duration_s, Range{0, 3600}, "How long it lasts.");
}

template <class Visitor, ConstOr<TurbulenceSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("model", s.model,
          "none; mil_f_8785c: strength and lengths from wind_6m_mps and height_m; given: from "
          "sigma_mps and length_m.");
  v.field("intensity_ratio", s.intensity_ratio, Range{0, 100},
          "All standard deviations are multiplied by this.");
  v.field("wind_6m_mps", s.wind_6m_mps, Range{0, 50},
          "mil_f_8785c: wind at 6 m (20 ft); 7.7 is light turbulence, 15.4 moderate, 23.2 severe.");
  v.field("height_m", s.height_m, Range{3.048, 304.8},
          "mil_f_8785c: height above the ground, fixed; the model begins at 3.048 m (10 ft).");
  v.field("sigma_mps", s.sigma_mps, Range{0, 20},
          "given: standard deviation along the mean wind, across it and upwards.");
  v.field("length_m", s.length_m, Range{0.1, 5000}, "given: scale lengths, in the same order.");
  v.field(
      "airspeed_mps", s.airspeed_mps, Range{0.1, 100},
      "Speed at which the turbulence passes by, fixed: the wind is the same for every planner.");
  v.field("rate_hz", s.rate_hz, Range{10, 4000}, "New values per second, held between.");
}

template <class Visitor, ConstOr<KickSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("rate_per_min", s.rate_per_min, Range{0, 6000},
          "Mean number per minute, Poisson; 0: none.");
  v.field("force_n", s.force_n, Range{0, 1000}, "Force of a kick, in a random direction.");
  v.field("torque_nm", s.torque_nm, Range{0, 100}, "Torque of a kick, about a random axis.");
  v.field("duration_s", s.duration_s, Range{0.001, 60}, "How long a kick lasts.");
}

template <class Visitor, ConstOr<WindFieldSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("file", s.file,
          "Grid of velocities, added to the mean; format in docs/wind.md; relative to the sweep "
          "file's folder. \"\": none.");
  v.field("file_digest", s.file_digest,
          "SHA-256 of the file, filled in; where given, the file must have it.");
  v.field("scale", s.scale, Range{-100, 100}, "The file's velocities are multiplied by this.");
}

template <class Visitor, ConstOr<WindSpec> Spec>
void visit(Visitor& v, Spec& s) {
  v.field("mean_world_mps", s.mean_world_mps, Range{-30, 30}, "Velocity of the air, ENU.");
  v.field("force_world_n", s.force_world_n, Range{-100, 100},
          "Constant force on the vehicle at its centre of gravity, ENU.");
  v.field("torque_body_nm", s.torque_body_nm, Range{-10, 10},
          "Constant torque on the vehicle, body frame (FLU).");
  v.field("gust", s.gust, "1-cosine gusts.");
  v.field("turbulence", s.turbulence, "Dryden turbulence.");
  v.field("field", s.field, "A wind that differs from place to place.");
  v.field("force_gust", s.force_gust, "A force for a while, as in RotorS.");
  v.field("kicks", s.kicks, "Random pushes and twists.");
  v.field("seed", s.seed, "Another seed gives other random gusts, turbulence and kicks.");
}

}  // namespace avoidbench
