#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "network.hpp"

namespace agile {
namespace {

/// What PyTorch gave for the weights that are flown, in doubles; written by train/check.py.
TEST(TrainedWeights, GiveWhatTheyGaveWhereTheyWereTrained) {
  std::ifstream file(NETWORK_CHECK);
  const nlohmann::json check = nlohmann::json::parse(file);
  std::vector<std::uint8_t> image(kImageHeight * kImageWidth);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<std::uint8_t>(i * 37 + 11);
  const auto inputs = check.at("inputs").get<std::vector<float>>();
  Network network(WEIGHTS_FILE);
  const auto modes = network.run(image, inputs);
  const auto expected = check.at("outputs").get<std::vector<double>>();
  ASSERT_EQ(expected.size(), std::size_t(kModes * (1 + 3 * kPoints)));
  std::size_t at = 0;
  for (const Mode& mode : modes) {
    EXPECT_NEAR(mode.cost, expected[at++], 1e-4);
    for (const auto& point : mode.points) {
      for (const float x : point) EXPECT_NEAR(x, expected[at++], 1e-4);
    }
  }
}

}  // namespace
}  // namespace agile
