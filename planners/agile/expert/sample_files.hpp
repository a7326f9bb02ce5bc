#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "clearance_field.hpp"
#include "curve.hpp"
#include "expert.hpp"
#include "situation.hpp"

namespace agile {

/// One image with what is known of it.
struct Sample {
  Image image{};
  Inputs inputs{};
  ImageFrame frame;
  double desired_speed_mps = 0.0;
  std::array<ModePoints, kModes> labels{};
  std::array<float, kModes> costs{};
};

/// Writes the samples of one map as NumPy arrays, NNNN.<name>.npy with the map's number:
///
///  - images, uint8, samples × 64 × 96: net_image()
///  - inputs, float32, samples × 22: net_inputs()
///  - frames, float64, samples × 5: the frame's origin in the world, m, its yaw, rad; desired
///    speed, m/s
///  - labels, float32, samples × 3 × 10 × 3: points_of() the expert's ways, best first
///  - label_costs, float32, samples × 3
///  - clearance, uint8, z × y × x: ClearanceField::steps
///
/// and NNNN.json, `about` with the field's place. Throws InputError where a file can't be written.
void write_samples(const std::filesystem::path& folder, std::size_t map_number,
                   const std::vector<Sample>& samples, const ClearanceField& field,
                   nlohmann::json about);

/// Throws InputError where the file can't be written.
void write_json(const std::filesystem::path& file, const nlohmann::json& json);

}  // namespace agile
