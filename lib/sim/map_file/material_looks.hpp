#pragma once

#include <array>
#include <cstddef>

#include "world/world.hpp"

/// How materials look in files for other programs; in order of Material.
namespace avoidbench {

inline constexpr std::size_t kMaterials = 7;
inline constexpr std::array<const char*, kMaterials> kMaterialNames{
    "soil", "bark", "leaf", "brick", "concrete", "painted_metal", "lamp"};
/// Linear RGB, as glTF wants it.
inline constexpr std::array<std::array<float, 3>, kMaterials> kMaterialColours{
    {{0.36F, 0.27F, 0.18F},
     {0.32F, 0.24F, 0.17F},
     {0.22F, 0.40F, 0.14F},
     {0.55F, 0.28F, 0.20F},
     {0.60F, 0.60F, 0.58F},
     {0.75F, 0.72F, 0.20F},
     {1.00F, 0.98F, 0.92F}}};

}  // namespace avoidbench
