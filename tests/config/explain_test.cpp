// What is told of keys, and that every example is a good line of a sweep file.
#include "config/explain.hpp"

#include <algorithm>
#include <set>

#include "config/sweep_fixture.hpp"
#include "config/sweep_keys.hpp"

namespace avoidbench {
namespace {

std::vector<PlannerDescription> tunable() {
  std::vector<std::string> problems;
  return list_planners(problems);
}

std::string fact(const Explanation& about, const std::string& name) {
  for (const auto& [fact_name, text] : about.facts) {
    if (fact_name == name) return text;
  }
  return "";
}

TEST_F(SweepFiles, EveryKeyIsExplainedAndItsExamplesAreGood) {
  std::set<std::string> paths;
  for (const KindField& entry : all_fields(sweep_tree())) paths.insert(entry.path);
  EXPECT_GT(paths.size(), 200U);
  int examples = 0, axes = 0;
  for (const std::string& path : paths) {
    // Files, or a period that leaves room for a gust.
    const std::set<std::string> others{"include",          "planners",           "wind.field.file",
                                       "latency.database", "wind.gust.period_s", "mission.file"};
    const bool needs_more = others.contains(path);
    for (const Explanation& about : explain(path, {})) {
      EXPECT_GT(about.title.size(), path.size() + 2) << path;
      EXPECT_TRUE(!about.facts.empty() || !about.keys.empty()) << path;
      for (const auto& [name, text] : about.facts) {
        const bool is_line = name == "example" || name == "axis" || name == "or";
        if (!is_line || needs_more || text.find(": ") == std::string::npos) continue;
        const bool needs_map_file = fact(about, "with").find("mesh") != std::string::npos ||
                                    fact(about, "with").find("point_cloud") != std::string::npos;
        if (text.starts_with("no: ") || needs_map_file) continue;
        const std::string head = text.starts_with("sweep:") ? "" : "sweep: a\n";
        SCOPED_TRACE(path + "\n" + text);
        std::vector<std::string> kinds;  // that an entry of axes needs beside it
        std::string with = fact(about, "with");
        with = with.substr(0, with.find_first_of(",;"));
        if (const std::size_t colon = with.find(": "); colon != std::string::npos) {
          kinds.push_back(with.replace(colon, 2, "="));
        }
        ASSERT_EQ(problems(head + "planners: [tunable]\n" + text + "\n", kinds), "");
        ++examples;
        if (name == "axis" && path != "max_speed_mps") {
          EXPECT_EQ(read(head + "planners: [tunable]\n" + text + "\n").axes.size(), 1U);
          ++axes;
        }
      }
    }
  }
  EXPECT_GT(examples, 600);
  EXPECT_GT(axes, 180);
}

TEST_F(SweepFiles, AFieldIsReportedWithRangeDefaultAndUnit) {
  const std::vector<Explanation> found = explain("maps.bush_ratio", {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].title, "maps.bush_ratio: Fraction of the plants that are bushes.");
  EXPECT_EQ(fact(found[0], "with"), "maps.generator: forest, avoidbench_forest");
  EXPECT_EQ(fact(found[0], "range"), "0 to 1");
  EXPECT_EQ(fact(found[0], "default"), "0.4");
  EXPECT_EQ(fact(found[0], "example"), "maps: {generator: forest, bush_ratio: 0.8}");
  EXPECT_EQ(fact(explain("rates.plan_hz", {})[0], "type"), "number, Hz");
  EXPECT_EQ(fact(explain("latency.mode", {})[0], "type"), "one of zero, fixed, measured, replay");
  EXPECT_EQ(fact(explain("wind.mean_world_mps", {})[0], "type"), "list of 3 numbers, m/s");
  EXPECT_GT(explain("maps.poisson_radius_m", {}).size(), 1U);  // generators differ
}

TEST_F(SweepFiles, BlocksKindsAndPlannersAreReportedWithTheirKeys) {
  EXPECT_EQ(explain("latency", {})[0].keys.size(), 4U);
  EXPECT_EQ(explain("maps.hall", {})[0].keys.front().front(), "area_m");
  EXPECT_EQ(explain("sensor", {}).size(), 2U);  // its keys, and its kinds
  EXPECT_GT(explain("", {})[0].keys.size(), 10U);
  EXPECT_EQ(explain("tunable", tunable())[0].keys.size(), 5U);
  const Explanation about = explain("tunable.horizon_m", tunable())[0];
  EXPECT_EQ(about.title, "tunable.horizon_m: How far it looks.");
  EXPECT_EQ(fact(about, "type"), "number, m");
  for (const char* name : {"example", "axis"}) {
    EXPECT_EQ(problems("sweep: a\n" + fact(about, name) + "\n"), "");
  }
  EXPECT_EQ(fact(explain("planners.tunable.mode", tunable())[0], "type"), "one of safe, fast");
}

TEST_F(SweepFiles, KeysMayBeNamedOtherwise) {
  EXPECT_EQ(explain("map.bush_ratio", {})[0].title, explain("maps.bush_ratio", {})[0].title);
  EXPECT_EQ(explain("map_seed", {})[0].title, explain("maps.seeds", {})[0].title);
  EXPECT_TRUE(explain("inertia_kgm2", {})[0].title.starts_with("vehicle.inertia_kgm2: "));
}

TEST_F(SweepFiles, UnknownKeysGetSuggestions) {
  const auto message = [](const std::string& key) {
    const std::string all = test::message_of([&] { explain(key, tunable()); });
    return all.substr(0, all.find("; avoidbench"));
  };
  EXPECT_EQ(message("poisson_radius"),
            "no key 'poisson_radius' (did you mean maps.poisson_radius_m?)");
  EXPECT_EQ(message("maps.bush_ration"),
            "no key 'maps.bush_ration' (did you mean maps.bush_ratio?)");
  EXPECT_EQ(message("wind.inertia_kgm2"),
            "no key 'wind.inertia_kgm2' (did you mean vehicle.inertia_kgm2?)");
  EXPECT_EQ(message("physics"), "no key 'physics' (did you mean rates.physics_hz?)");
  EXPECT_EQ(message("tunable.horizon"),
            "no key 'tunable.horizon' (did you mean tunable.horizon_m?)");
  EXPECT_NE(message("rate_hz").find("imu.rate_hz, odometry.rate_hz"), std::string::npos);
  EXPECT_EQ(message("xyzzy"), "no key 'xyzzy'");
  EXPECT_EQ(message("."), "no key '.'");
  EXPECT_EQ(message("maps."), "no key 'maps.' (did you mean maps?)");
}

}  // namespace
}  // namespace avoidbench
