#include "export/flown_piece.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "trial/planner_view.hpp"
#include "trial/trial_observer.hpp"
#include "worker/byte_transfer.hpp"

namespace avoidbench {

template <class Io, ConstOr<SeenPicture> T>
void transfer(Io& io, T& picture) {
  transfer_enum(io, picture.kind, PictureKind::color);
  all(io, picture.camera, picture.time_s, picture.bytes);
}

template <class Io, ConstOr<SeenCloud> T>
void transfer(Io& io, T& cloud) {
  all(io, cloud.lidar, cloud.time_s, cloud.points);
}

template <class Io, ConstOr<SeenImu> T>
void transfer(Io& io, T& sample) {
  all(io, sample.time_s, sample.rates_body, sample.specific_force_body_mps2);
}

template <class Io, ConstOr<StateView> T>
void transfer(Io& io, T& state) {
  all(io, state.time_s, state.position_world, state.velocity_world, state.rates_body);
  for (int i = 0; i < 4; ++i) io(state.q_world_body.coeffs()[i]);
}

template <class Io>
void transfer(Io& io, std::string& line) {
  io(line);
}
template <class Io>
void transfer(Io& io, const std::string& line) {
  io(line);
}

template <class Io, ConstOr<FlownPiece> T>
void transfer(Io& io, T& piece) {
  all(io, piece.number, piece.time_s);
  transfer_enum(io, piece.kind, PieceKind::answer);
  all(io, piece.pictures, piece.clouds, piece.imu);
  transfer(io, piece.state);
  io(piece.effect_s);
  transfer_enum(io, piece.status, PlanStatus::error);
  transfer_command(io, piece.command);
  all(io, piece.points, piece.log);
}

namespace {

/// More of a flight's log than this, in bytes, is left out.
constexpr std::size_t kMostLogBytes = std::size_t{32} << 20U;

template <class Pixel>
void add_picture(PictureKind kind, std::uint32_t camera, double time_s,
                 std::span<const Pixel> pixels, FlownPiece& piece) {
  const auto bytes = std::as_bytes(pixels);
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
  piece.pictures.push_back({kind, camera, time_s, {begin, begin + bytes.size()}});
}

/// Makes the pieces of one flight.
struct PieceMaker {
  FlownPiece piece;  ///< that is taken next
  bool is_due = false;
  std::uint64_t count = 0;
  std::size_t log_bytes = 0;
  std::vector<std::string> log;  ///< of before the first call

  void begin(double time_s, PieceKind kind) {
    piece = FlownPiece{};
    piece.number = count++;
    piece.time_s = time_s;
    piece.kind = kind;
    is_due = true;
  }

  void planning(double time_s, const PlannerView& view) {
    begin(time_s, PieceKind::view);
    piece.state = view;
    for (const DepthView& seen : view.depth) {
      add_picture(PictureKind::depth, seen.camera, seen.time_s, seen.depth_m, piece);
    }
    for (const StereoView& seen : view.stereo) {
      add_picture(PictureKind::left, seen.camera, seen.time_s, seen.left, piece);
      add_picture(PictureKind::right, seen.camera, seen.time_s, seen.right, piece);
    }
    for (const ColorView& seen : view.color) {
      add_picture(PictureKind::color, seen.camera, seen.time_s, seen.rgb, piece);
    }
    for (const CloudView& seen : view.clouds) {
      piece.clouds.push_back({seen.lidar, seen.time_s, {seen.points.begin(), seen.points.end()}});
    }
    for (const ImuView& seen : view.imu) {
      piece.imu.push_back({seen.time_s, seen.rates_body, seen.specific_force_body_mps2});
    }
    std::reverse(piece.pictures.begin(), piece.pictures.end());  // views have the newest first
    std::reverse(piece.clouds.begin(), piece.clouds.end());
  }

  void planned(const PlanStep& step) {
    begin(step.time_s, PieceKind::answer);
    piece.effect_s = step.effect_s;
    piece.status = step.result.status;
    piece.command = step.result.command;
    piece.points = step.result.points;
    add_log(std::exchange(log, {}));
    add_log(step.log);
  }

  void add_log(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      const bool had_room = log_bytes < kMostLogBytes;
      log_bytes += line.size();
      if (log_bytes < kMostLogBytes) {
        piece.log.push_back(line);
      } else if (had_room) {
        piece.log.emplace_back("(the rest of the log is left out: it is too long)");
      }
    }
  }

