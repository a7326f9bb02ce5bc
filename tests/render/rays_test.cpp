#include "render/rays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/test_worlds.hpp"

namespace avoidbench {
namespace {

using Eigen::Vector3d;

class RaysOf : public testing::TestWithParam<std::size_t> {
 protected:
  World world_ = test::scattered_world(11);
  Scene scene_{world_, GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Both, RaysOf, testing::Values(0, 1000000), [](const auto& suite) {
  return suite.param == 0 ? "Instanced" : "Flattened";
});

/// Of any number, whole packets or not.
TEST_P(RaysOf, ManyAreEachOne) {
  RandomStream random(5);
  std::size_t hit_count = 0;
  for (const std::size_t count : {0U, 1U, 7U, 32U, 33U, 500U}) {
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
      ray.origin_world = test::random_point(random, 8.0);
      ray.direction_world = (test::random_point(random, 4.0) - ray.origin_world).normalized();
    }
    std::vector<RayHit> hits(count);
    first_hits(scene_, rays, 9.0, hits);
    for (std::size_t i = 0; i < count; ++i) {
      const RayHit one = scene_.first_hit(rays[i].origin_world, rays[i].direction_world, 9.0);
      ASSERT_EQ(std::isinf(hits[i].distance_m), std::isinf(one.distance_m)) << i;
      if (std::isinf(one.distance_m)) continue;
      ++hit_count;
      EXPECT_EQ(hits[i].instance, one.instance);
      EXPECT_EQ(hits[i].triangle, one.triangle);
      EXPECT_NEAR(hits[i].distance_m, one.distance_m, 1e-5);
      EXPECT_LT((hits[i].normal_world - one.normal_world).norm(), 1e-5);
    }
  }
  EXPECT_GT(hit_count, 100U);
}

}  // namespace
}  // namespace avoidbench
