#include "network.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <limits>
#include <stdexcept>

#include "make_weights.hpp"
#include "network_kernels.hpp"

#ifdef __FAST_MATH__
#error "What is compared here to the bit is not with -ffast-math."
#endif

namespace agile {
namespace {

using test::half_value;
using test::to_half;
using test::Widths;
using test::WrittenTensor;
using test::WrittenTensors;

constexpr std::size_t kPixels = std::size_t{kImageHeight} * kImageWidth;
constexpr std::size_t kOutputs = 93;
std::size_t index(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

constexpr int kSizes[] = {5, 3, 3, 3, 3}, kStrides[] = {2, 2, 2, 1, 2},
              kMargins[] = {2, 1, 1, 1, 1};

using Apply = void (*)(const kernels::Layer&);
using Pixels = std::vector<std::uint8_t>;
using Outputs = std::vector<float>;

/// A file that goes with the test.
class Networks : public ::testing::Test {
 protected:
  Networks()
      : file_(std::filesystem::temp_directory_path() /
              ("network_" + std::to_string(::getpid()) + ".safetensors")) {}
  ~Networks() override { std::filesystem::remove(file_); }

  Network make(const WrittenTensors& tensors, Apply apply = kernels::apply_portable) {
    test::write_bytes(file_, test::file_bytes(tensors));
    return Network(file_, apply);
  }

  std::filesystem::path file_;
};

WrittenTensor& tensor(WrittenTensors& tensors, const std::string& name) {
  return *std::find_if(tensors.begin(), tensors.end(),
                       [&](const WrittenTensor& one) { return one.name == name; });
}

void set(WrittenTensors& tensors, const std::string& name, std::size_t i, double value) {
  tensor(tensors, name).halves.at(i) = to_half(value);
}

Outputs run(Network& network, const Pixels& image, const std::vector<float>& inputs) {
  Outputs outputs;
  for (const Mode& mode : network.run(image, inputs)) {
    outputs.push_back(mode.cost);
    for (const auto& point : mode.points) outputs.insert(outputs.end(), point.begin(), point.end());
  }
  return outputs;
}

std::vector<std::uint32_t> bits(const Outputs& outputs) {
  std::vector<std::uint32_t> all;
  for (const float value : outputs) all.push_back(std::bit_cast<std::uint32_t>(value));
  return all;
}

Pixels random_image(std::uint64_t seed) {
  planning::Random random(seed);
  Pixels image(kPixels);
  for (std::uint8_t& grey : image) grey = static_cast<std::uint8_t>(random.bits());
  return image;
}

std::vector<float> random_inputs(std::uint64_t seed) {
  planning::Random random(seed);
  std::vector<float> inputs(kInputs);
  for (float& input : inputs) input = static_cast<float>(random.uniform(-2.0, 2.0));
  return inputs;
}

/// One channel each; every convolution hands on the pixels at its stride, and the rest what the
/// last one has: output i is pixel i of its 24, and 24 + i the input i where that is positive.
WrittenTensors make_window() {
  WrittenTensors tensors = test::make_empty_weights({.convolutions = {1, 1, 1, 1, 1},
                                                     .image = 24,
                                                     .state1 = 22,
                                                     .state2 = 22,
                                                     .head1 = 46,
                                                     .head2 = 46});
  for (int i = 0; i < 5; ++i) {
    set(tensors, "conv" + std::to_string(i + 1) + ".weight", index(kSizes[i] * kSizes[i] / 2), 1.0);
  }
  for (const std::string name : {"image_full", "state1", "state2", "head1", "head2", "out"}) {
    const auto shape = tensor(tensors, name + ".weight").shape;
    for (std::size_t i = 0; i < shape[1]; ++i)
      set(tensors, name + ".weight", i * shape[1] + i, 1.0);
  }
  return tensors;
}

TEST_F(Networks, EveryWeightOfAConvolutionIsAtItsPixelAndBeyondTheImageIsZero) {
  const Pixels image = random_image(1);
  const std::vector<float> inputs(kInputs, 0.0F);
  int scale = 1, beyond = 0;  // of a pixel that the convolution sees, image pixels
  for (std::size_t layer = 0; layer < 5; ++layer) {
    const int size = kSizes[layer];
    for (int tap = 0; tap < size * size; ++tap) {
      WrittenTensors tensors = make_window();
      const std::string name = "conv" + std::to_string(layer + 1) + ".weight";
      set(tensors, name, index(size * size / 2), 0.0);
      set(tensors, name, index(tap), 1.0);
      Network network = make(tensors);
      const Outputs outputs = run(network, image, inputs);
      for (int i = 0; i < 24; ++i) {
        const int row = 16 * (i / 6) + scale * (tap / size - kMargins[layer]);
        const int column = 16 * (i % 6) + scale * (tap % size - kMargins[layer]);
        const bool is_inside = row >= 0 && row < 64 && column >= 0 && column < 96;
        const float expected =
            is_inside ? static_cast<float>(image[index(96 * row + column)]) / 255.0F : 0.0F;
        beyond += is_inside ? 0 : 1;
        ASSERT_EQ(outputs[index(i)], expected) << name << " " << tap << " " << i;
      }
    }
    scale *= kStrides[layer];
  }
  EXPECT_GT(beyond, 100);
}

TEST_F(Networks, BiasesCountInTheMarginOnlyOfTheirOwnLayer) {
  WrittenTensors tensors = make_window();
  set(tensors, "conv1.bias", 0, 0.5);
  // The sum of a row above and of the row itself: above the image there is nothing, not the bias.
  set(tensors, "conv2.weight", 1, 1.0);
  Network network = make(tensors);
  const Outputs outputs = run(network, Pixels(kPixels, 0), std::vector<float>(kInputs, 0.0F));
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(outputs[i], i < 6 ? 0.5F : 1.0F) << i;
}

TEST_F(Networks, HandsInputsOnBehindTheImageAndRectifiesAllButTheOutput) {
  WrittenTensors tensors = make_window();
  set(tensors, "out.bias", 24, -10.0);
  set(tensors, "out.bias", 92, -0.25);
  Network network = make(tensors);
  std::vector<float> inputs = random_inputs(2);
  inputs[0] = 1.5F;
  const Outputs outputs = run(network, Pixels(kPixels, 0), inputs);
  EXPECT_EQ(outputs[24], -8.5F);
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    EXPECT_EQ(outputs[24 + i], std::max(inputs[i], 0.0F)) << i;
  }
  EXPECT_EQ(outputs[92], -0.25F);
}

TEST_F(Networks, JoinsTheImageChannelByChannel) {
  WrittenTensors tensors = test::make_empty_weights({.convolutions = {1, 1, 1, 1, 3},
                                                     .image = 1,
                                                     .state1 = 1,
                                                     .state2 = 1,
                                                     .head1 = 1,
                                                     .head2 = 1});
  for (const std::string name : {"head1", "head2", "out"}) set(tensors, name + ".weight", 0, 1.0);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    set(tensors, "conv5.bias", channel, 1.0 + static_cast<double>(channel));
  }
  for (std::size_t i = 0; i < 72; ++i) {
    set(tensors, "image_full.weight", i, 1.0);
    Network network = make(tensors);
    set(tensors, "image_full.weight", i, 0.0);
    const Outputs outputs = run(network, Pixels(kPixels, 0), std::vector<float>(kInputs, 0.0F));
    const std::size_t channel = i / 24;
    ASSERT_EQ(outputs[0], 1.0F + static_cast<float>(channel)) << i;
  }
}

/// The same by its definition and in double precision.
std::vector<double> reference(WrittenTensors tensors, const Pixels& image,
                              const std::vector<float>& inputs) {
  const auto weight = [&](const std::string& name, std::size_t i) {
    return half_value(tensor(tensors, name).halves[i]);
  };
  std::vector<double> values(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) values[i] = image[i] / 255.0;
  int rows = kImageHeight, columns = kImageWidth;
  for (std::size_t layer = 0; layer < 5; ++layer) {
    const std::string name = "conv" + std::to_string(layer + 1);
    const auto shape = tensor(tensors, name + ".weight").shape;
    const int size = kSizes[layer], stride = kStrides[layer], margin = kMargins[layer];
    const int rows_out = (rows + 2 * margin - size) / stride + 1;
    const int columns_out = (columns + 2 * margin - size) / stride + 1;
    std::vector<double> next;
    for (std::size_t out = 0; out < shape[0]; ++out) {
      for (int i = 0; i < rows_out * columns_out; ++i) {
        double sum = weight(name + ".bias", out);
        for (std::size_t in = 0; in < shape[1]; ++in) {
          for (int tap = 0; tap < size * size; ++tap) {
            const int y = i / columns_out * stride + tap / size - margin;
            const int x = i % columns_out * stride + tap % size - margin;
            if (y < 0 || y >= rows || x < 0 || x >= columns) continue;
            const auto taps = index(size * size);
            const auto pixels = index(rows * columns);
            sum += values[in * pixels + index(y * columns + x)] *
                   weight(name + ".weight", (out * shape[1] + in) * taps + index(tap));
          }
        }
        next.push_back(std::max(sum, 0.0));
      }
    }
    values = next;
    rows = rows_out;
    columns = columns_out;
  }
  const auto linear = [&](const std::string& name, const std::vector<double>& from) {
    std::vector<double> sums;
    const auto shape = tensor(tensors, name + ".weight").shape;
    EXPECT_EQ(from.size(), shape[1]);
    for (std::size_t out = 0; out < shape[0]; ++out) {
      double sum = weight(name + ".bias", out);
      for (std::size_t in = 0; in < shape[1]; ++in) {
        sum += from[in] * weight(name + ".weight", out * shape[1] + in);
      }
      sums.push_back(name == "out" ? sum : std::max(sum, 0.0));
    }
    return sums;
  };
  std::vector<double> joined = linear("image_full", values);
  const auto state = linear("state2", linear("state1", {inputs.begin(), inputs.end()}));
  joined.insert(joined.end(), state.begin(), state.end());
  return linear("out", linear("head2", linear("head1", joined)));
}

const Widths kOdd{.convolutions = {3, 17, 5, 33, 7},
                  .image = 9,
                  .state1 = 31,
                  .state2 = 1,
                  .head1 = 18,
                  .head2 = 47};

TEST_F(Networks, IsNearThePlainSumsInDoublePrecision) {
  for (const Widths& widths : {Widths{}, kOdd}) {
    const WrittenTensors tensors = test::make_weights(3, widths);
    const Pixels image = random_image(4);
    const std::vector<float> inputs = random_inputs(5);
    Network network = make(tensors);
    const Outputs outputs = run(network, image, inputs);
    const std::vector<double> expected = reference(tensors, image, inputs);
    double largest = 0.0;
    for (std::size_t i = 0; i < kOutputs; ++i) {
      EXPECT_NEAR(outputs[i], expected[i], 1e-5) << i;
      largest = std::max(largest, std::abs(expected[i]));
    }
    EXPECT_GT(largest, 0.1);
  }
}

/// Of trained sizes, of sums that overflow to infinity and NaN, and of such small ones that
/// they have no whole precision.
TEST_F(Networks, VersionsAgreeToTheBit) {
  if (!kernels::has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  for (const Widths& widths : {Widths{}, kOdd}) {
    for (const double scale : {1.0, 500.0, 2e-4}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        WrittenTensors tensors = test::make_weights(seed, widths);
        for (WrittenTensor& one : tensors) {
          for (std::uint16_t& half : one.halves) half = to_half(scale * half_value(half));
        }
        Network portable = make(tensors, kernels::apply_portable);
        Network avx2(file_, kernels::apply_avx2);
        Network chosen(file_);
        const Pixels image = random_image(seed + 10);
        const std::vector<float> inputs = random_inputs(seed + 20);
        const auto expected = bits(run(portable, image, inputs));
        ASSERT_EQ(bits(run(avx2, image, inputs)), expected) << scale << " " << seed;
        ASSERT_EQ(bits(run(chosen, image, inputs)), expected) << scale << " " << seed;
      }
    }
  }
}

TEST_F(Networks, InfinityAndNaNAgreeToTheBit) {
  if (!kernels::has_avx2()) GTEST_SKIP() << "this processor has no AVX2";
  WrittenTensors tensors = test::make_weights(1, kOdd);
  for (WrittenTensor& one : tensors) {
    for (std::uint16_t& half : one.halves) half = to_half(half_value(half) < 0 ? -65000 : 65000);
  }
  Network portable = make(tensors, kernels::apply_portable);
  Network avx2(file_, kernels::apply_avx2);
  const Outputs outputs = run(portable, random_image(2), random_inputs(3));
  EXPECT_EQ(bits(run(avx2, random_image(2), random_inputs(3))), bits(outputs));
  EXPECT_FALSE(std::isfinite(outputs[0]));
}

/// The last bit of a product is rounded before it is added: a fused multiply-add would not.
TEST_F(Networks, RoundsProductsBeforeTheyAreAdded) {
  WrittenTensors tensors = make_window();
  constexpr double kFactor = 1.0 + 1.0 / 1024, kBias = -0.75;
  set(tensors, "state1.weight", 0, kFactor);
  set(tensors, "state1.bias", 0, kBias);
  std::vector<float> inputs(kInputs, 0.0F);
  int unlike = 0;
  for (int i = 1; i < 100; ++i) {
    inputs[0] = 0.8F + static_cast<float>(i) / 999.0F;
    const auto product = static_cast<float>(kFactor * static_cast<double>(inputs[0]));
    const float expected = product + static_cast<float>(kBias);
    const auto fused = static_cast<float>(kFactor * static_cast<double>(inputs[0]) + kBias);
    unlike += expected == fused ? 0 : 1;
    for (const Apply apply : {kernels::apply_portable, kernels::apply_avx2}) {
      if (apply == kernels::apply_avx2 && !kernels::has_avx2()) continue;
      Network network = make(tensors, apply);
      ASSERT_EQ(run(network, Pixels(kPixels, 0), inputs)[24], expected) << i;
    }
  }
  EXPECT_GT(unlike, 10);
}

TEST_F(Networks, KeepsNumbersThatAreSmallerThanNormal) {
  WrittenTensors tensors = make_window();
  const double smallest = std::ldexp(1.0, -24);
  for (const std::string name : {"state1", "state2", "head1", "head2", "out"}) {
    const std::size_t row = name[0] == 's' ? 0 : 24;
    const std::size_t width = tensor(tensors, name + ".weight").shape[1];
    set(tensors, name + ".weight", row * width + row, smallest);
  }
  std::vector<float> inputs(kInputs, 0.0F);
  inputs[0] = std::ldexp(1.75F, -28);
  for (const Apply apply : {kernels::apply_portable, kernels::apply_avx2}) {
    if (apply == kernels::apply_avx2 && !kernels::has_avx2()) continue;
    Network network = make(tensors, apply);
    // Times 2^-120 that is 3.5 of the smallest steps, which rounds to even.
    EXPECT_EQ(run(network, Pixels(kPixels, 0), inputs)[24], std::ldexp(1.0F, -147));
  }
}

/// What every compiler and machine has to give.
TEST_F(Networks, GivesTheKnownBits) {
  const auto digest = [](const Outputs& outputs) {
    std::uint64_t hash = 0xCBF29CE484222325ULL;  // FNV-1a
    for (const std::uint32_t value : bits(outputs)) hash = (hash ^ value) * 0x100000001B3ULL;
    return hash;
  };
  Network usual = make(test::make_weights(1));
  EXPECT_EQ(digest(run(usual, random_image(2), random_inputs(3))), 0x9db713a4dc4d7316U);
  Network odd = make(test::make_weights(1, kOdd));
  EXPECT_EQ(digest(run(odd, random_image(2), random_inputs(3))), 0xdff029b7e5b85792U);
}

TEST_F(Networks, KnowNothingOfEarlierImages) {
  Network network = make(test::make_weights(6));
  const Pixels image = random_image(7);
  const std::vector<float> inputs = random_inputs(8);
  const auto first = bits(run(network, image, inputs));
  EXPECT_EQ(bits(run(network, image, inputs)), first);
  EXPECT_NE(bits(run(network, random_image(9), random_inputs(10))), first);
  Network moved = std::move(network);
  EXPECT_EQ(bits(run(moved, image, inputs)), first);
}

TEST_F(Networks, RefuseImagesAndInputsThatAreNone) {
  Network network = make(make_window());
  const Pixels image(kPixels, 0);
  std::vector<float> inputs(kInputs, 0.0F);
  EXPECT_THROW(network.run(std::span(image).first(kPixels - 1), inputs), std::invalid_argument);
  EXPECT_THROW(network.run(image, std::span(inputs).first(21)), std::invalid_argument);
  for (const float wrong : {std::numeric_limits<float>::infinity(), std::nanf("")}) {
    inputs[7] = wrong;
    EXPECT_THROW(network.run(image, inputs), std::invalid_argument);
  }
}

}  // namespace
}  // namespace agile
