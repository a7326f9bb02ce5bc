#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "bare_loop.hpp"
#include "base/random.hpp"
#include "render/ray_tracing_isa.hpp"
#include "sensing/census_internals.hpp"
#include "sensing/census_matcher.hpp"

// Every stereo matcher stands beside OpenCV's in its full mode, MODE_HH, measured in turns with it
// on the same images, each by one thread.
namespace avoidbench {
namespace {

constexpr double kNearest_px = 50.0, kFarthest_px = 2.0;

/// Random values on grids of 2, 4, 8 and 16 px, added up and interpolated.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    RandomStream random(seed);
    for (std::vector<float>& octave : octaves_) {
      octave.resize(kSide * kSide);
      for (float& value : octave) value = static_cast<float>(random.uniform(-1.0, 1.0));
    }
  }

  double at(double x_px, double y_px) const {
    double sum = 128.0;
    double cell_px = 2.0;
    for (const std::vector<float>& octave : octaves_) {
      const double x = x_px / cell_px + 8.0;
      const double y = y_px / cell_px + 8.0;
      const auto column = static_cast<std::size_t>(x);
      const auto row = static_cast<std::size_t>(y);
      const double s = x - static_cast<double>(column);
      const double t = y - static_cast<double>(row);
      const float* corner = &octave[row * kSide + column];
      sum += 40.0 * ((1.0 - t) * ((1.0 - s) * static_cast<double>(corner[0]) +
                                  s * static_cast<double>(corner[1])) +
                     t * ((1.0 - s) * static_cast<double>(corner[kSide]) +
                          s * static_cast<double>(corner[kSide + 1])));
      cell_px *= 2.0;
    }
    return std::clamp(sum, 0.0, 255.0);
  }

 private:
  static constexpr std::size_t kSide = 512;
  std::vector<float> octaves_[4];
};

struct StereoPair {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> left, right;
};

/// Boards of 40 × 40 px before a slanting wall, 2 to 50 px of disparity.
double disparity_px(int x, int y) {
  if (x % 120 < 40 && y % 80 < 40) {
    return 20.0 + (kNearest_px - 20.0) * ((x / 120 + y / 80) % 4) / 3.0;
  }
  return kFarthest_px + 0.03 * (x + y) / 2.0;
}

/// The left image is drawn with the depth of its own pixels; the right one is the texture itself.
const StereoPair& stereo_pair(int width_px) {
  static std::map<int, StereoPair> pairs;
  StereoPair& pair = pairs[width_px];
  if (!pair.left.empty()) return pair;
  const Texture texture(7);
  RandomStream noise(8);
  pair.width_px = width_px;
  pair.height_px = width_px * 3 / 4;
  for (int y = 0; y < pair.height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const double left = texture.at(x - disparity_px(x, y) + kNearest_px, y);
      const double right = texture.at(x + kNearest_px, y);
      const double left_noise = noise.uniform(-2.0, 2.0);
      const double right_noise = noise.uniform(-2.0, 2.0);
      pair.left.push_back(static_cast<std::uint8_t>(std::clamp(left + left_noise, 0.0, 255.0)));
      pair.right.push_back(static_cast<std::uint8_t>(std::clamp(right + right_noise, 0.0, 255.0)));
    }
  }
  return pair;
}

cv::Ptr<cv::StereoSGBM> make_sgbm(int disparities, int mode) {
  return cv::StereoSGBM::create(0, disparities, 5, 8 * 25, 32 * 25, 1, 0, 10, 100, 2, mode);
}

struct SgbmRun {
  const StereoPair* pair;
  cv::Ptr<cv::StereoSGBM> sgbm;
  cv::Mat out;

  const std::int16_t* operator()() {
    const auto grey = [&](const std::vector<std::uint8_t>& pixels) {
      return cv::Mat(pair->height_px, pair->width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(pixels.data()));
    };
    sgbm->compute(grey(pair->left), grey(pair->right), out);
    return out.ptr<std::int16_t>();
  }
};

struct CensusRun {
  const StereoPair* pair;
  const census::Kernels* kernels;
  CensusSettings settings;
  CensusWorkspace workspace;
  std::vector<std::int16_t> out;

  const std::int16_t* operator()() {
    out.resize(pair->left.size());
    census::match(*kernels, settings, pair->left, pair->right, pair->width_px, pair->height_px,
                  workspace, out);
    return out.data();
  }
};

