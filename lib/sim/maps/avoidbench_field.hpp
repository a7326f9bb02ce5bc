#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace avoidbench {

/// What the original AvoidBench (Yu, de Croon, De Wagter, arXiv 2301.07430) draws a suite of maps
/// from: parameters of its task files.
struct FieldSuite {
  std::int64_t seed = 24;
  double radius_origin_m = 2.1;  ///< least Poisson radius
  double radius_span_m = 3.2;    ///< the greatest is just under this above it
  std::array<double, 2> area_m{140.0, 160.0};
};

/// The obstacles of one map of a suite.
struct AvoidbenchField {
  float radius_m = 0.0F;                     ///< Poisson radius
  std::int32_t map_seed = 0;                 ///< of positions and sizes; many maps share one
  std::vector<Eigen::Vector2f> positions_m;  ///< in [0, area), the sampler's own frame
};

/// Map `number` of the suite, from 1 on, as the original makes it: Poisson radius and map seed by
/// glibc's rand() after srand(seed · number), positions by its Bridson sampler in 32-bit floats
/// with .NET's random numbers. The sampler grows the field from the edge x = 0 always from its
/// oldest place, and leaves gaps.
AvoidbenchField make_avoidbench_field(const FieldSuite& suite, std::uint64_t number);

/// Sizes of the indoor map's `count` cylinders, in the order of its positions: for each a number in
/// [0, 1) that goes from least to greatest on all axes alike.
std::vector<double> avoidbench_size_ratios(std::int32_t map_seed, std::size_t count);

}  // namespace avoidbench
