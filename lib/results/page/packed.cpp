#include "page/packed.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.hpp"

namespace avoidbench {

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  for (std::size_t i = 0, at = 0; i < bytes.size(); i += 3, at += 4) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8U) | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k <= count; ++k) {
      text[at + k] = kLetters[(group >> (18U - 6U * k)) & 63U];
    }
  }
  return text;
}

void Packed::add_unsigned(std::uint64_t value) {
  while (value >= 128) {
    bytes_.push_back(static_cast<std::byte>((value & 127U) | 128U));
    value >>= 7U;
  }
  bytes_.push_back(static_cast<std::byte>(value));
}

void Packed::add_signed(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  add_unsigned(value < 0 ? ~(bits << 1U) : bits << 1U);
}

void Packed::add_deltas(std::span<const std::int64_t> values) {
  std::int64_t last = 0;
  for (const std::int64_t value : values) {
    add_signed(value - last);
    last = value;
  }
}

void Packed::add_second_deltas(std::span<const std::int64_t> values) {
  std::int64_t last = 0, last_delta = 0;
  for (const std::int64_t value : values) {
    const std::int64_t delta = value - last;
    add_signed(delta - last_delta);
    last = value;
    last_delta = delta;
  }
}

void Packed::add_floats(std::span<const double> values) {
  for (unsigned byte = 0; byte < 4; ++byte) {
    for (const double value : values) {
      // One NaN for all of them, so that equal databases give equal bytes.
      const std::uint32_t bits =
          std::isnan(value) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(static_cast<float>(value));
      bytes_.push_back(static_cast<std::byte>((bits >> (8U * byte)) & 255U));
    }
  }
}

void Packed::add_bytes(std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) bytes_.push_back(static_cast<std::byte>(byte));
}

std::string Packed::text() const {
  // zlib's usual level: the highest takes twice the time to save one byte of 300.
  constexpr int kLevel = 6;
  uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
  std::vector<std::byte> deflated(size);
  const int code = compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes_.data()),
                             static_cast<uLong>(bytes_.size()), kLevel);
  AB_CHECK(code == Z_OK, code);
  return base64(std::span(deflated).first(size));
}

std::string packed_floats(std::span<const double> values) {
  Packed packed;
  packed.add_floats(values);
  return packed.text();
}

std::int64_t steps(double value, double step, std::int64_t none) {
  // Beyond it the number of steps is no whole number of 64 bits; nothing that is shown is.
  constexpr double kMost = 1e15;
  const double count = std::round(value / step);
  if (!std::isfinite(count) || std::abs(count) > kMost) return none;
  return static_cast<std::int64_t>(count);
}

}  // namespace avoidbench
