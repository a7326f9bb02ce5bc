#include "page/flight_recording.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "page/flight_page.hpp"
#include "worker/byte_transfer.hpp"

namespace avoidbench {

template <class Visitor, ConstOr<RecordingWanted> W>
void visit(Visitor& v, W& w) {
  v.field("has_calls", w.has_calls);
  v.field("has_moments", w.has_moments);
  v.field("has_page", w.has_page);
  v.field("at_s", w.at_s);
  v.field("every_s", w.every_s);
  v.field("most_calls", w.most_calls);
}

void check(const TransferWriter&, const SeenImage&) {}
void check(const TransferReader&, const SeenImage& image) {
  constexpr int kMostPixels = 1 << 16;
  const bool is_sized = image.width_px >= 0 && image.width_px <= kMostPixels &&
                        image.height_px >= 0 && image.height_px <= kMostPixels;
  TransferReader::require(is_sized);
  const auto pixels =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  const bool is_depth = image.depth_m.size() == pixels && image.bytes.empty();
  const bool is_light =
      image.depth_m.empty() && (image.bytes.size() == pixels || image.bytes.size() == 3 * pixels);
  TransferReader::require(is_depth || is_light);
}

template <class Io, ConstOr<Eigen::Vector3d> T>
void transfer(Io& io, T& place) {
  io(place);
}

template <class Io, ConstOr<LogLine> T>
void transfer(Io& io, T& line) {
  all(io, line.time_s, line.text);
}

template <class Io, ConstOr<CommandLine> T>
void transfer(Io& io, T& call) {
  all(io, call.time_s, call.effect_s, call.cpu_time_s);
  transfer_enum(io, call.status, PlanStatus::error);
  transfer_command(io, call.command);
  io(call.points);
}

template <class Io, ConstOr<Drawing> T>
void transfer(Io& io, T& drawing) {
  transfer_enum(io, drawing.kind, DrawingKind::text);
  all(io, drawing.color_rgb, drawing.label, drawing.size_px, drawing.points_world);
}

template <class Io, ConstOr<SeenImage> T>
void transfer(Io& io, T& image) {
  all(io, image.time_s, image.width_px, image.height_px, image.depth_m, image.bytes);
  check(io, image);
}

/// Of what the vehicle believed, the place and attitude: more is not drawn.
template <class Io, ConstOr<Moment> T>
void transfer(Io& io, T& moment) {
  auto& believed = moment.believed;
  all(io, moment.time_s, moment.call_s, believed.position_world, believed.velocity_world,
      believed.rates_body);
  for (int i = 0; i < 4; ++i) io(believed.q_world_body.coeffs()[i]);
  transfer_enum(io, moment.result.status, PlanStatus::error);
  io(moment.result.reason);
  transfer_command(io, moment.result.command);
  all(io, moment.result.points, moment.result.cpu_time_s, moment.drawings, moment.images);
}

namespace {

/// More lines of a log than these, by their bytes, are left out.
constexpr std::size_t kMostLogBytes = std::size_t{32} << 20U;

/// The recorders of one flight.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct Recorders {
  FlightRecording recording;
  std::optional<MomentRecorder> moments;
  std::optional<SeenRecorder> seen;
  std::size_t call_count = 0, log_bytes = 0;
  bool has_calls = false;

  void add_line(double time_s, const std::string& text) {
    const bool had_room = log_bytes < kMostLogBytes;
    log_bytes += text.size();
    if (log_bytes < kMostLogBytes) {
      recording.log.push_back({time_s, text});
    } else if (had_room) {
      recording.log.push_back({time_s, "(the rest of the log is left out: it is too long)"});
    }
  }

  void planned(const PlanStep& step) {
    ++call_count;
    for (const std::string& line : step.log) add_line(step.time_s, line);
    if (has_calls) recording.calls.push_back(command_line(step));
    if (moments) moments->planned(step);
    if (seen) seen->planned(step);
  }

  Message report(const TrialRecord& flown) {
    if (moments) recording.moments = moments->finish(flown.end_time_s);
    TransferWriter writer;
    writer(recording.log);
    writer(recording.calls);
    writer(recording.moments);
    writer(seen ? seen->json().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                : std::string("null"));
    return {.json = nlohmann::json::object(), .bytes = writer.take()};
  }
};

}  // namespace

Lookout recording_lookout(const Job& job, const World&) {
  const auto wanted = spec_from_json<RecordingWanted>(job.lookout->wanted.json, true);
  const auto recorders = std::make_shared<Recorders>();
  recorders->has_calls = wanted.has_calls;
  if (wanted.has_moments) recorders->moments.emplace(wanted.at_s, wanted.every_s, job.spec);
  if (wanted.has_page) recorders->seen.emplace(job.spec);
  Lookout lookout;
  lookout.wants_drawings = true;
  lookout.logged = [recorders](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) recorders->add_line(std::nan(""), line);
  };
  lookout.observer.planned = [recorders](const PlanStep& step) { recorders->planned(step); };
  lookout.observer.planning = [recorders,
                               most_calls = wanted.most_calls](const PlanCallAhead& call) {
    if (!most_calls || recorders->call_count < *most_calls) return true;
    if (recorders->moments) recorders->moments->planning(call);
    return false;
  };
  lookout.report = [recorders](const TrialRecord* flown) { return recorders->report(*flown); };
  return lookout;
}

LookoutJob recording_job(RecordingWanted wanted, const TrialSpec& spec) {
  // Of a flight without an end the end is shown.
  std::erase_if(wanted.at_s, [](double at_s) { return !std::isfinite(at_s); });
  // Memory is taken for what comes, not for this.
  constexpr double kRest = 256.0 * 1024 * 1024;    // log, calls, what a page shows
  constexpr double kDrawings = 8.0 * 1024 * 1024;  // of one call: kMostDrawnPoints
  constexpr double kPixelBytes = 4.0, kMostMoments = 2000.0;
  double bytes = kRest;
  if (wanted.has_moments) {
    double pixels = 0.0;
    for (const RigCamera& camera : rig_cameras(spec.sensor)) {
      pixels += static_cast<double>(camera.kind.width_px * camera.kind.height_px);
    }
    const double spaced =
        wanted.every_s > 0.0 ? spec.mission.time_limit_s / wanted.every_s + 2.0 : 1.0;
    const double moments = std::min(kMostMoments, static_cast<double>(wanted.at_s.size()) + spaced);
    bytes += moments * (kDrawings + kPixelBytes * pixels);
  }
  return {.kind = kRecordingLookout,
          .wanted = {.json = spec_to_json(wanted), .bytes = {}},
          .most_bytes = static_cast<std::size_t>(bytes),
          .has_flight = true};
}

FlightRecording recording_from(const Message& reported) {
  TransferReader reader(reported.bytes);
  FlightRecording recording;
  std::string seen;
  reader(recording.log);
  reader(recording.calls);
  reader(recording.moments);
  reader(seen);
  reader.finish();
  recording.seen = nlohmann::ordered_json::parse(seen, nullptr, false);
  TransferReader::require(!recording.seen.is_discarded());
  return recording;
}

}  // namespace avoidbench
