#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace agile {

inline constexpr int kImageHeight = 64, kImageWidth = 96, kInputs = 22, kModes = 3, kPoints = 10;

namespace kernels {
struct Layer;
}

/// One way to fly on, as the network gives it.
struct Mode {
  float cost;  ///< predicted cost of the trajectory
  /// x, y, z at times T k / 10, k = 1 … 10, from the plan's start along the image frame's axes;
  /// unit: v_des T.
  std::array<std::array<float, 3>, kPoints> points;
};

/// The trained network: five convolutions of the image, and linear layers that join what they give
/// with the other inputs. The same bits on every x86-64 machine: every output is summed in one
/// order, products and sums rounded apart. Of trained weights nothing overflows; weights that do
/// overflow give numbers that are not finite.
class Network {
 public:
  /// Throws std::runtime_error with the file's name where it is missing, no regular file, larger
  /// than 64 MiB, or does not hold the tensors that fit together as this network.
  explicit Network(const std::filesystem::path& file);
  /// For tests and benchmarks, which choose the loops: network_kernels.hpp.
  Network(const std::filesystem::path& file, void (*apply)(const kernels::Layer&));
  ~Network();
  Network(Network&&) noexcept;
  Network& operator=(Network&&) noexcept;

  /// What it gives for an image of kImageHeight × kImageWidth, row-major, round(255 min(1, 1 m /
  /// depth)) with 0 for no return, and kInputs other inputs. Throws std::invalid_argument where
  /// there are more or fewer, or one of the inputs is not finite. Allocates nothing.
  std::array<Mode, kModes> run(std::span<const std::uint8_t> image, std::span<const float> inputs);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace agile
