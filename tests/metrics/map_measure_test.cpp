#include "metrics/map_measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/metric_table.hpp"

namespace avoidbench {
namespace {

TEST(MapMeasure, IsThatOfTheMapsRecord) {
  TrialSpec trial;
  trial.map = HallSpec{.area_m = {10, 14}, .poisson_radius_m = 3.0};
  const World world = make_world(trial.map, 2);
  const MapRecord record = make_map_record(trial, Scene(world), 2);
  EXPECT_EQ(map_measure(trial, 2, "traversability", 2), record.traversability);
  double sum = 0.0, count = 0.0;
  for (const MissionRecord& mission : record.missions) {
    if (!mission.is_valid) continue;
    sum += mission.reference_length_m;
    count += 1.0;
  }
  ASSERT_GT(count, 0.0);
  EXPECT_EQ(map_measure(trial, 2, "reference_length_m", 2), sum / count);
}

TEST(MapMeasure, MeansLeaveOutWhatIsNotThere) {
  const auto length = [](const MissionRecord& mission) { return mission.reference_length_m; };
  MapRecord map;
  EXPECT_TRUE(std::isnan(mission_mean(map, length)));
  map.missions.resize(4);
  map.missions[0].reference_length_m = 10.0;
  map.missions[1].reference_length_m = std::nan("");
  map.missions[2].reference_length_m = 20.0;
  map.missions[3].reference_length_m = 1000.0;
  map.missions[3].is_valid = false;
  EXPECT_EQ(mission_mean(map, length), 15.0);
}

TEST(MapMeasure, NamesAreThoseOfBothTables) {
  const std::vector<std::string> names = map_measure_names();
  EXPECT_EQ(names.size(), map_metric_table().size() + mission_metric_table().size());
  EXPECT_NE(std::find(names.begin(), names.end(), "traversability"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "view_occlusion"), names.end());
}

}  // namespace
}  // namespace avoidbench
