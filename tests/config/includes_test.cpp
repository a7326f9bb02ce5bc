// Sweep files that include others.
#include "yaml/includes.hpp"

#include "base/random.hpp"
#include "config/sweep_fixture.hpp"
#include "support/mutated.hpp"

namespace avoidbench {
namespace {

class Includes : public SweepFiles {
 protected:
  /// The problems of s.yaml, the folder's name left out.
  std::string problems_of_file(const std::vector<std::string>& overrides = {}) const {
    std::string all = test::message_of([&] { read_sweep(folder_ / "s.yaml", overrides); });
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at = all.find(prefix); at != std::string::npos; at = all.find(prefix)) {
      all.erase(at, prefix.size());
    }
    return all;
  }
};

TEST_F(Includes, MappingsMergeAndTheIncludingFileWins) {
  write("common/base.yaml",
        "sweep: base\nplanners: [tunable, {plugin: tunable, label: b}]\ntrials: 7\n"
        "maps: {generator: hall, height_m: 4, poisson_radius_m: [3, 4]}\n"
        "wind: {mean_world_mps: [1, 0, 0]}\n");
  const SweepSpec sweep = read(
      "include: common/base.yaml\nsweep: mine\nplanners: [tunable]\n"
      "maps: {height_m: 5}\n");
  EXPECT_EQ(sweep.name, "mine");
  EXPECT_EQ(sweep.trials, 7);
  EXPECT_EQ(sweep.planners.size(), 1U);  // lists are replaced
  EXPECT_EQ(std::get<HallSpec>(sweep.base.map).height_m, 5.0);
  EXPECT_EQ(sweep.base.wind.mean_world_mps[0], 1.0);
  ASSERT_EQ(sweep.axes.size(), 1U);  // an included list is an axis as if written here
  EXPECT_EQ(nlohmann::json(sweep.axes[0].values).dump(), "[3.0,4.0]");
}

TEST_F(Includes, LaterFilesWinAndTheCommandLineWinsOverAll) {
  write("a.yaml", "sweep: a\nplanners: [tunable]\ntrials: 1\nseed: 1\nrates: {plan_hz: 10}\n");
  write("b.yaml", "trials: 2\nseed: 2\nrates: {sample_hz: 50}\n");
  const std::string text = "include: [a.yaml, b.yaml]\nseed: 3\n";
  const SweepSpec sweep = read(text);
  EXPECT_EQ(sweep.trials, 2);
  EXPECT_EQ(sweep.base.seed, 3U);
  EXPECT_EQ(sweep.base.rates.plan_hz, 10.0);
  EXPECT_EQ(sweep.base.rates.sample_hz, 50.0);
  EXPECT_EQ(read(text, {"seed=4", "rates.plan_hz=20"}).base.seed, 4U);
  EXPECT_EQ(read(text, {"seed=4", "rates.plan_hz=20"}).base.rates.plan_hz, 20.0);
}

TEST_F(Includes, RangesAreReplacedButOneOfTheirKeysMayChange) {
  write("a.yaml",
        "sweep: a\nplanners: [tunable]\nmaps: {poisson_radius_m: {from: 2, to: 6, count: 5}}\n");
  const auto values = [&](const std::string& radius) {
    const SweepSpec sweep = read("include: a.yaml\nmaps: {poisson_radius_m: " + radius + "}\n");
    return sweep.axes.empty() ? "" : nlohmann::json(sweep.axes[0].values).dump();
  };
  EXPECT_EQ(values("{from: 3, to: 4, step: 0.5}"), "[3.0,3.5,4.0]");
  EXPECT_EQ(values("{count: 3}"), "[2.0,4.0,6.0]");
  EXPECT_EQ(values("[4, 5]"), "[4.0,5.0]");
  EXPECT_EQ(values("4"), "");
}

TEST_F(Includes, AnEmptyValueTakesOutWhatWasIncluded) {
  write("a.yaml",
        "sweep: a\nplanners: [tunable]\nmaps: {generator: forest, bush_ratio: 0.1}\n"
        "axes: {wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]]}\n");
  const SweepSpec sweep =
      read("include: a.yaml\nmaps: {generator: hall, bush_ratio: ~}\naxes: ~\n");
  EXPECT_EQ(kind(sweep.base.map), "hall");
  EXPECT_TRUE(sweep.axes.empty());
}

TEST_F(Includes, FieldsCanBeLaidOverAnIncludedName) {
  write("a.yaml", "sweep: a\nplanners: [tunable]\nvehicle: firefly\nsensor: stereo_sgm\n");
  const TrialSpec trial =
      read("include: a.yaml\nvehicle: {mass_kg: 1.6}\nsensor: depth_noisy\n").base;
  EXPECT_EQ(trial.vehicle.name, "firefly");
  EXPECT_EQ(trial.vehicle.mass_kg, 1.6);
  EXPECT_EQ(trial.sensor.name, "depth_noisy");
}

TEST_F(Includes, PathsInAnIncludedFileAreRelativeToIt) {
  write("common/maps/a.obj", "v 0 0 0\n");
  write("common/vehicles/heavy.yaml", "mass_kg: 0.9\n");
  std::filesystem::create_directories(folder_ / "common/built");
  std::filesystem::copy(std::string(CONFIG_TEST_PLANNERS) + "/tunable.so",
                        folder_ / "common/built/mine.so");
  write("common/base.yaml",
        "sweep: a\nplanners: [./built/mine.so]\nvehicle: heavy\n"
        "maps: {generator: mesh, file: maps/a.obj}\n");
  write("common/deep/more.yaml", "include: ../base.yaml\n");
  const SweepSpec sweep = read("include: common/deep/more.yaml\n");
  EXPECT_EQ(sweep.base.vehicle.mass_kg, 0.9);
  EXPECT_EQ(std::get<MeshSpec>(sweep.base.map).file, (folder_ / "common/maps/a.obj").string());
  EXPECT_EQ(sweep.planners[0].label, "tunable");
}

TEST_F(Includes, VehicleAndSensorFilesMayIncludeToo) {
  write("vehicles/base.yaml", "preset: firefly\nmass_kg: 1.6\nposition_controller: {kp_z: 7}\n");
  write("vehicles/mine.yaml", "include: base.yaml\nname: mine\nposition_controller: {kd_z: 3}\n");
  const VehicleSpec vehicle = read("sweep: a\nplanners: [tunable]\nvehicle: mine\n").base.vehicle;
  EXPECT_EQ(vehicle.name, "mine");
  EXPECT_EQ(vehicle.rotors.size(), 6U);
  EXPECT_EQ(vehicle.mass_kg, 1.6);
  EXPECT_EQ(vehicle.position_controller.kp_z, 7.0);
  EXPECT_EQ(vehicle.position_controller.kd_z, 3.0);
}

TEST_F(Includes, ProblemsHaveTheFileAndLineTheyStandIn) {
  write("base.yaml", "sweep: a\nplanners: [tunable]\ntrials: 0\nmaps:\n  bush_ratio: 7\n");
  write("other.yaml", "rates:\n  plan_hz: fast\n");
  write("s.yaml", "include:\n  - base.yaml\n  - other.yaml\nmaps: {height: 4}\n");
  EXPECT_EQ(problems_of_file(),
            "s.yaml:4:8: maps.height: unknown key for generator forest (did you mean height_m?)\n"
            "base.yaml:3:9: trials: 0 is outside [1, 1000000]\n"
            "base.yaml:5:15: maps.bush_ratio: 7 is outside [0, 1]\n"
            "other.yaml:2:12: rates.plan_hz: expected a number, found \"fast\"");
  EXPECT_EQ(problems_of_file({"trials=1", "rates=~", "maps={}"}),
            "--set rates=~: rates: expected a mapping (name: value), found nothing");
}

TEST_F(Includes, ContradictionsBetweenFilesStandWhereTheirValueDoes) {
  write("base.yaml", "sweep: a\nplanners: [tunable]\nmaps: {flight_height_m: 5}\n");
  EXPECT_EQ(problems("include: base.yaml\nmaps: {height_m: 4}\n"),
            "base.yaml:3:25: maps.flight_height_m: 5 is not below height_m, 4");
}

TEST_F(Includes, WhatCannotBeIncludedIsToldAtTheIncludeLine) {
  EXPECT_EQ(problems("sweep: a\ninclude: [none.yaml, sub]\n"),
            "s.yaml:2:11: include: none.yaml: no such file\n"
            "s.yaml:2:22: include: sub: no such file");
  EXPECT_EQ(problems("include: .\n"), "s.yaml:1:10: include: : is a folder, not a file");
  EXPECT_EQ(problems("include: []\n"),
            "s.yaml:1:10: include: expected a file or a list of files, found an empty list");
  EXPECT_EQ(problems("include: {a: b}\n"),
            "s.yaml:1:10: include: expected a file or a list of files, found a mapping");
  EXPECT_EQ(problems("include: ~\n"),
            "s.yaml:1:10: include: expected a file or a list of files, found nothing");
  write("empty.yaml", "# nothing\n");
  EXPECT_EQ(problems("include: empty.yaml\n"),
            "s.yaml:1:10: include: empty.yaml: the document is empty");
  write("list.yaml", "- 1\n");
  EXPECT_EQ(problems("include: list.yaml\n"),
            "list.yaml:1:1: expected a mapping (name: value), found a list");
  write("twice.yaml", "seed: 1\nseed: 2\n");
  EXPECT_EQ(problems("include: twice.yaml\n"),
            "twice.yaml:2:1: seed: this key is given twice, first in line 1");
  EXPECT_EQ(problems("include: twice.yaml\ninclude: twice.yaml\n"),
            "s.yaml:2:1: include: this key is given twice, first in line 1");
}

/// It may be any file that the user can read, in a sweep of somebody else's.
TEST_F(Includes, OfAFileThatIsNoPartOfASweepNothingIsQuoted) {
  write("shadow", "root:$y$secret1:19000::\ndaemon:$y$secret2:19000::\n");
  write("twice", "$y$secret:19000::\n$y$secret:19000::\n");
  write("text", "a secret\n");
  for (const std::string key : {"include", "vehicle", "sensor"}) {
    const auto of = [&](const std::string& file) {
      const std::string all =
          problems("sweep: a\nplanners: [tunable]\n" + key + ": ./" + file + "\n");
      return all.starts_with("./") ? all.substr(2) : all;
    };
    const std::string expected = ":1:1: expected a mapping (name: value), found ";
    EXPECT_EQ(of("shadow"), "shadow" + expected + "a key that is not a name");
    EXPECT_EQ(of("twice"), "twice:2:1: this key is given twice, first in line 1");
    EXPECT_EQ(of("text"), "text" + expected + "text");
  }
}

TEST_F(Includes, CirclesAndTooManyFilesAreRefused) {
  EXPECT_EQ(problems("include: s.yaml\n"),
            "s.yaml:1:10: include: includes itself: s.yaml → s.yaml");
  write("a.yaml", "include: sub/../b.yaml\n");
  write("b.yaml", "\ninclude: [a.yaml]\n");
  std::filesystem::create_directories(folder_ / "sub");
  EXPECT_EQ(problems("include: a.yaml\n"),
            "b.yaml:2:11: include: includes itself: s.yaml → a.yaml → b.yaml → a.yaml");
  for (int i = 0; i < 12; ++i) {
    const std::string next = "n" + std::to_string(i + 1) + ".yaml";
    write("n" + std::to_string(i) + ".yaml", "include: [" + next + ", " + next + "]\n");
  }
  EXPECT_TRUE(problems("include: n0.yaml\n").starts_with("n7.yaml:1:11: include: nested deeper"));
  std::string many = "include: [";
  write("plain.yaml", "seed: 1\n");
  for (int i = 0; i < 65; ++i) many += "plain.yaml, ";
  EXPECT_NE(problems(many + "]\n").find("include: more than 64 included files"), std::string::npos);
  // Two files of one folder that both include a third are no circle.
  write("c.yaml", "include: plain.yaml\n");
  EXPECT_EQ(read("include: [c.yaml, plain.yaml]\nsweep: a\nplanners: [tunable]\n").base.seed, 1U);
}

TEST_F(Includes, TheResolvedDocumentReadsBack) {
  write("a.yaml",
        "sweep: 'a'\nplanners: [tunable, {plugin: tunable, label: \"it's: x\"}]\n"
        "maps:\n  generator: hall\n  poisson_radius_m: {from: 2, to: 6, count: 5}\n"
        "  area_m: [20, 30]\naxes: {wind.mean_world_mps: [[0, 0, 0], [4, 0, 0]]}\n");
  const auto file = write("s.yaml", "include: a.yaml\nvehicle: firefly\nmaps: {height_m: 4}\n");
  const std::string text = document_text(read_document(file));
  EXPECT_NE(text.find("  height_m: 4"), std::string::npos) << text;
  EXPECT_NE(text.find("# " + file.string() + ":3"), std::string::npos) << text;
  const SweepSpec whole = read_sweep(file);
  const SweepSpec again = read_sweep(write("again.yaml", text));
  EXPECT_EQ(spec_to_json(again.base), spec_to_json(whole.base));
  ASSERT_EQ(again.axes.size(), whole.axes.size());
  for (std::size_t i = 0; i < whole.axes.size(); ++i) {
    EXPECT_EQ(again.axes[i].values, whole.axes[i].values);
  }
  EXPECT_EQ(again.planners.back().label, "it's: x");
}

/// Bytes of files that include each other changed at random: a sweep or an InputError, nothing
/// else.
TEST_F(Includes, MutatedFilesNeverCrash) {
  const std::vector<std::string> good{
      "include: [a.yaml, b.yaml]\nsweep: s\nvehicle: {mass_kg: 1}\nmaps: {bush_ratio: ~}\n",
      "include: b.yaml\nvehicle: firefly\nmaps: {generator: hall, height_m: 4}\n",
      "planners: [tunable]\nmaps: {bush_ratio: 0.5, poisson_radius_m: {from: 2, to: 6, count: "
      "5}}\n"};
  const std::vector<std::string> names{"s.yaml", "a.yaml", "b.yaml"};
  const std::string special = "{}[],:&*!|>'\"#?- \n.059eabs~";
  RandomStream random = stream(3, "include mutations");
  int accepted = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    for (std::size_t i = 0; i < good.size(); ++i) {
      write(names[i], test::mutated(good[i], 2, special, random));
    }
    try {
      read_sweep(folder_ / "s.yaml");
      ++accepted;
    } catch (const InputError& error) {
      ++refused;
      EXPECT_FALSE(error.problems().empty());
    }
  }
  EXPECT_GT(accepted, 5);
  EXPECT_GT(refused, 20);
}

TEST_F(Includes, RatesForLearningComeAlong) {
  const std::string file = std::string(AVOIDBENCH_SOURCE_DIR) + "/configs/rates/learning.yaml";
  const SweepSpec sweep = read("include: " + file + "\nsweep: mine\nplanners: [tunable]\n");
  EXPECT_EQ(sweep.base.rates.physics_hz, 250.0);
  EXPECT_EQ(sweep.base.rates.sample_hz, 50.0);
  EXPECT_EQ(sweep.base.rates.plan_hz, RatesSpec{}.plan_hz);
  EXPECT_EQ(RatesSpec{}.physics_hz, 1000.0);
}

}  // namespace
}  // namespace avoidbench
