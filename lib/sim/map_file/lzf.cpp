#include "map_file/lzf.hpp"

namespace avoidbench {

std::optional<std::string> lzf_decompressed(std::string_view compressed, std::size_t size) {
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  const auto left = [&] { return compressed.size() - at; };
  const auto next = [&] {
    return static_cast<std::size_t>(static_cast<unsigned char>(compressed[at++]));
  };
  while (left() > 0) {
    const std::size_t control = next();
    if (control < 32) {  // control + 1 bytes as they are
      const std::size_t count = control + 1;
      if (left() < count || size - out.size() < count) return std::nullopt;
      out.append(compressed.substr(at, count));
      at += count;
      continue;
    }
    std::size_t count = control >> 5U;  // bytes seen before, from `distance` back
    if (left() < (count == 7 ? 2U : 1U)) return std::nullopt;
    if (count == 7) count += next();
    count += 2;
    // 13 bits: 5 of the control byte, 8 of the next.
    const std::size_t distance = ((control & 31U) << 8U) + next() + 1;
    if (distance > out.size() || size - out.size() < count) return std::nullopt;
    // Byte by byte: what is copied may overlap what it makes, and repeats then.
    for (std::size_t i = 0; i < count; ++i) out.push_back(out[out.size() - distance]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace avoidbench
