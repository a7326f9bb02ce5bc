#pragma once

#include "render/embree.hpp"

/// Private to this room: Embree is seen nowhere else.
namespace avoidbench::embree {

/// The process's Embree device: one thread (this caps TBB for the whole process), the instruction
/// set pinned to ray_tracing_isa().
RTCDevice device();

/// Throws InputError where Embree ran out of memory since the last call on this thread; aborts on
/// any other error.
void check_errors(const char* doing);

}  // namespace avoidbench::embree
