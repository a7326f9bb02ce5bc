#include "base/json_path.hpp"

#include <gtest/gtest.h>

namespace avoidbench {
namespace {

using Words = std::vector<std::string>;

TEST(JsonPath, APathHasPartsAndAPlace) {
  const auto parts = [](std::string_view path) {
    const std::vector<std::string_view> found = parts_of_path(path);
    return Words(found.begin(), found.end());
  };
  EXPECT_EQ(parts("seed"), Words{"seed"});
  EXPECT_EQ(parts("a.0.b_m"), (Words{"a", "0", "b_m"}));
  EXPECT_EQ(parts(".a..b."), (Words{"", "a", "", "b", ""}));
  const auto json = nlohmann::json::parse(R"({"a":[{"b_m":3}],"~/":{"c":4},"d":5})");
  EXPECT_EQ(json.at(json_place("a.0.b_m")), 3);
  EXPECT_EQ(json.at(json_place("~/.c")), 4);
  EXPECT_EQ(json.at(json_place("d")), 5);
  EXPECT_FALSE(json.contains(json_place("a.1.b_m")));
}

TEST(JsonPath, TheLastPartIsTheNameWhereNoOtherHasIt) {
  EXPECT_EQ(last_part("map.poisson_radius_m"), "poisson_radius_m");
  EXPECT_EQ(last_part("seed"), "seed");
  const Words paths{"wind.gust.amplitude_mps", "wind.kick.amplitude_mps", "latency.ms"};
  EXPECT_EQ(short_name("latency.ms", paths), "ms");
  EXPECT_EQ(short_name("wind.gust.amplitude_mps", paths), "wind.gust.amplitude_mps");
}

}  // namespace
}  // namespace avoidbench
