// Sweeps of `avoidbench limit`: the values of a range, and what is wrong with one.
#include <string>
#include <vector>

#include "config/sweep_fixture.hpp"

namespace avoidbench {
namespace {

class LimitSweeps : public SweepFiles {
 protected:
  SweepSpec read_over(const std::string& over) const {
    LimitRequest request;
    request.over = over;
    return read_limit_sweep(write("s.yaml", "sweep: a\nplanners: [tunable]\n"), {}, request);
  }
  std::string problems_over(const std::string& over) const {
    return test::message_of([&] { read_over(over); });
  }
};

/// 41 of them, ends included, equally far from each other.
TEST_F(LimitSweeps, HaveValuesAllOverTheRange) {
  const SweepSpec sweep = read_over("maps.poisson_radius_m=2..12.25");
  EXPECT_EQ(sweep.name, "a_limit_poisson_radius_m");
  EXPECT_EQ(sweep.limit.field, "map.poisson_radius_m");
  EXPECT_EQ(sweep.limit.unit, "m");
  EXPECT_DOUBLE_EQ(sweep.limit.width, 1.025);  // a tenth of the range
  const std::vector<double>& values = sweep.limit.values;
  ASSERT_EQ(values.size(), 41U);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], 2.0 + 10.25 * static_cast<double>(i) / 40.0, 1e-12);
  }
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(sweep.axes[0].values.size(), 41U);
}

TEST_F(LimitSweeps, HaveEachWholeNumberOfARangeOnce) {
  EXPECT_EQ(read_over("mission.max_collisions=0.5..3.5").limit.values,
            (std::vector<double>{1.0, 2.0, 3.0}));
}

TEST_F(LimitSweeps, VaryOneNumberOfAList) {
  const SweepSpec sweep = read_over("wind.mean_world_mps[1]=-1..9");
  EXPECT_EQ(sweep.limit.field, "wind.mean_world_mps.1");
  EXPECT_EQ(sweep.limit.values.front(), -1.0);
  EXPECT_EQ(sweep.limit.values.back(), 9.0);
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(sweep.axes[0].values.back(), nlohmann::json({0.0, 9.0, 0.0}));
}

TEST_F(LimitSweeps, OfNoRangeAreRefused) {
  for (const std::string over :
       {"maps.poisson_radius_m", "maps.poisson_radius_m=2", "=2..6", "maps.poisson_radius_m=x..6",
        "maps.poisson_radius_m=2..x", "maps.poisson_radius_m=2..", "maps.poisson_radius_m=..6",
        "maps.poisson_radius_m=2..inf", "maps.poisson_radius_m=nan..6"}) {
    EXPECT_EQ(problems_over(over),
              over + ": expected FIELD=LOW..HIGH, such as max_speed_mps=1..10");
  }
  EXPECT_EQ(problems_over("maps.poisson_radius_m=6..2"),
            "maps.poisson_radius_m=6..2: the range ends before it begins: write the lower value "
            "first");
  EXPECT_EQ(problems_over("mission.max_collisions=1.25..2.5"),
            "mission.max_collisions=1.25..2.5: there are not two whole numbers in this range");
}

}  // namespace
}  // namespace avoidbench
