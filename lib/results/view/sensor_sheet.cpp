#include "view/sensor_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "base/option_error.hpp"
#include "base/random.hpp"
#include "render/depth.hpp"
#include "sensing/camera.hpp"
#include "sensing/depth_statistics.hpp"
#include "sensing/lidar.hpp"

namespace avoidbench {
namespace {

constexpr double kErrorScale_m = 1.0;  ///< at which an error's colour is full
// The grey of depth_picture().
constexpr std::uint8_t kInvalid = 96;

Picture grey_picture(const std::vector<std::uint8_t>& pixels, int width_px, int height_px) {
  Picture picture = make_picture(width_px, height_px);
  for (std::size_t i = 0; i < pixels.size(); ++i) std::fill_n(&picture.rgb[3 * i], 3, pixels[i]);
  return picture;
}

/// White where right, red where measured too far, blue too near; grey where invalid, black where
/// both say there is nothing.
Picture error_picture(const std::vector<float>& truth_m, const std::vector<float>& measured_m,
                      double max_range_m, int width_px, int height_px) {
  Picture picture = make_picture(width_px, height_px);
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    const auto truth = static_cast<double>(truth_m[i]);
    const auto measured = static_cast<double>(measured_m[i]);
    std::uint8_t* rgb = &picture.rgb[3 * i];
    if (std::isnan(measured)) {
      std::fill_n(rgb, 3, kInvalid);
      continue;
    }
    // Beyond the range there is nothing to see.
    const bool nothing = truth > max_range_m;
    if (nothing && !std::isfinite(measured)) continue;
    // Beyond the range is as far as its end: what lies there is no error of many metres.
    const double error = std::min(measured, max_range_m) - std::min(truth, max_range_m);
    const double share = std::clamp(error / kErrorScale_m, -1.0, 1.0);
    // White fades to the full colour at kErrorScale_m.
    const auto faded = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::abs(share))));
    rgb[0] = share > 0.0 ? 255 : faded;
    rgb[1] = faded;
    rgb[2] = share > 0.0 ? faded : 255;
  }
  return picture;
}

std::string figures(const DepthStatistics& s) {
  if (s.pixel_count == 0) return "nothing within range";
  if (std::isnan(s.disparity_bias_px)) return "no depth within 1 px of the truth";
  char line[200];
  std::snprintf(
      line, sizeof line,
      "%.1f %% valid, disparity error %.3f ± %.3f px, beyond 1 px %.1f %%, away from edges",
      100.0 * s.valid_ratio, s.disparity_bias_px, s.disparity_sigma_px, 100.0 * s.outlier_ratio);
  return line;
}

/// Puts rows of cells into one picture: each column as wide, each row as high as its largest.
/// Two passes: heights and the number of columns, then widths, since a column is as wide as its
/// widest cell in any row.
Picture tiled(const std::vector<std::vector<Picture>>& rows) {
  constexpr int kGap = 4;
  std::vector<int> lefts{0}, tops{0};
  for (const auto& row : rows) {
    int height = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (lefts.size() < c + 2) lefts.push_back(lefts.back());
      height = std::max(height, row[c].height_px);
    }
    tops.push_back(tops.back() + height + kGap);
  }
  for (std::size_t c = 0; c + 1 < lefts.size(); ++c) {
    int width = 0;
    for (const auto& row : rows) width = std::max(width, c < row.size() ? row[c].width_px : 0);
    lefts[c + 1] = lefts[c] + width + kGap;
  }
  Picture sheet = make_picture(lefts.back() - kGap, tops.back() - kGap);
  std::fill(sheet.rgb.begin(), sheet.rgb.end(), std::uint8_t{255});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) paste(rows[r][c], lefts[c], tops[r], sheet);
  }
  return sheet;
}

/// Cells of at least this width, so that captions can be read.
Picture cell(Picture picture, const std::string& caption) {
  constexpr int kLeastWidth_px = 320;
  const int factor = (kLeastWidth_px + picture.width_px - 1) / picture.width_px;
  Picture shown = factor > 1 ? enlarged(picture, factor) : std::move(picture);
  add_caption(shown, caption);
  return shown;
}

/// A picture and the view that it is.
struct Cell {
  std::string view;
  Picture picture;
};

