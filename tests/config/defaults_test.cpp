#include "config/defaults.hpp"

#include <sstream>

#include "base/random.hpp"
#include "config/field_reader.hpp"
#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"

namespace avoidbench {
namespace {

/// The printed sweep with the planner that is there in this test.
std::string printed_sweep() {
  std::string text = defaults_yaml("sweep");
  const std::size_t at = text.find("  - straight_line\n  - reactive\n");
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, std::string("  - straight_line\n  - reactive\n").size(), "  - tunable\n");
}

TEST_F(SweepFiles, PrintedDefaultsReadBack) {
  const SweepSpec sweep = read(printed_sweep());
  EXPECT_EQ(spec_to_json(sweep.base), spec_to_json(TrialSpec{}));
  EXPECT_EQ(sweep.trials, SweepSpec{}.trials);
  EXPECT_TRUE(sweep.axes.empty());
}

TEST_F(SweepFiles, TheOtherGeneratorsPrintedFieldsReadBackToo) {
  for (const MapSpec& other :
       {MapSpec(HallSpec{}), MapSpec(AvoidbenchForestSpec{}), MapSpec(AvoidbenchIndoorSpec{})}) {
    // Comment the forest out and the other in, whose lines begin after its generator's.
    std::istringstream lines(printed_sweep());
    std::string text;
    bool in_maps = false, in_other = false;
    for (std::string line; std::getline(lines, line);) {
      if (line == "maps:") {
        in_maps = true;
      } else if (in_maps && line.starts_with("  # ")) {
        if (line.starts_with("  # generator: ")) {
          in_other = line == "  # generator: " + std::string(kind(other));
        }
        if (in_other) line = "  " + line.substr(4);
      } else if (in_maps && line.starts_with("  ") && line.find("seeds:") == std::string::npos) {
        line = "  # " + line.substr(2);
      } else {
        in_maps = in_maps && line.starts_with("  ");
      }
      text += line + "\n";
    }
    TrialSpec expected;
    expected.map = other;
    EXPECT_EQ(spec_to_json(read(text).base), spec_to_json(expected));
  }
}

TEST_F(SweepFiles, EveryFieldIsPrintedWithADoc) {
  std::istringstream lines(defaults_yaml("sweep"));
  int fields = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_field = line.starts_with("  ") && line.find(": ") != std::string::npos &&
                          line.find("- {") == std::string::npos &&
                          !line.starts_with("  # generator") && !line.starts_with("  # kind: ");
    if (!is_field) continue;
    ++fields;
    EXPECT_NE(line.find("# ", 4), std::string::npos) << line;
  }
  EXPECT_GT(fields, 100);
}

/// What a file of a vehicle or sensor says, as the JSON of its spec.
nlohmann::json read_as(const FieldTree& tree, const YamlNode& root) {
  nlohmann::json spec = preset_json(tree);
  Reading reading;
  read_block({root, tree.name, reading}, tree, spec);
  EXPECT_EQ(test::joined(reading.problems), "");
  return spec;
}

nlohmann::json read_file(const FieldTree& tree, const std::string& name) {
  return read_as(tree, read_yaml(std::filesystem::path(AVOIDBENCH_SOURCE_DIR) / "configs" / name));
}

TEST(Configs, FilesEqualTheBuiltInSpecs) {
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    EXPECT_EQ(read_file(vehicle_tree(), "vehicles/" + vehicle.name + ".yaml"),
              spec_to_json(vehicle));
  }
  for (const SensorSpec& sensor : sensor_presets()) {
    EXPECT_EQ(read_file(sensor_tree(), "sensors/" + sensor.name + ".yaml"), spec_to_json(sensor));
  }
}

TEST(Configs, PrintedSpecsReadBackToTheSameBits) {
  for (const VehicleSpec& vehicle : vehicle_presets()) {
    EXPECT_EQ(read_as(vehicle_tree(), parse_yaml(defaults_yaml(vehicle.name), "v")),
              spec_to_json(vehicle));
  }
  for (const SensorSpec& sensor : sensor_presets()) {
    EXPECT_EQ(read_as(sensor_tree(), parse_yaml(defaults_yaml(sensor.name), "s")),
              spec_to_json(sensor));
  }
}

TEST_F(SweepFiles, TheSweepsThatComeAlongAreGood) {
  for (const char* name : {"quick", "forest_small", "hall_small", "paper_outdoor", "paper_indoor",
                           "paper_outdoor_small", "paper_indoor_small", "wind"}) {
    const std::filesystem::path file = std::filesystem::path(AVOIDBENCH_SOURCE_DIR) /
                                       "configs/sweeps" / (std::string(name) + ".yaml");
    const SweepSpec sweep = read_sweep(file, {"planners=[tunable]"});
    EXPECT_EQ(sweep.name, name);
    EXPECT_FALSE(sweep.axes.empty());
  }
}

TEST_F(SweepFiles, ThePapersSweepsHaveItsSizesAndASixthOfThem) {
  const std::filesystem::path folder =
      std::filesystem::path(AVOIDBENCH_SOURCE_DIR) / "configs/sweeps";
  for (const std::string name : {"paper_outdoor", "paper_indoor"}) {
    const SweepSpec whole = read_sweep(folder / (name + ".yaml"), {"planners=[tunable]"});
    const SweepSpec sixth = read_sweep(folder / (name + "_small.yaml"), {"planners=[tunable]"});
    EXPECT_EQ(whole.axes.front().values.size() * static_cast<std::size_t>(whole.trials), 900U);
    EXPECT_EQ(sixth.axes.front().values.size() * static_cast<std::size_t>(sixth.trials), 150U);
    EXPECT_EQ(whole.axes.front().values.front(), sixth.axes.front().values.front());
    EXPECT_EQ(whole.axes.front().values.back(), sixth.axes.front().values.back());
    EXPECT_EQ(whole.planners.front().parameters[4].number, 3.0);  // max_speed_mps
  }
}

}  // namespace
}  // namespace avoidbench
