#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "planning/random.hpp"

namespace agile::test {

/// Channels that the layers give.
struct Widths {
  std::vector<std::size_t> convolutions{16, 32, 64, 64, 96};
  std::size_t image = 128, state1 = 64, state2 = 64, head1 = 256, head2 = 256;
};

struct WrittenTensor {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<std::uint16_t> halves;  ///< row-major
};
using WrittenTensors = std::vector<WrittenTensor>;

/// The nearest half of a number below 65504 in size.
inline std::uint16_t to_half(double value) {
  const std::uint16_t sign = std::signbit(value) ? 0x8000U : 0U;
  const double size = std::abs(value);
  if (size == 0.0) return sign;
  int exponent = 0;
  std::frexp(size, &exponent);
  exponent = std::max(exponent - 1, -14);  // below 2^-14 halves are 2^-24 apart
  const auto steps = static_cast<std::uint32_t>(std::lrint(std::ldexp(size, 10 - exponent)));
  // Rounding up to the next power of two carries over into the exponent.
  return static_cast<std::uint16_t>(sign + (static_cast<std::uint32_t>(exponent + 14) << 10U) +
                                    steps);
}

/// What a half says, by its definition.
inline double half_value(std::uint16_t half) {
  const int exponent = half >> 10U & 31U, fraction = half & 0x3FFU;
  const double size =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (half & 0x8000U) != 0U ? -size : size;
}

/// All of a network's tensors, filled with 0.
inline WrittenTensors make_empty_weights(const Widths& widths = {}) {
  WrittenTensors tensors;
  const auto add = [&](const std::string& layer, const std::vector<std::size_t>& shape) {
    const auto count =
        std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
    tensors.push_back({layer + ".weight", shape, std::vector<std::uint16_t>(count)});
    tensors.push_back({layer + ".bias", {shape[0]}, std::vector<std::uint16_t>(shape[0])});
  };
  std::size_t in = 1;
  for (std::size_t i = 0; i < widths.convolutions.size(); ++i) {
    const std::size_t size = i == 0 ? 5 : 3;
    add("conv" + std::to_string(i + 1), {widths.convolutions[i], in, size, size});
    in = widths.convolutions[i];
  }
  add("image_full", {widths.image, in * 24});
  add("state1", {widths.state1, 22});
  add("state2", {widths.state2, widths.state1});
  add("head1", {widths.head1, widths.image + widths.state2});
  add("head2", {widths.head2, widths.head1});
  add("out", {93, widths.head2});
  return tensors;
}

/// Weights as they are before a training: what goes in comes out about as large.
inline WrittenTensors make_weights(std::uint64_t seed, const Widths& widths = {}) {
  WrittenTensors tensors = make_empty_weights(widths);
  planning::Random random(seed);
  double most = 0.1;
  for (WrittenTensor& tensor : tensors) {
    if (tensor.shape.size() > 1) {
      most = std::sqrt(
          6.0 / (static_cast<double>(tensor.halves.size()) / static_cast<double>(tensor.shape[0])));
    }
    for (std::uint16_t& half : tensor.halves) half = to_half(random.uniform(-most, most));
  }
  return tensors;
}

/// The file around a header and data.
inline std::string join_file(const std::string& header, const std::string& data) {
  std::string bytes;
  for (unsigned i = 0; i < 8; ++i) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(header.size()) >> (8U * i) & 0xFFU);
  }
  return bytes + header + data;
}

inline std::string list_text(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t number : numbers)
    text += (text.empty() ? "" : ",") + std::to_string(number);
  return "[" + text + "]";
}

inline std::string header_of(const WrittenTensors& tensors) {
  std::string header = R"({"__metadata__":{"format":"agile/1"})";
  std::size_t at = 0;
  for (const WrittenTensor& tensor : tensors) {
    const std::size_t end = at + 2 * tensor.halves.size();
    header += ",\"" + tensor.name + R"(":{"dtype":"F16","shape":)" + list_text(tensor.shape) +
              R"(,"data_offsets":)" + list_text({at, end}) + "}";
    at = end;
  }
  return header + "}";
}

inline std::string data_of(const WrittenTensors& tensors) {
  std::string data;
  for (const WrittenTensor& tensor : tensors) {
    for (const std::uint16_t half : tensor.halves) {
      data += static_cast<char>(half & 0xFFU);
      data += static_cast<char>(half >> 8U);
    }
  }
  return data;
}

/// The tensors as a safetensors file.
inline std::string file_bytes(const WrittenTensors& tensors) {
  return join_file(header_of(tensors), data_of(tensors));
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  // Some file systems wait for the disk where a file is written anew in place.
  std::filesystem::remove(file);
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A file of random weights.
inline void write_weights(const std::filesystem::path& file, std::uint64_t seed,
                          const Widths& widths = {}) {
  write_bytes(file, file_bytes(make_weights(seed, widths)));
}

}  // namespace agile::test