/// All views of one camera.
std::vector<Cell> cells_of(const CameraSpec& sensor, CameraImages& images,
                           const std::vector<float>& truth_m) {
  const int width = static_cast<int>(sensor.width_px), height = static_cast<int>(sensor.height_px);
  constexpr double kMostShown_m = 20.0;  // what is farther has the colour of this
  const double range_m = sensor.max_range_m, shown_m = std::min(range_m, kMostShown_m);
  const auto depth_cell = [&](const std::vector<float>& depth_m, const std::string& caption) {
    Picture shown = cell(depth_picture(depth_m, width, height, 0.0, shown_m), caption);
    add_depth_scale(shown, 0.0, shown_m);
    return shown;
  };
  Picture color = make_picture(width, height);
  color.rgb = images.color;
  std::vector<Cell> cells{{"left", cell(grey_picture(images.left, width, height), "left")},
                          {"right", cell(grey_picture(images.right, width, height), "right")},
                          {"color", cell(std::move(color), "colour")}};
  if (is_stereo(sensor)) {
    // The disparity at half a metre is red. depth_picture() makes small numbers red, so what is
    // missing to it is drawn.
    const double most_px = disparity_at_1m_px(sensor) / 0.5;
    std::vector<float> from_most = images.disparity_px;
    for (float& disparity : from_most) disparity = static_cast<float>(most_px) - disparity;
    cells.push_back({"disparity", cell(depth_picture(from_most, width, height, 0.0, most_px),
                                       "disparity: red is large")});
  }
  cells.push_back({"depth", depth_cell(images.depth_m, sensor.name + ": depth")});
  cells.push_back({"truth", depth_cell(truth_m, "true depth")});
  cells.push_back({"error", cell(error_picture(truth_m, images.depth_m, range_m, width, height),
                                 "error: blue -1 m, white 0, red +1 m")});
  return cells;
}

/// A sweep at rest as range over azimuth, from behind over the left to behind, and elevation; and
/// from above.
std::vector<Cell> cells_of(const LidarSpec& lidar, const LidarSweep& sweep) {
  constexpr int kWidth_px = 720, kHeight_px = 240, kSide_px = 480;
  constexpr double kMostShown_m = 20.0;
  const double lowest_rad = elevations_rad(lidar)[0], highest_rad = elevations_rad(lidar)[1];
  std::vector<float> ranges_m(static_cast<std::size_t>(kWidth_px) * kHeight_px, math::kNaN);
  const double rows_per_rad = (kHeight_px - 1) / std::max(highest_rad - lowest_rad, 1e-3);
  const auto mark = [&](const Eigen::Vector3d& direction, double range_m) {
    const double azimuth_rad = math::atan2(direction.y(), direction.x());
    const double elevation_rad = math::atan2(direction.z(), direction.head<2>().norm());
    const int column = static_cast<int>((0.5 - azimuth_rad / math::kTau) * (kWidth_px - 1));
    const int row = static_cast<int>((highest_rad - elevation_rad) * rows_per_rad);
    // Two pixels each way: single ones can't be seen.
    for (int y = std::max(row, 0); y < std::min(row + 2, kHeight_px); ++y) {
      for (int x = column; x < std::min(column + 2, kWidth_px); ++x) {
        float& pixel =
            ranges_m[static_cast<std::size_t>(y) * kWidth_px + static_cast<std::size_t>(x)];
        if (!(static_cast<double>(pixel) <= range_m)) pixel = static_cast<float>(range_m);
      }
    }
  };
  Picture plan = make_picture(kSide_px, kSide_px);
  std::fill(plan.rgb.begin(), plan.rgb.end(), std::uint8_t{255});
  const double px_per_m = 0.5 * kSide_px / kMostShown_m;
  for (const Eigen::Vector3f& miss : sweep.misses) {
    mark(miss.cast<double>(), std::numeric_limits<double>::infinity());
  }
  for (const LidarPoint& point : sweep.points) {
    const Eigen::Vector3d place = point.position_lidar.cast<double>();
    mark(place, place.norm());
    // Forward is up.
    draw_disc(plan, {0.5 * kSide_px - px_per_m * place.y(), 0.5 * kSide_px - px_per_m * place.x()},
              1.0, height_color(std::clamp(0.5 + place.z() / 4.0, 0.0, 1.0)));
  }
  draw_disc(plan, {0.5 * kSide_px, 0.5 * kSide_px}, 4.0, {220, 30, 30});
  add_scale_bar(plan, px_per_m);
  add_caption(plan, "from above, 20 m around; colour: height");
  Picture ranges = depth_picture(ranges_m, kWidth_px, kHeight_px, 0.0, kMostShown_m);
  add_caption(ranges, lidar.name + ": a sweep's ranges over azimuth and elevation");
  add_depth_scale(ranges, 0.0, kMostShown_m);
  return {{"depth", std::move(ranges)}, {"depth", std::move(plan)}};
}

