#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sensing/sensor_spec.hpp"

namespace avoidbench {

/// The matcher of a stereo sensor, with its buffers. Runs on the calling thread alone.
class StereoMatcher {
 public:
  virtual ~StereoMatcher() = default;

  /// Disparity of the left image, pixels; NaN: invalid. All are height × width, row-major.
  virtual void match(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
                     std::span<float> disparity_px) = 0;
};

/// The sensor's own; null where it does not match.
std::unique_ptr<StereoMatcher> make_stereo_matcher(const CameraSpec& sensor);

}  // namespace avoidbench
