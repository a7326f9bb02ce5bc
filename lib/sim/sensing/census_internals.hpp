#pragma once

#include <cstdint>
#include <span>

#include "sensing/census_kernels.hpp"
#include "sensing/census_matcher.hpp"

// For tests and benchmarks, which choose the version.
namespace avoidbench::census {

/// match_census() by these loops; kAvx2Kernels only where has_avx2().
void match(const Kernels& kernels, const CensusSettings& settings,
           std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int width_px,
           int height_px, CensusWorkspace& workspace, std::span<std::int16_t> disparity);

}  // namespace avoidbench::census
