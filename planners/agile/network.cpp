#include "network.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "network_kernels.hpp"
#include "weights_file.hpp"

namespace agile {
namespace {

using kernels::kPanel;
using kernels::Layer;

constexpr int kOutputs = kModes * (1 + 3 * kPoints);

/// Memory from where a vector's loads never span two cache lines.
template <class T>
struct Aligned {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  Aligned() = default;
  template <class U>
  explicit Aligned(const Aligned<U>& /*other*/) {}
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
  }
  void deallocate(T* at, std::size_t /*count*/) { ::operator delete(at, kAlignment); }
  bool operator==(const Aligned& /*other*/) const { return true; }
};
using Floats = std::vector<float, Aligned<float>>;

/// Sizes of tensors are checked to be small.
constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }
constexpr int padded(int channels) { return (channels + kPanel - 1) / kPanel * kPanel; }

/// Row-major pixels of some channels each, with a margin of zeros around them.
struct Picture {
  Picture(int rows_count, int columns_count, int channels_count, int margin_pixels)
      : rows(rows_count),
        columns(columns_count),
        channels(channels_count),
        margin(margin_pixels),
        row_step((columns + 2 * margin) * channels),
        values(index(rows + 2 * margin) * index(row_step), 0.0F) {}

  float* first() { return values.data() + (row_step + channels) * margin; }

  int rows, columns, channels, margin;
  int row_step;  ///< floats from one row to the next
  Floats values;
};

struct Convolution {
  const char* name;
  int size, stride, margin;
};
constexpr std::array<Convolution, 5> kConvolutions{{{"conv1", 5, 2, 2},
                                                    {"conv2", 3, 2, 1},
                                                    {"conv3", 3, 2, 1},
                                                    {"conv4", 3, 1, 1},
                                                    {"conv5", 3, 2, 1}}};

constexpr int shrunk(int pixels, const Convolution& convolution) {
  return (pixels + 2 * convolution.margin - convolution.size) / convolution.stride + 1;
}

constexpr std::array<float, 256> make_grey_levels() {
  std::array<float, 256> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<float>(i) / 255.0F;
  return levels;
}
constexpr std::array<float, 256> kGreyLevels = make_grey_levels();

/// A layer and what it points to.
struct Part {
  Layer layer{};
  Floats weights, bias;
};

/// A layer of `channels`, its bias, and zeros for `weights_in` weights of each channel.
Part make_part(WeightsFile& file, const std::string& name, std::size_t channels,
               std::size_t weights_in) {
  Part part;
  const Tensor bias = file.take(name + ".bias", {channels});
  const int stored = padded(static_cast<int>(channels));
  part.bias.assign(index(stored), 0.0F);
  std::copy(bias.values.begin(), bias.values.end(), part.bias.begin());
  part.weights.assign(index(stored) * weights_in, 0.0F);
  part.layer.weights = part.weights.data();
  part.layer.bias = part.bias.data();
  part.layer.panels = stored / kPanel;
  part.layer.is_rectified = true;
  return part;
}

/// Where the weight of a channel and an input of it is, of `count` inputs.
std::size_t weight_index(std::size_t channel, std::size_t input, std::size_t count) {
  constexpr std::size_t kTogether = index(kPanel);
  return (channel / kTogether * count + input) * kTogether + channel % kTogether;
}

}  // namespace

bool kernels::has_avx2() { return __builtin_cpu_supports("avx2") != 0; }

struct Network::Parts {
  void (*apply)(const Layer&);
  Picture image{kImageHeight, kImageWidth, 1, kConvolutions[0].margin};
  std::vector<Picture> pictures;  ///< what the convolutions give
  Floats inputs, state1, joined, head1, head2, outputs;
  std::vector<Part> parts;  ///< in the order they are applied

  Parts(WeightsFile& file, void (*apply_layer)(const Layer&));

  int add_convolutions(WeightsFile& file);
  int add_convolution(WeightsFile& file, std::size_t number, int channels_in, Picture& from);
  template <class Place>
  int add_linear(WeightsFile& file, const std::string& name, int count_out, int count_in,
                 const float* from, int run, const Place& place);
  void set_output(float* to) { parts.back().layer.output = to; }
};

/// Returns how many channels it gives.
int Network::Parts::add_convolution(WeightsFile& file, std::size_t number, int channels_in,
                                    Picture& from) {
  const Convolution& convolution = kConvolutions[number];
  const std::string name = convolution.name;
  const std::size_t size = index(convolution.size), in = index(channels_in);
  const Tensor weight = file.take(name + ".weight", {0, in, size, size});
  const std::size_t out = weight.shape[0], stored = index(from.channels);
  const std::size_t run = size * stored;
  Part part = make_part(file, name, out, size * run);
  for (std::size_t i = 0; i < weight.values.size(); ++i) {
    const std::size_t column = i % size, row = i / size % size, channel = i / (size * size) % in;
    const std::size_t at = row * run + column * stored + channel;
    part.weights[weight_index(i / (size * size * in), at, size * run)] = weight.values[i];
  }
  const int margin = number + 1 < kConvolutions.size() ? kConvolutions[number + 1].margin : 0;
  Picture& to =
      pictures.emplace_back(shrunk(from.rows, convolution), shrunk(from.columns, convolution),
                            padded(static_cast<int>(out)), margin);
  Layer& layer = part.layer;
  layer.input = from.values.data();
  layer.kernel_row = from.row_step;
  layer.kernel_rows = convolution.size;
  layer.run = static_cast<int>(run);
  layer.row_in = from.row_step * convolution.stride;
  layer.pixel_in = from.channels * convolution.stride;
  layer.output = to.first();
  layer.row_out = to.row_step;
  layer.pixel_out = to.channels;
  layer.rows = to.rows;
  layer.columns = to.columns;
  parts.push_back(std::move(part));
  return static_cast<int>(out);
}

