#include "vehicle/vehicle_spec.hpp"

#include <gtest/gtest.h>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "support/input_error_message.hpp"
#include "wind/wind_spec.hpp"

namespace avoidbench {
namespace {

std::string refusal(const VehicleSpec& spec) {
  return test::message_of([&] { check_vehicle(spec); });
}

TEST(VehicleSpec, PresetsFly) {
  for (const VehicleSpec& spec : vehicle_presets()) {
    EXPECT_EQ(refusal(spec), "") << spec.name;
  }
}

// Another value is another vehicle: flights, tables and what papers say of them follow.
TEST(VehicleSpec, PresetsAreThoseThatWerePublished) {
  std::string digests;
  for (const VehicleSpec& spec : vehicle_presets()) {
    digests += spec.name + ' ' + Digest().add(spec_to_json(spec).dump()).hex().substr(0, 8) + '\n';
  }
  EXPECT_EQ(digests,
            "hummingbird a8b1d8e6\nhummingbird_rotors 075bc876\nfirefly efad574b\n"
            "racing_5in 1195aa47\nagile_quad 84e5cd06\nx500 357f9d68\ncrazyflie b8d3b92e\n");
}

TEST(VehicleSpec, ImpossibleVehiclesAreRefused) {
  VehicleSpec spec;
  spec.rotors.clear();
  EXPECT_NE(refusal(spec).find("not one to eight"), std::string::npos);
  spec = {};
  spec.rotors.resize(9);
  EXPECT_NE(refusal(spec).find("not one to eight"), std::string::npos);
  spec = {};
  spec.rotors.resize(3);
  EXPECT_NE(refusal(spec).find("independently"), std::string::npos);
  spec = {};
  for (RotorSpec& rotor : spec.rotors) rotor.spin = 1;
  EXPECT_NE(refusal(spec).find("independently"), std::string::npos);
  spec = {};
  spec.rotors[2].spin = 0;
  EXPECT_NE(refusal(spec).find("rotors[2].spin"), std::string::npos);
  spec = {};
  spec.mass_kg = 5.0;
  EXPECT_NE(refusal(spec).find("can't hover"), std::string::npos);
  spec = {};
  for (RotorSpec& rotor : spec.rotors) rotor.position_body_m[0] += 0.5;
  EXPECT_NE(refusal(spec).find("can't hover"), std::string::npos);
  spec = {};
  spec.max_acceleration_mps2 = 40.0;
  EXPECT_NE(refusal(spec).find("too weak"), std::string::npos);
  spec = {};
  spec.rate_controller.rate_hz = 700.0;
  EXPECT_NE(refusal(spec).find("whole number of ticks"), std::string::npos);
}

struct RangeCheck {
  int count = 0;

  void field(std::string_view name, double value, Range range, std::string_view doc) {
    ++count;
    EXPECT_GE(value, range.lowest) << name;
    EXPECT_LE(value, range.highest) << name;
    EXPECT_FALSE(doc.empty()) << name;
  }
  template <std::size_t count>
  void field(std::string_view name, std::array<double, count>& values, Range range,
             std::string_view doc) {
    for (const double value : values) field(name, value, range, doc);
  }
  template <class T>
  void field(std::string_view name, T& value, std::string_view doc) {
    EXPECT_FALSE(doc.empty()) << name;
    if constexpr (Visitable<T, RangeCheck>) visit(*this, value);
  }
};

TEST(VehicleSpec, PresetsAreWithinTheirRanges) {
  for (VehicleSpec spec : vehicle_presets()) {
    RangeCheck check;
    visit(check, spec);
    EXPECT_GT(check.count, 30);
  }
}

TEST(VehicleSpec, SurvivesJson) {
  VehicleSpec spec = firefly_spec();
  spec.position_controller.kp_xy = 7.25;
  const auto json = spec_to_json(spec);
  EXPECT_EQ(spec_to_json(spec_from_json<VehicleSpec>(json)), json);
  EXPECT_EQ(json["rotors"].size(), 6U);
  WindSpec wind;
  wind.mean_world_mps = {1, 2, 3};
  EXPECT_EQ(spec_from_json<WindSpec>(spec_to_json(wind)).mean_world_mps, wind.mean_world_mps);
}

}  // namespace
}  // namespace avoidbench
