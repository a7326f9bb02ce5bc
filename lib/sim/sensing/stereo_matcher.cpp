#include "sensing/stereo_matcher.hpp"

#include <limits>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "base/check.hpp"
#include "sensing/census_matcher.hpp"

namespace avoidbench {
namespace {

constexpr float kNoMatch = std::numeric_limits<float>::quiet_NaN();

int sgbm_mode(SgbmMode mode) {
  switch (mode) {
    case SgbmMode::sgbm:
      return cv::StereoSGBM::MODE_SGBM;
    case SgbmMode::three_way:
      return cv::StereoSGBM::MODE_SGBM_3WAY;
    case SgbmMode::hh:
      return cv::StereoSGBM::MODE_HH;
    case SgbmMode::hh4:
      return cv::StereoSGBM::MODE_HH4;
  }
  return cv::StereoSGBM::MODE_SGBM;
}

class SgbmMatcher : public StereoMatcher {
 public:
  SgbmMatcher(const StereoSgbmSpec& spec, int width_px, int height_px)
      : size_(width_px, height_px), border_(static_cast<int>(spec.disparities)) {
    cv::setNumThreads(1);  // one trial a core; the result does not depend on it
    const int block = static_cast<int>(spec.block_px);
    // Costs are sums over a block: penalties grow with its pixels.
    const auto penalty = [&](double factor) { return static_cast<int>(factor * block * block); };
    constexpr int kPrefilterCap = 31;
    matcher_ = cv::StereoSGBM::create(
        0, static_cast<int>(spec.disparities), block, penalty(spec.p1_factor),
        penalty(spec.p2_factor), static_cast<int>(spec.left_right_px), kPrefilterCap,
        static_cast<int>(spec.uniqueness_percent), static_cast<int>(spec.speckle_window_px),
        static_cast<int>(spec.speckle_range_px), sgbm_mode(spec.mode));
  }

  void match(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
             std::span<float> disparity_px) override {
    pad(left, left_);
    pad(right, right_);
    matcher_->compute(left_, right_, sixteenths_);
    for (int y = 0; y < size_.height; ++y) {
      const std::int16_t* from = sixteenths_.ptr<std::int16_t>(y) + border_;
      float* to =
          &disparity_px[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width)];
      for (int x = 0; x < size_.width; ++x) {
        // OpenCV counts in sixteenths of a pixel.
        const float disparity = static_cast<float>(from[x]) * (1.0F / 16.0F);
        // The partner would lie left of the right image: in the border, which repeats a column.
        const bool seen_right = disparity <= static_cast<float>(x) + 0.5F;
        to[x] = from[x] >= 0 && seen_right ? disparity : kNoMatch;
      }
    }
  }

 private:
  /// OpenCV leaves out as many columns at the left as there are disparities. We put them before the
  /// image, so that whatever both eyes see is matched.
  void pad(std::span<const std::uint8_t> image, cv::Mat& padded) const {
    AB_CHECK(image.size() == static_cast<std::size_t>(size_.area()), image.size());
    // OpenCV takes const data only by a cast; it is not written to.
    const cv::Mat pixels(size_, CV_8UC1, const_cast<std::uint8_t*>(image.data()));
    cv::copyMakeBorder(pixels, padded, 0, 0, border_, 0, cv::BORDER_REPLICATE);
  }

  cv::Size size_;
  int border_;
  cv::Ptr<cv::StereoSGBM> matcher_;
  cv::Mat left_, right_, sixteenths_;
};

class CensusMatcher : public StereoMatcher {
 public:
  CensusMatcher(const StereoSgmSpec& spec, int width_px, int height_px)
      : settings_{.window = spec.window,
                  .disparities = static_cast<int>(spec.disparities),
                  .paths = static_cast<int>(spec.paths),
                  .small_penalty = static_cast<int>(spec.p1),
                  .large_penalty = static_cast<int>(spec.p2),
                  .subpixel = spec.subpixel,
                  .uniqueness_percent = static_cast<int>(spec.uniqueness_percent),
                  .left_right_tolerance_px = static_cast<int>(spec.left_right_px)},
        speckle_window_px_(static_cast<int>(spec.speckle_window_px)),
        speckle_range_px_(static_cast<int>(spec.speckle_range_px)),
        zero_is_invalid_(!spec.subpixel),
        width_px_(width_px),
        height_px_(height_px) {}

  void match(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
             std::span<float> disparity_px) override {
    sixteenths_.resize(disparity_px.size());
    match_census(settings_, left, right, width_px_, height_px_, workspace_, sixteenths_);
    if (speckle_window_px_ > 0) {
      cv::Mat image(height_px_, width_px_, CV_16SC1, sixteenths_.data());
      cv::filterSpeckles(image, kInvalidDisparity, speckle_window_px_, 16 * speckle_range_px_,
                         speckle_buffer_);
    }
    for (std::size_t i = 0; i < disparity_px.size(); ++i) {
      const std::int16_t disparity = sixteenths_[i];
      const bool is_valid = disparity > 0 || (disparity == 0 && !zero_is_invalid_);
      disparity_px[i] = is_valid ? static_cast<float>(disparity) * (1.0F / 16.0F) : kNoMatch;
    }
  }

 private:
  CensusSettings settings_;
  int speckle_window_px_, speckle_range_px_;
  /// As in the original, which knows whole pixels alone. The matcher itself has another mark.
  bool zero_is_invalid_;
  int width_px_, height_px_;
  CensusWorkspace workspace_;
  cv::Mat speckle_buffer_;
  std::vector<std::int16_t> sixteenths_;
};

}  // namespace

std::unique_ptr<StereoMatcher> make_stereo_matcher(const CameraSpec& sensor) {
  if (const auto* sgm = std::get_if<StereoSgbmSpec>(&sensor.method)) {
    return std::make_unique<SgbmMatcher>(*sgm, static_cast<int>(sensor.width_px),
                                         static_cast<int>(sensor.height_px));
  }
  if (const auto* census = std::get_if<StereoSgmSpec>(&sensor.method)) {
    return std::make_unique<CensusMatcher>(*census, static_cast<int>(sensor.width_px),
                                           static_cast<int>(sensor.height_px));
  }
  return nullptr;
}

}  // namespace avoidbench