/// Returns the last one's channels.
int Network::Parts::add_convolutions(WeightsFile& file) {
  pictures.reserve(kConvolutions.size());  // references to them stay
  int channels = 1;
  for (std::size_t i = 0; i < kConvolutions.size(); ++i) {
    channels = add_convolution(file, i, channels, i == 0 ? image : pictures.back());
  }
  return channels;
}

/// Adds a linear layer of `count_in` inputs, number i of which is at from[place(i)], of `run`, and
/// returns how many outputs it has: count_out, or what the file says where that is 0.
template <class Place>
int Network::Parts::add_linear(WeightsFile& file, const std::string& name, int count_out,
                               int count_in, const float* from, int run, const Place& place) {
  const std::size_t in = index(count_in);
  const Tensor weight = file.take(name + ".weight", {index(count_out), in});
  const std::size_t out = weight.shape[0];
  Part part = make_part(file, name, out, index(run));
  for (std::size_t i = 0; i < weight.values.size(); ++i) {
    part.weights[weight_index(i / in, index(place(static_cast<int>(i % in))), index(run))] =
        weight.values[i];
  }
  Layer& layer = part.layer;
  layer.input = from;
  layer.kernel_rows = layer.rows = layer.columns = 1;
  layer.run = run;
  parts.push_back(std::move(part));
  return static_cast<int>(out);
}

Network::Parts::Parts(WeightsFile& file, void (*apply_layer)(const Layer&)) : apply(apply_layer) {
  const auto as_they_are = [](int i) { return i; };
  const auto make = [](int count) { return Floats(index(padded(count)), 0.0F); };
  const int channels = add_convolutions(file);
  const Picture& seen = pictures.back();
  const int pixels = seen.rows * seen.columns;
  const int image_count = add_linear(
      file, "image_full", 0, channels * pixels, seen.values.data(), seen.channels * pixels,
      [&](int i) { return i % pixels * seen.channels + i / pixels; });  // channel by channel
  const std::size_t image_part = parts.size() - 1;

  inputs = make(kInputs);
  int count = add_linear(file, "state1", 0, kInputs, inputs.data(), kInputs, as_they_are);
  state1 = make(count);
  set_output(state1.data());
  count = add_linear(file, "state2", 0, count, state1.data(), count, as_they_are);
  joined = make(padded(image_count) + count);
  parts[image_part].layer.output = joined.data();
  set_output(joined.data() + padded(image_count));

  count = add_linear(
      file, "head1", 0, image_count + count, joined.data(), padded(image_count) + count,
      [&](int i) { return i < image_count ? i : i - image_count + padded(image_count); });
  head1 = make(count);
  set_output(head1.data());
  count = add_linear(file, "head2", 0, count, head1.data(), count, as_they_are);
  head2 = make(count);
  set_output(head2.data());
  add_linear(file, "out", kOutputs, count, head2.data(), count, as_they_are);
  outputs = make(kOutputs);
  set_output(outputs.data());
  parts.back().layer.is_rectified = false;
  file.check_all_taken();
}

Network::Network(const std::filesystem::path& file)
    : Network(file, kernels::has_avx2() ? kernels::apply_avx2 : kernels::apply_portable) {}

Network::Network(const std::filesystem::path& file, void (*apply)(const Layer&)) {
  WeightsFile weights(file);
  parts_ = std::make_unique<Parts>(weights, apply);
}

Network::~Network() = default;
Network::Network(Network&&) noexcept = default;
Network& Network::operator=(Network&&) noexcept = default;

std::array<Mode, kModes> Network::run(std::span<const std::uint8_t> image,
                                      std::span<const float> inputs) {
  if (image.size() != index(kImageHeight * kImageWidth) || inputs.size() != index(kInputs)) {
    throw std::invalid_argument("the network takes 64 x 96 pixels and 22 inputs, not " +
                                std::to_string(image.size()) + " and " +
                                std::to_string(inputs.size()));
  }
  if (!std::all_of(inputs.begin(), inputs.end(), [](float x) { return std::isfinite(x); })) {
    throw std::invalid_argument("an input of the network is not finite");
  }
  float* to = parts_->image.first();
  for (std::size_t y = 0; y < index(kImageHeight); ++y) {
    const auto row = image.subspan(y * index(kImageWidth), index(kImageWidth));
    std::transform(row.begin(), row.end(), to, [](std::uint8_t grey) { return kGreyLevels[grey]; });
    to += parts_->image.row_step;
  }
  std::copy(inputs.begin(), inputs.end(), parts_->inputs.begin());
  for (const Part& part : parts_->parts) parts_->apply(part.layer);

  std::array<Mode, kModes> modes{};
  const float* from = parts_->outputs.data();
  for (Mode& mode : modes) {
    mode.cost = *from++;
    for (auto& point : mode.points) {
      for (float& coordinate : point) coordinate = *from++;
    }
  }
  return modes;
}

}  // namespace agile