  std::optional<Message> take() {
    if (!std::exchange(is_due, false)) return std::nullopt;
    TransferWriter writer;
    transfer(writer, std::as_const(piece));
    return Message{.json = nlohmann::json::object(), .bytes = writer.take()};
  }
};

std::size_t pixel_bytes(PictureKind kind) {
  switch (kind) {
    case PictureKind::depth:
      return sizeof(float);
    case PictureKind::color:
      return 3;
    default:
      return 1;
  }
}

void check_picture(const SeenPicture& picture, double call_s, const PlannerSetup& setup) {
  TransferReader::require(picture.camera < setup.cameras.size());
  const CameraSetup& camera = setup.cameras[picture.camera];
  const std::size_t pixels =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  TransferReader::require(picture.bytes.size() == pixels * pixel_bytes(picture.kind));
  TransferReader::require(picture.time_s >= 0.0 && picture.time_s <= call_s);
}

}  // namespace

Lookout pieces_lookout(const Job&, const World&) {
  const auto maker = std::make_shared<PieceMaker>();
  Lookout lookout;
  lookout.logged = [maker](const std::vector<std::string>& lines) { maker->log = lines; };
  lookout.observer.planning = [maker](const PlanCallAhead& call) {
    maker->planning(call.time_s, call.view);
    return true;
  };
  lookout.observer.planned = [maker](const PlanStep& step) { maker->planned(step); };
  lookout.take_piece = [maker] { return maker->take(); };
  lookout.report = [](const TrialRecord*) {
    return Message{.json = nlohmann::json::object(), .bytes = {}};
  };
  return lookout;
}

LookoutJob pieces_job(const TrialSpec& spec) {
  // What a call may see: images and sweeps since the last one. Memory is taken for what comes.
  constexpr double kPixelBytes = 6.0;           // depth, and a grey pair; or depth and color
  constexpr double kRest = 96.0 * 1024 * 1024;  // log, IMU samples, a trajectory's points
  double bytes = kRest;
  const double period_s = 1.0 / spec.rates.plan_hz;
  const auto most_new = [period_s](double rate_hz) { return std::ceil(rate_hz * period_s) + 2.0; };
  for (const RigCamera& camera : rig_cameras(spec.sensor)) {
    bytes += kPixelBytes * most_new(camera.kind.rate_hz) *
             static_cast<double>(camera.kind.width_px * camera.kind.height_px);
  }
  const std::vector<LidarSetup> lidars = planner_setup(spec).lidars;
  for (const LidarSetup& lidar : lidars) {
    bytes += most_new(lidar.rate_hz) * lidar.shots * sizeof(ab_lidar_point);
  }
  return {.kind = kPiecesLookout,
          .wanted = {.json = nlohmann::json::object(), .bytes = {}},
          .most_bytes = static_cast<std::size_t>(bytes),
          .has_flight = true,
          .has_pieces = true};
}

FlownPiece flown_piece_from(const Message& message, const TrialSpec& spec,
                            const PlannerSetup& setup) {
  FlownPiece piece;
  TransferReader reader(message.bytes);
  transfer(reader, piece);
  reader.finish();
  const double latest_s = spec.mission.time_limit_s + 1.0;
  TransferReader::require(piece.time_s >= 0.0 && piece.time_s <= latest_s);
  TransferReader::require(piece.state.time_s >= 0.0 && piece.state.time_s <= piece.time_s);
  TransferReader::require(std::isfinite(piece.state.q_world_body.coeffs().sum()));
  for (const SeenPicture& picture : piece.pictures) check_picture(picture, piece.time_s, setup);
  for (const SeenCloud& cloud : piece.clouds) {
    TransferReader::require(cloud.lidar < setup.lidars.size() &&
                            cloud.points.size() <= setup.lidars[cloud.lidar].shots);
    TransferReader::require(cloud.time_s >= 0.0 && cloud.time_s <= piece.time_s);
  }
  for (const SeenImu& sample : piece.imu) {
    TransferReader::require(sample.time_s >= 0.0 && sample.time_s <= piece.time_s);
  }
  constexpr double kMostEffect_s = 3600.0;
  TransferReader::require(piece.effect_s >= 0.0 && piece.effect_s <= latest_s + kMostEffect_s);
  for (const ab_point& point : piece.points) {
    TransferReader::require(point.time_s >= 0.0 && point.time_s <= 1e6);
  }
  return piece;
}

}  // namespace avoidbench
