#include "shading/srgb.hpp"

#include <cmath>

#include "base/math.hpp"

namespace avoidbench {
namespace {

SrgbTable make_srgb_table() {
  SrgbTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    // IEC 61966-2-1.
    const double linear = static_cast<double>(i) / static_cast<double>(table.size() - 1);
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * math::pow(linear, 1.0 / 2.4) - 0.055;
    table[i] = static_cast<std::uint8_t>(std::round(255.0 * encoded));
  }
  return table;
}

}  // namespace

const SrgbTable& srgb_table() {
  static const SrgbTable kTable = make_srgb_table();
  return kTable;
}

}  // namespace avoidbench
