#include "page/flight_page.hpp"

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/math.hpp"
#include "page/flight_data.hpp"
#include "page/packed.hpp"
#include "trial/planner_view.hpp"

namespace avoidbench {
namespace {

using nlohmann::ordered_json;

constexpr double kLevels = 253.0;  // between the least and the greatest depth
constexpr double kAllSamples_hz = 50.0;

double norm_of(const double* xyz) {
  return std::sqrt(xyz[0] * xyz[0] + xyz[1] * xyz[1] + xyz[2] * xyz[2]);
}

/// Of each so many pixels the middle one: an average would be at no surface.
template <class Pixel>
ordered_json image_json(int width_px, int height_px, int channels, const Pixel& byte_at) {
  const auto skip = static_cast<int>((width_px + kMostSeenWidth_px - 1) / kMostSeenWidth_px);
  std::vector<std::uint8_t> bytes;
  int rows = 0, columns = 0;
  for (int y = skip / 2; y < height_px; y += skip, ++rows) {
    columns = 0;
    for (int x = skip / 2; x < width_px; x += skip, ++columns) {
      for (int c = 0; c < channels; ++c) {
        bytes.push_back(byte_at((static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                                 static_cast<std::size_t>(x)) *
                                    static_cast<std::size_t>(channels) +
                                static_cast<std::size_t>(c)));
      }
    }
  }
  Packed packed;
  packed.add_bytes(bytes);
  return {{"width", columns},
          {"height", rows},
          {"skip", skip},
          {"channels", channels},
          {"data", packed.text()}};
}

/// Corners evenly out of too many; a line keeps its last one.
std::vector<std::size_t> thinned(std::size_t count, bool in_pairs) {
  std::vector<std::size_t> kept;
  const std::size_t units = in_pairs ? count / 2 : count;
  const std::size_t most = in_pairs ? kMostDrawnCorners / 2 : kMostDrawnCorners;
  const std::size_t skip = units <= most ? 1 : (units + most - 1) / most;
  for (std::size_t i = 0; i < units; i += skip) {
    if (in_pairs) {
      kept.insert(kept.end(), {2 * i, 2 * i + 1});
    } else {
      kept.push_back(i);
    }
  }
  if (!in_pairs && !kept.empty() && kept.back() + 1 != count) kept.push_back(count - 1);
  return kept;
}

constexpr std::string_view kDrawingTexts[] = {"points", "line", "segments", "text"};

ordered_json drawing_json(const Drawing& drawing) {
  const bool in_pairs = drawing.kind == DrawingKind::segments;
  std::array<std::vector<std::int64_t>, 3> axes;
  const std::vector<std::size_t> kept = thinned(drawing.points_world.size(), in_pairs);
  for (const std::size_t i : kept) {
    for (std::size_t k = 0; k < 3; ++k) {
      axes[k].push_back(
          steps(drawing.points_world[i][static_cast<Eigen::Index>(k)], kPagePositionStep_m));
    }
  }
  Packed packed;
  for (const auto& axis : axes) packed.add_deltas(axis);
  return {{"kind", kDrawingTexts[static_cast<std::size_t>(drawing.kind)]},
          {"color", drawing.color_rgb & 0xffffffU},
          {"label", drawing.label},
          {"n", kept.size()},
          {"data", packed.text()}};
}

/// Commanded speed, acceleration and thrust, NaN where this kind of command has none.
struct Wanted {
  double speed_mps = std::nan(""), acceleration_mps2 = std::nan(""), thrust_mps2 = std::nan("");
};

Wanted wanted_of(const PlanResult& result) {
  Wanted wanted;
  if (result.status != PlanStatus::command) return wanted;
  if (!result.points.empty()) {
    wanted.speed_mps = norm_of(result.points.front().velocity_world_mps);
    wanted.acceleration_mps2 = norm_of(result.points.front().acceleration_world_mps2);
  } else if (result.command.kind == AB_COMMAND_VELOCITY) {
    wanted.speed_mps = norm_of(result.command.velocity_world_mps);
  } else if (result.command.kind == AB_COMMAND_ACCELERATION) {
    wanted.acceleration_mps2 = norm_of(result.command.acceleration_world_mps2);
  } else if (result.command.kind == AB_COMMAND_RATES) {
    wanted.thrust_mps2 = result.command.thrust_mps2;
  }
  return wanted;
}

ordered_json flight_head(const StoredTrial& stored, const TrialListing& listing) {
  const TrialRecord& record = stored.row.record;
  return {{"id", listing.id},
          {"key", listing.key.substr(0, 12)},
          {"planner", listing.planner_label},
          {"outcome", text(record.outcome)},
          {"reason", record.reason},
          {"end_s", listing.end_time_s}};
}

ordered_json one_flight(const StoredTrial& stored, const TrialListing& listing,
                        const TrialRecord& record, PageScenes& scenes) {
  ordered_json flight = flight_json(record, kAllSamples_hz);
  flight["head"] = flight_head(stored, listing);
  scenes.place(stored, 0, flight);
  return flight;
}

/// Whether two trials are of one mission, whatever flew it.
bool is_beside(const TrialRow& one, const TrialRow& other) {
  return one.key != other.key && one.map_key == other.map_key &&
         one.mission_index == other.mission_index;
}

}  // namespace

std::uint8_t depth_byte(double depth_m, double nearest_m, double farthest_m) {
  if (std::isnan(depth_m)) return 0;
  if (depth_m > farthest_m) return 255;
  const double share =
      math::log(std::max(depth_m, nearest_m) / nearest_m) / math::log(farthest_m / nearest_m);
  return static_cast<std::uint8_t>(1.0 + std::round(kLevels * std::clamp(share, 0.0, 1.0)));
}

double depth_of_byte(std::uint8_t byte, double nearest_m, double farthest_m) {
  if (byte == 0) return std::nan("");
  if (byte == 255) return std::numeric_limits<double>::infinity();
  return nearest_m * math::pow(farthest_m / nearest_m, (byte - 1) / kLevels);
}

SeenRecorder::SeenRecorder(const TrialSpec& spec) : cameras_(rig_cameras(seen_sensor(spec))) {}

bool SeenRecorder::is_due(double time_s) {
  if (time_s < next_s_ - 1e-6) return false;
  next_s_ = time_s + 1.0 / kSeen_hz;
  return images_.size() < kMostSeenImages;
}

void SeenRecorder::see(const PlannerView& view) {
  std::vector<bool> is_shown(cameras_.size(), false);
  // Newest first: of each camera that one.
  const auto take = [&](const auto& images, int channels, std::string_view kind,
                        const auto& pixels_of) {
    for (const auto& image : images) {
      if (image.camera >= cameras_.size() || is_shown[image.camera]) continue;
      is_shown[image.camera] = true;
      const CameraSpec& camera = cameras_[image.camera].kind;
      ordered_json json =
          image_json(static_cast<int>(camera.width_px), static_cast<int>(camera.height_px),
                     channels, pixels_of(image, camera));
      json["kind"] = kind;
      json["t"] = image.time_s;
      json["camera"] = image.camera;
      json["pose"] = pose_json(image.T_world_camera);
      images_.push_back(std::move(json));
    }
  };
  take(view.depth, 1, "depth", [](const auto& image, const CameraSpec& camera) {
    const double nearest_m = std::max(camera.min_range_m, 0.05);
    return [&image, nearest_m, farthest_m = camera.max_range_m](std::size_t i) {
      return depth_byte(static_cast<double>(image.depth_m[i]), nearest_m, farthest_m);
    };
  });
  take(view.stereo, 1, "grey", [](const auto& image, const CameraSpec&) {
    return [&image](std::size_t i) { return image.left[i]; };
  });
  take(view.color, 3, "color", [](const auto& image, const CameraSpec&) {
    return [&image](std::size_t i) { return image.rgb[i]; };
  });
}

void SeenRecorder::planned(const PlanStep& step) {
  const Wanted wanted = wanted_of(step.result);
  times_s_.push_back(step.time_s);
  cpu_ms_.push_back(1000.0 * step.result.cpu_time_s);
  speeds_mps_.push_back(wanted.speed_mps);
  accelerations_mps2_.push_back(wanted.acceleration_mps2);
  thrusts_mps2_.push_back(wanted.thrust_mps2);
  statuses_.push_back(static_cast<std::int64_t>(step.result.status));
  for (const std::string& line : step.log) log_.push_back({{"t", step.time_s}, {"text", line}});
  points_.see(step.view);
  if (!is_due(step.time_s)) return;
  see(step.view);
  if (step.drawings.empty() && points_.drawings().empty()) return;
  ordered_json drawn = ordered_json::array();
  for (const Drawing& drawing : points_.drawings()) drawn.push_back(drawing_json(drawing));
  for (const Drawing& drawing : step.drawings) drawn.push_back(drawing_json(drawing));
  drawings_.push_back({{"t", step.time_s}, {"drawings", std::move(drawn)}});
}

ordered_json SeenRecorder::json() const {
  return {{"images", images_},
          {"drawings", drawings_},
          {"log", log_},
          {"calls",
           {{"n", times_s_.size()},
            {"t", packed_floats(times_s_)},
            {"speed", packed_floats(speeds_mps_)},
            {"acceleration", packed_floats(accelerations_mps2_)},
            {"thrust", packed_floats(thrusts_mps2_)},
            {"status", packed_deltas(statuses_)},
            {"cpu_ms", packed_floats(cpu_ms_)}}}};
}

ordered_json flight_page(const Database& database, const StoredTrial& stored, const World& world,
                         const TrialRecord& flown, const ordered_json& seen,
                         const TrialListing& listing, const std::string& title,
                         const PageOrigin& origin) {
  ordered_json page = page_start("flight", title, origin);
  PageScenes scenes;
  scenes.add_world(world);
  ordered_json flights = ordered_json::array();
  StoredTrial shown = stored;
  shown.row.record.outcome = flown.outcome;
  shown.row.record.reason = flown.reason;
  flights.push_back(one_flight(shown, listing, flown, scenes));
  for (const TrialListing& other : database.list_trials()) {
    if (other.mission_index != listing.mission_index || other.map_seed != listing.map_seed)
      continue;
    try {
      const StoredTrial beside = read_stored_trial(database, other.key);
      if (!is_beside(beside.row, stored.row) || beside.row.record.samples.empty()) continue;
      flights.push_back(one_flight(beside, other, beside.row.record, scenes));
    } catch (const InputError& error) {
      scenes.warnings.push_back(std::string("a flight is not shown: ") + error.what());
    }
  }
  page["flights"] = std::move(flights);
  page["seen"] = seen;
  page["world_digest"] = world.digest;
  page["planner_digest"] = stored.row.planner_file_digest;
  add_scenes(std::move(scenes), page);
  return page;
}

}  // namespace avoidbench
