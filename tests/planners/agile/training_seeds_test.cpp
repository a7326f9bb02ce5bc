#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "config/sweep_file.hpp"
#include "sweep/sweep_spec.hpp"

/// Maps from 9,000,000 on are for agile's training alone: a suite that flies one would measure what
/// was learned by heart.
namespace agile {
namespace {

constexpr std::uint64_t kFirst = 9'000'000, kLast = 9'999'999;

struct Seeds {
  std::size_t count = 0, reserved = 0;
};

Seeds seeds_of(const std::filesystem::path& file) {
  // The sweeps name planners.
  setenv("AVOIDBENCH_PLANNER_PATH", std::filesystem::path(PLANNER_FILE).parent_path().c_str(), 1);
  Seeds seeds;
  for (const avoidbench::PlannedTrial& trial : expand(avoidbench::read_sweep(file, {}))) {
    const avoidbench::TrialSpec& setting = *trial.setting;
    ++seeds.count;
    if (setting.map_seed >= kFirst && setting.map_seed <= kLast) ++seeds.reserved;
    EXPECT_EQ(setting.seed >= kFirst && setting.seed <= kLast, seeds.reserved > 0) << file;
  }
  return seeds;
}

std::vector<std::filesystem::path> sweeps_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

TEST(TrainingSeeds, AreOfNoSuite) {
  const auto suites = sweeps_in(SOURCE_FOLDER "/configs/sweeps");
  EXPECT_GT(suites.size(), 10U);
  for (const auto& file : suites) EXPECT_EQ(seeds_of(file).reserved, 0U) << file;
}

TEST(TrainingSeeds, AreThoseOfTraining) {
  const auto sweeps = sweeps_in(SOURCE_FOLDER "/planners/agile/train");
  EXPECT_EQ(sweeps.size(), 5U);
  for (const auto& file : sweeps) {
    const Seeds seeds = seeds_of(file);
    EXPECT_GT(seeds.count, 0U);
    EXPECT_EQ(seeds.reserved, seeds.count) << file;
  }
}

}  // namespace
}  // namespace agile
