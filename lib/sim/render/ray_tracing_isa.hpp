#pragma once

#include <string>

namespace avoidbench {

/// The instruction set that rays are traced with: "avx2" where the processor has it, else "sse4.2".
/// Pinned, since other sets change which triangle an edge pixel hits.
std::string ray_tracing_isa();

/// Whether processor and system run what is compiled for AVX2.
bool has_avx2();

}  // namespace avoidbench
