#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace avoidbench {

/// What stands before an array's bytes in a file of NumPy's format, version 1.0: a multiple of 64
/// bytes. `type` is NumPy's: "|u1", "<f4". The array is in C order, its last axis the fastest.
std::string npy_header(const std::string& type, std::span<const std::size_t> shape);

}  // namespace avoidbench
