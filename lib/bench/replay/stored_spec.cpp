#include "replay/stored_spec.hpp"

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "base/ticks.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

using nlohmann::json;

template <class T>
void check_value(const json& given, const std::string& path, const T& value, Range range);

/// Visits a spec beside its JSON and throws BadText at the first field that spec_from_json() can't
/// take.
struct FieldCheck {
  const json& object;
  const std::string& prefix;

  template <class T>
  void field(std::string_view name, T& value, Range range, std::string_view) {
    const auto found = object.find(std::string(name));
    // Not there: at its default (spec_from_json()).
    if (found != object.end()) check_value(*found, prefix + std::string(name), value, range);
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    field(name, value, Range{}, doc);
  }
  template <class Variant>
  void variant(std::string_view name, Variant&, std::string_view) {
    const auto wanted = object.find(std::string(name));
    if (wanted == object.end() || !wanted->is_string() ||
        !check_kind<Variant, 0>(wanted->get<std::string>())) {
      throw BadText(prefix + std::string(name) + " is of a kind unknown to this avoidbench");
    }
  }

 private:
  template <class Variant, std::size_t index>
  bool check_kind(const std::string& wanted) {
    if constexpr (index < std::variant_size_v<Variant>) {
      using Kind = std::variant_alternative_t<index, Variant>;
      // Tries the variant's kinds one after the other, at compile time.
      if (wanted != Kind::kind) return check_kind<Variant, index + 1>(wanted);
      Kind held{};
      visit(*this, held);
      return true;
    } else {
      return false;
    }
  }
};

template <class T>
void check_number(const json& given, const std::string& path, Range range) {
  bool has_type = given.is_number();
  if constexpr (std::is_integral_v<T>) {
    // JSON reads a whole number below 0 as signed, others as unsigned; 1.0 is neither.
    has_type = std::is_signed_v<T> ? given.is_number_integer() : given.is_number_unsigned();
  }
  if (!has_type) throw BadText(path + " is not a number of its kind");
  const double value = given.get<double>();
  if (!(value >= range.lowest && value <= range.highest)) {
    throw BadText(path + " is outside of its range");
  }
  if constexpr (std::is_integral_v<T>) {
    // A number too large for T would be cut without a word.
    const bool fits = static_cast<double>(given.get<T>()) == value;
    if (!fits) throw BadText(path + " is outside of its range");
  }
}

template <class T>
void check_value(const json& given, const std::string& path, const T& value, Range range) {
  if constexpr (TextEnum<T>) {
    if (!given.is_string() || !enum_from_text<T>(given.get<std::string>())) {
      throw BadText(path + " is unknown to this avoidbench");
    }
  } else if constexpr (detail::IsOptional<T>::value) {
    if (!given.is_null()) check_value(given, path, typename T::value_type{}, range);
  } else if constexpr (detail::IsSequence<T>::value) {
    // Against a damaged spec: a list in a spec is short.
    constexpr std::size_t kMost = 10000;
    constexpr bool has_any_size = requires(T & sequence) { sequence.resize(0); };
    const bool has_size =
        given.is_array() && given.size() <= kMost && (has_any_size || given.size() == value.size());
    if (!has_size) throw BadText(path + " is not a list of its length");
    for (const json& item : given) check_value(item, path, typename T::value_type{}, range);
  } else if constexpr (Visitable<T, FieldCheck>) {
    if (!given.is_object()) throw BadText(path + " is not an object");
    const std::string prefix = path.empty() ? "" : path + ".";
    FieldCheck check{given, prefix};
    T copy{};
    visit(check, copy);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!given.is_boolean()) throw BadText(path + " is neither true nor false");
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!given.is_string()) throw BadText(path + " is not a text");
  } else {
    check_number<T>(given, path, range);
  }
}

/// Where a sweep file is read such rates are rounded; a stored one that is not whole ticks was
/// written by nobody, and would fail deep within the flight.
void check_rates(const TrialSpec& spec) {
  for (const double rate_hz :
       {spec.rates.physics_hz, spec.rates.plan_hz, spec.rates.sample_hz, spec.sensor.rate_hz,
        spec.imu.rate_hz, spec.odometry.rate_hz, spec.wind.turbulence.rate_hz}) {
    if (!period_ticks(rate_hz)) throw BadText("a rate's period is not a whole number of ticks");
  }
  for (const CameraSpec& camera : spec.sensor.more_cameras) {
    if (!period_ticks(camera.rate_hz))
      throw BadText("a camera's period is not a whole number of ticks");
  }
  for (const LidarSpec& lidar : spec.sensor.lidars) {
    if (!period_ticks(lidar.rate_hz))
      throw BadText("a lidar's period is not a whole number of ticks");
  }
}

}  // namespace

TrialSpec stored_spec(const std::string& spec_json) {
  const json trial = stored_object(spec_json);
  if (!trial.contains("map") || !trial.contains("planner")) {
    throw BadText("it names no map or no planner");
  }
  check_value(trial, "", TrialSpec{}, Range{});
  // Only now: spec_from_json() trusts types and ranges.
  const TrialSpec spec = spec_from_json<TrialSpec>(trial);
  try {
    check_map(spec.map);
    check_wind(spec.wind);
    check_vehicle(spec.vehicle);
  } catch (const InputError& error) {
    throw BadText(error.what());
  }
  check_rates(spec);
  const auto camera_count = static_cast<std::int64_t>(rig_cameras(spec.sensor).size());
  if (spec.planner.camera >= camera_count) throw BadText("its sensor has no such camera");
  return spec;
}

}  // namespace avoidbench