/// A sweep of a lidar that rests.
LidarSweep sweep_at_rest(const LidarSpec& spec, const Scene& scene, const Pose& T_world_lidar,
                         std::uint64_t seed) {
  Lidar lidar(spec);
  lidar.begin_sweep(0, seed);
  lidar.fire(scene, at_rest(spec, T_world_lidar));
  LidarSweep sweep;
  lidar.end_sweep(T_world_lidar, sweep);
  return sweep;
}

/// Rows of pictures: what the eyes see above what was measured; a row a camera where there are
/// more; one row of a single view.
std::vector<std::vector<Picture>> arranged(std::vector<std::vector<Cell>> cameras,
                                           const std::string& view) {
  const bool is_sheet = view == "sheet", has_several = cameras.size() > 1;
  std::vector<std::vector<Picture>> rows(1);
  for (std::vector<Cell>& cells : cameras) {
    for (Cell& one : cells) {
      if (!is_sheet && one.view != view) continue;
      // Of several cameras only the left image of what is seen, to keep rows short.
      const bool is_left_out =
          one.view == "right" || one.view == "color" || one.view == "disparity";
      if (is_sheet && has_several && is_left_out) continue;
      const bool starts_row = is_sheet && one.view == (has_several ? "left" : "depth");
      if (starts_row && !rows.back().empty()) rows.emplace_back();
      rows.back().push_back(std::move(one.picture));
    }
  }
  return rows;
}

}  // namespace

std::vector<std::string> sensor_view_names() {
  return {"sheet", "left", "right", "color", "disparity", "depth", "truth", "error"};
}

SensorSheet make_sensor_sheet(const SensorSpec& sensor, const Scene& scene,
                              const Pose& T_world_body, std::uint64_t seed,
                              const std::string& view) {
  const std::vector<RigCamera> all = rig_cameras(sensor);
  const bool has_pairs =
      std::any_of(all.begin(), all.end(), [](const RigCamera& one) { return is_stereo(one.kind); });
  if (view == "disparity" && !has_pairs) {
    throw OptionError("disparity: " + sensor.name + " does not match images", "view");
  }
  std::vector<std::vector<Cell>> cameras;
  SensorSheet sheet;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CameraSpec& kind = all[i].kind;
    // The truth is without the sensor's limits, so that an error beyond them shows, too.
    Pinhole ideal = sensor_camera(kind);
    ideal.min_range_m = 0.0;
    ideal.max_range_m = std::numeric_limits<double>::infinity();
    Camera camera(kind);
    CameraImages images;
    std::vector<float> truth_m(static_cast<std::size_t>(kind.width_px * kind.height_px));
    const Pose T_world_camera = T_world_body * T_body_camera(all[i].mounting);
    camera.expose(scene, T_world_camera, {}, {.depth = true, .stereo = true, .color = true},
                  // A stream of its own, so that a camera's noise does not depend on how many
                  // others there are.
                  stream_seed(seed, i), images);
    render_depth(scene, ideal, T_world_camera, truth_m);
    std::vector<DepthSample> samples;
    // At edges a pixel's depth is of either side: figures are of what is farther from them than
    // this.
    constexpr int kEdge_px = 8;
    const double at_1m_px = disparity_at_1m_px(kind);
    add_samples(truth_m, images.depth_m, static_cast<int>(kind.width_px), at_1m_px, kEdge_px,
                samples);
    const DepthStatistics inside =
        depth_statistics(samples, false, 0.0, kind.max_range_m, at_1m_px);
    sheet.summary +=
        (all.size() > 1 ? "camera " + std::to_string(i) + ": " : "") + figures(inside) + "\n";
    cameras.push_back(cells_of(kind, images, truth_m));
  }
  std::vector<std::vector<Picture>> rows = arranged(std::move(cameras), view);
  for (std::size_t i = 0; i < sensor.lidars.size() && (view == "sheet" || view == "depth"); ++i) {
    const LidarSpec& lidar = sensor.lidars[i];
    const LidarSweep sweep =
        sweep_at_rest(lidar, scene, T_world_body * T_body_lidar(lidar.mounting),
                      stream_seed(seed, all.size() + i));
    sheet.summary += lidar.name + ": " + std::to_string(sweep.points.size()) + " of " +
                     std::to_string(shots_per_sweep(lidar)) + " shots met something\n";
    for (Cell& cell : cells_of(lidar, sweep)) rows.push_back({std::move(cell.picture)});
  }
  std::erase_if(rows, [](const auto& row) { return row.empty(); });
  if (rows.empty()) throw OptionError(view + ": " + sensor.name + " has no camera", "view");
  sheet.picture = tiled(rows);
  return sheet;
}

}  // namespace avoidbench
