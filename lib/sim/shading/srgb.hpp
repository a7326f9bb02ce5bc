#pragma once

#include <array>
#include <cstdint>

namespace avoidbench {

/// 8-bit sRGB (IEC 61966-2-1) of linear light i / 4096.
using SrgbTable = std::array<std::uint8_t, 4097>;

const SrgbTable& srgb_table();

}  // namespace avoidbench
