#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace avoidbench {

/// Most bytes that one byte of LZF can stand for.
inline constexpr std::size_t kMostLzfRatio = 88;

/// The `size` bytes that an LZF stream (LibLZF, as in PCD's binary_compressed) stands for; nothing
/// where it is malformed or gives another count. Allocates `size` bytes: check it before.
std::optional<std::string> lzf_decompressed(std::string_view compressed, std::size_t size);

}  // namespace avoidbench
