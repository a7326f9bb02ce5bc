#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// Base64 (RFC 4648), with padding.
std::string base64(std::span<const std::byte> bytes);

/// Numbers on their way into a page: whole numbers of few digits take few bytes, and what changes
/// evenly deflates well. apps/page/src/packed.ts reads them back.
class Packed {
 public:
  /// Seven bits a byte, lowest first; the eighth says that more follow (LEB128).
  void add_unsigned(std::uint64_t value);
  void add_signed(std::int64_t value);  ///< zigzag: 0, -1, 1, -2, … as 0, 1, 2, 3, …
  /// The first number, then by how much each differs from the one before.
  void add_deltas(std::span<const std::int64_t> values);
  /// The deltas of the deltas: for what moves evenly.
  void add_second_deltas(std::span<const std::int64_t> values);
  /// As 32-bit floats, little-endian, the four bytes of all of them apart.
  void add_floats(std::span<const double> values);
  void add_bytes(std::span<const std::uint8_t> bytes);

  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// The bytes deflated (zlib) in base64: the same from the same numbers.
  std::string text() const;

 private:
  std::vector<std::byte> bytes_;
};

/// The text of such numbers alone.
template <class Values>
std::string packed_deltas(const Values& values) {
  Packed packed;
  packed.add_deltas(std::vector<std::int64_t>(values.begin(), values.end()));
  return packed.text();
}
std::string packed_floats(std::span<const double> values);

/// The nearest whole number of steps; `none` where the value is not finite.
std::int64_t steps(double value, double step, std::int64_t none = 0);

}  // namespace avoidbench
