#pragma once

#include <string>

namespace avoidbench {

/// The instruction set that Embree finds triangles with: "avx2" where the processor has it, else
/// "sse4.2".
std::string ray_tracing_isa();

/// Whether processor and system run what is compiled for AVX2.
bool has_avx2();

}  // namespace avoidbench
