#include "base/npy_header.hpp"

#include <string_view>

namespace avoidbench {

std::string npy_header(const std::string& type, std::span<const std::size_t> shape) {
  std::string about = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  // As Python writes a tuple: "(3, 50)", "(3,)".
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    about += (axis == 0 ? "" : ", ") + std::to_string(shape[axis]);
  }
  about += shape.size() == 1 ? ",), }" : "), }";
  constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);
  constexpr std::size_t kBefore = kMagic.size() + 2, kMultiple = 64;
  const std::size_t size = (kBefore + about.size() + 1 + kMultiple - 1) / kMultiple * kMultiple;
  about.resize(size - kBefore - 1, ' ');
  about += '\n';
  // Version 1.0 has two bytes for the length, little-endian.
  std::string header(kMagic);
  header += static_cast<char>(about.size() & 0xff);
  header += static_cast<char>(about.size() >> 8);
  return header + about;
}

}  // namespace avoidbench