/// Share of the pixels whose disparity is within 1 px of the true one.
double right_share(const StereoPair& pair, const std::int16_t* disparity) {
  int right = 0;
  for (int y = 0; y < pair.height_px; ++y) {
    for (int x = 0; x < pair.width_px; ++x) {
      const double error_px = *disparity++ / 16.0 - disparity_px(x, y);
      if (error_px >= -1.0 && error_px <= 1.0) ++right;
    }
  }
  return right / static_cast<double>(pair.left.size());
}

template <class Run>
void beside_hh(benchmark::State& state, Run run) {
  cv::setNumThreads(1);
  const auto disparities = static_cast<int>(state.range(1));
  SgbmRun full{run.pair, make_sgbm(disparities, cv::StereoSGBM::MODE_HH), {}};
  run();
  full();
  std::vector<double> run_s;
  std::vector<double> full_s;
  double right = 0.0;
  for (auto _ : state) {
    const double first = processor_s();
    const std::int16_t* found = run();
    run_s.push_back(processor_s() - first);
    right = right_share(*run.pair, found);
    const double second = processor_s();
    benchmark::DoNotOptimize(full());
    full_s.push_back(processor_s() - second);
    state.SetIterationTime(run_s.back());
  }
  state.counters["ms"] = 1e3 * median(run_s);
  state.counters["hh_ms"] = 1e3 * median(full_s);
  state.counters["of_hh"] = median(run_s) / median(full_s);
  state.counters["within_1px"] = right;
}

void sgbm(benchmark::State& state, int mode) {
  beside_hh(state, SgbmRun{&stereo_pair(static_cast<int>(state.range(0))),
                           make_sgbm(static_cast<int>(state.range(1)), mode),
                           {}});
}

void census_with(benchmark::State& state, CensusSettings settings, bool portable) {
  if (!portable && !has_avx2()) return state.SkipWithError("this processor has no AVX2");
  settings.disparities = static_cast<int>(state.range(1));
  beside_hh(state, CensusRun{&stereo_pair(static_cast<int>(state.range(0))),
                             portable ? &census::portable_kernels() : &census::avx2_kernels(),
                             settings,
                             {},
                             {}});
}

void census_paths(benchmark::State& state, int paths, bool subpixel, bool portable) {
  census_with(state, {.paths = paths, .subpixel = subpixel}, portable);
}

/// As the preset stereo_sgm has it, without its filter of speckles, which OpenCV does.
void stereo_sgm(benchmark::State& state, bool portable) {
  census_with(state,
              {.window = CensusWindow::five_by_five,
               .paths = 4,
               .small_penalty = 5,
               .large_penalty = 32,
               .subpixel = true,
               .uniqueness_percent = 10},
              portable);
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"width", "disparities"})
      ->Args({320, 64})
      ->Args({640, 128})
      ->UseManualTime()
      ->MinTime(0.2)
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(census_paths, 8, 8, false, false)->Apply(sizes);
BENCHMARK_CAPTURE(census_paths, 8_subpixel, 8, true, false)->Apply(sizes);
BENCHMARK_CAPTURE(census_paths, 4, 4, false, false)->Apply(sizes);
BENCHMARK_CAPTURE(stereo_sgm, avx2, false)->Apply(sizes);
BENCHMARK_CAPTURE(stereo_sgm, portable, true)->Apply(sizes);
BENCHMARK_CAPTURE(census_paths, 8_portable, 8, false, true)->Apply(sizes);
BENCHMARK_CAPTURE(census_paths, 4_portable, 4, false, true)->Apply(sizes);
BENCHMARK_CAPTURE(sgbm, MODE_SGBM, cv::StereoSGBM::MODE_SGBM)->Apply(sizes);
BENCHMARK_CAPTURE(sgbm, MODE_SGBM_3WAY, cv::StereoSGBM::MODE_SGBM_3WAY)->Apply(sizes);
BENCHMARK_CAPTURE(sgbm, MODE_HH, cv::StereoSGBM::MODE_HH)->Apply(sizes);
BENCHMARK_CAPTURE(sgbm, MODE_HH4, cv::StereoSGBM::MODE_HH4)->Apply(sizes);

}  // namespace
}  // namespace avoidbench

BENCHMARK_MAIN();
