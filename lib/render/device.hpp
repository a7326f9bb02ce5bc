#pragma once

#include <string>

#include "render/embree.hpp"

namespace avoidbench::embree {

/// The process's Embree device: one thread (this caps TBB for the whole process), the instruction
/// set pinned to AVX2 where the processor has it and to SSE4.2 elsewhere, since other sets change
/// which triangle an edge pixel hits.
RTCDevice device();

/// The instruction set that device() is pinned to: "avx2" or "sse4.2".
std::string ray_tracing_isa();

/// Throws InputError where Embree ran out of memory since the last call on this thread; aborts on
/// any other error.
void check_errors(const char* doing);

}  // namespace avoidbench::embree
