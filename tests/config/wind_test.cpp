// The block `wind` of a sweep: its fields as axes, the file of a wind field, and vehicles'
// controllers.
#include "base/digest.hpp"
#include "config/sweep_fixture.hpp"

namespace avoidbench {
namespace {

using WindBlock = SweepFiles;

const std::string kSweep = "sweep: a\nplanners: [tunable]\n";
const std::string kField =
    "min_x: 0 min_y: 0 n_x: 1 n_y: 1 res_x: 1 res_y: 1 vertical_spacing_factors: 0\n"
    "bottom_z: 0 top_z: 1 u: 1 v: 2 w: 3\n";

TEST_F(WindBlock, AnyScalarIsAnAxis) {
  const SweepSpec sweep = read(
      kSweep +
      "wind:\n  turbulence: {model: mil_f_8785c, wind_6m_mps: [0, 7.7, 15.4]}\n  seed: [1, 2]\n"
      "axes:\n  wind.gust.amplitude_world_mps: [[0, 0, 0], [6, 0, 0]]\n"
      "  wind.kicks.rate_per_min: {from: 0, to: 20, count: 3}\n  vehicle.controller: [rpg, lee]\n"
      "  wind.turbulence.model: [none, given]\n");
  ASSERT_EQ(sweep.axes.size(), 6U);
  EXPECT_EQ(sweep.axes[0].path, "wind.turbulence.wind_6m_mps");
  EXPECT_EQ(sweep.axes[0].values.size(), 3U);
  EXPECT_EQ(sweep.axes[1].path, "wind.seed");
  EXPECT_EQ(sweep.axes[2].values[1][0], 6.0);
  EXPECT_EQ(sweep.axes[3].values[1], 10.0);
  EXPECT_EQ(sweep.axes[4].values[1], "lee");
  EXPECT_EQ(sweep.axes[5].values[1], "given");
}

TEST_F(WindBlock, WhatIsWrongIsReportedWithItsPlace) {
  EXPECT_EQ(
      problems(kSweep + "wind: {gust: {period_s: 1}}\n"),
      "s.yaml:3:25: wind.gust.period_s: shorter than a gust with its jitter (2 rise_s + hold_s "
      "+ start_jitter_s)");
  EXPECT_EQ(problems(kSweep + "wind: {turbulence: {model: drydn}}\n"),
            "s.yaml:3:28: wind.turbulence.model: \"drydn\" is not one of none, mil_f_8785c, given");
  EXPECT_EQ(problems(kSweep + "wind: {kicks: {rate_per_min: -1}}\n"),
            "s.yaml:3:30: wind.kicks.rate_per_min: -1 is outside [0, 6000]");
  EXPECT_EQ(problems(kSweep + "vehicle: {controller: le}\n"),
            "s.yaml:3:23: vehicle.controller: \"le\" is not one of rpg, lee (did you mean lee?)");
}

TEST_F(WindBlock, AFieldsFileIsRelativeToTheSweepAndItsDigestIsFilledIn) {
  const std::filesystem::path file = write("air/a.txt", kField);
  const std::filesystem::path yaml =
      write("sweeps/s.yaml", kSweep + "wind: {field: {file: ../air/a.txt, scale: 2}}\n");
  const SweepSpec sweep = read_sweep(yaml, {});
  EXPECT_EQ(sweep.base.wind.field.file, file.string());
  EXPECT_EQ(sweep.base.wind.field.file_digest, file_digest(file));
  EXPECT_EQ(sweep.base.wind.field.scale, 2.0);
}

TEST_F(WindBlock, AFieldThatIsNoneIsToldBeforeTheFirstTrial) {
  const std::string head = kSweep + "wind: {field: {file: a.txt";
  EXPECT_EQ(problems(head + "}}\n"), "s.yaml:3:22: wind.field.file: no file a.txt");
  write("a.txt", "min_x: 0\nmin_y: zero\n");
  EXPECT_EQ(problems(head + "}}\n"),
            "s.yaml:3:22: wind.field.file: a.txt:2:8: min_y: 'zero' is not a finite number");
  const std::string digest = file_digest(write("a.txt", kField));
  EXPECT_EQ(problems(head + "}}\n"), "");
  EXPECT_EQ(problems(head + ", file_digest: 00}}\n"),
            "s.yaml:3:42: wind.field.file_digest: is not that of a.txt, " + digest);
  EXPECT_EQ(problems(head + ", file_digest: " + digest + "}}\n"), "");
}

TEST_F(WindBlock, SeveralFieldsAreAnAxisAndNoneIsOneOfThem) {
  const std::filesystem::path file = write("a.txt", kField);
  const SweepSpec sweep = read(kSweep + "wind: {field: {file: [\"\", a.txt]}}\n");
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(sweep.axes[0].values[0], "");
  EXPECT_EQ(sweep.axes[0].values[1], file.string());
  EXPECT_EQ(problems(kSweep + "wind: {field: {file: [a.txt, b.txt]}}\n"),
            "s.yaml:3:22: wind.field.file: no file b.txt");
  EXPECT_EQ(problems(kSweep + "wind: {field: {file: [\"\", a.txt], file_digest: 00}}\n"),
            "s.yaml:3:48: wind.field.file_digest: can't be that of several files");
}

TEST_F(WindBlock, AVehicleOfOnesOwnIsReadWhole) {
  write("vehicles/own.yaml",
        "name: own_x\nmass_kg: 1.2\ninertia_kgm2: [0.01, 0.011, 0.018]\n"
        "rotors:\n  - {position_body_m: [0.15, -0.15, 0.02], spin: -1}\n"
        "  - {position_body_m: [0.15, 0.15, 0.02], spin: 1}\n"
        "  - {position_body_m: [-0.15, 0.15, 0.02], spin: -1}\n"
        "  - {position_body_m: [-0.15, -0.15, 0.02], spin: 1}\n"
        "max_rotor_speed_radps: 1100\nbody_size_m: [0.5, 0.5, 0.15]\nmax_speed_mps: 6\n"
        "controller: lee\nlee_controller: {position_n_per_m: [6, 6, 8]}\n");
  const VehicleSpec vehicle = read(kSweep + "vehicle: own\n").base.vehicle;
  EXPECT_EQ(vehicle.name, "own_x");
  EXPECT_EQ(vehicle.rotors[3].spin, 1);
  EXPECT_EQ(vehicle.inertia_kgm2[1], 0.011);
  EXPECT_EQ(vehicle.controller, Controller::lee);
  EXPECT_EQ(vehicle.lee_controller.position_n_per_m[2], 8.0);
  EXPECT_EQ(vehicle.lee_controller.velocity_ns_per_m[2], 2.2);
  EXPECT_EQ(read(kSweep + "vehicle: hummingbird_rotors\n").base.vehicle.gravity_mps2, 9.8);
}

}  // namespace
}  // namespace avoidbench
