#include "sample_files.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/input_error.hpp"
#include "base/npy_header.hpp"

namespace agile {
namespace {

namespace fs = std::filesystem;

std::string name_of(std::size_t map_number) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04zu", map_number);
  return text.data();
}

void finish(std::ofstream& out, const fs::path& file) {
  out.close();
  if (!out) throw avoidbench::InputError("can't write " + file.string());
}

void write_array(const fs::path& file, const char* type, const std::vector<std::size_t>& shape,
                 const void* data, std::size_t bytes) {
  std::ofstream out(file, std::ios::binary);
  out << avoidbench::npy_header(type, shape);
  out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  finish(out, file);
}

}  // namespace

void write_json(const fs::path& file, const nlohmann::json& json) {
  std::ofstream out(file);
  out << json.dump(1) << '\n';
  finish(out, file);
}

void write_samples(const fs::path& folder, std::size_t map_number,
                   const std::vector<Sample>& samples, const ClearanceField& field,
                   nlohmann::json about) {
  const std::string name = name_of(map_number);
  const auto write = [&](const char* what, const char* type, std::vector<std::size_t> shape,
                         const auto& values) {
    write_array(folder / (name + "." + what + ".npy"), type, shape, values.data(),
                values.size() * sizeof(values[0]));
  };
  std::vector<std::uint8_t> images;
  std::vector<float> inputs, labels, costs;
  std::vector<double> frames;
  for (const Sample& sample : samples) {
    images.insert(images.end(), sample.image.begin(), sample.image.end());
    inputs.insert(inputs.end(), sample.inputs.begin(), sample.inputs.end());
    const Eigen::Vector3d& origin = sample.frame.origin_world;
    frames.insert(frames.end(), {origin.x(), origin.y(), origin.z(), sample.frame.yaw_rad,
                                 sample.desired_speed_mps});
    for (const ModePoints& label : sample.labels) {
      for (const auto& point : label) labels.insert(labels.end(), point.begin(), point.end());
    }
    costs.insert(costs.end(), sample.costs.begin(), sample.costs.end());
  }
  const std::size_t count = samples.size();
  write("images", "|u1", {count, kImageHeight, kImageWidth}, images);
  write("inputs", "<f4", {count, kInputs}, inputs);
  write("frames", "<f8", {count, 5}, frames);
  write("labels", "<f4", {count, kModes, kPoints, 3}, labels);
  write("label_costs", "<f4", {count, kModes}, costs);
  const auto size = [&](int axis) { return static_cast<std::size_t>(field.size[axis]); };
  write("clearance", "|u1", {size(2), size(1), size(0)}, field.steps);
  about["origin"] = {field.origin_world.x(), field.origin_world.y(), field.origin_world.z()};
  about["cell_m"] = field.cell_m;
  about["samples"] = count;
  write_json(folder / (name + ".json"), about);
}

}  // namespace agile
