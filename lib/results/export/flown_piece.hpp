#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plugin/planner_instance.hpp"
#include "worker/worker.hpp"

/// What a planner sees and commands, which is not stored, as it comes from the worker that flies a
/// trial again: in pieces, so that nobody holds a whole flight's images.
namespace avoidbench {

enum class PictureKind : std::uint8_t { depth, left, right, color };

/// An image of one camera.
struct SeenPicture {
  PictureKind kind = PictureKind::depth;
  std::uint32_t camera = 0;  ///< index into PlannerSetup::cameras
  double time_s = 0.0;
  /// height × width pixels, row-major: float32 depth along camera z, m (+inf: no return, NaN:
  /// invalid), one byte of grey, or three of red, green and blue.
  std::vector<std::uint8_t> bytes;
};

/// A sweep of one lidar; its points as CloudView has them.
struct SeenCloud {
  std::uint32_t lidar = 0;  ///< index into PlannerSetup::lidars
  double time_s = 0.0;      ///< of the sweep's end
  std::vector<ab_lidar_point> points;
};

struct SeenImu {
  double time_s = 0.0;
  Eigen::Vector3d rates_body, specific_force_body_mps2;
};

enum class PieceKind : std::uint8_t { view, answer };

/// Half a call of the planner: what it is about to see, or what it answered.
struct FlownPiece {
  std::uint64_t number = 0;  ///< of the flight; 0: it begins
  double time_s = 0.0;       ///< of the call
  PieceKind kind = PieceKind::view;
  // Of what it sees, oldest first:
  std::vector<SeenPicture> pictures;
  std::vector<SeenCloud> clouds;
  std::vector<SeenImu> imu;
  StateView state{.time_s = 0.0,
                  .position_world = Eigen::Vector3d::Zero(),
                  .velocity_world = Eigen::Vector3d::Zero(),
                  .rates_body = Eigen::Vector3d::Zero(),
                  .q_world_body = Eigen::Quaterniond::Identity()};  ///< as the odometry says it
  // Of its answer:
  double effect_s = 0.0;  ///< when its command takes effect
  PlanStatus status = PlanStatus::no_plan;
  ab_command command{};  ///< of PlanStatus::command
  std::vector<ab_point> points;
  std::vector<std::string> log;  ///< lines since the last answer
};

/// The lookout that sends them, and its name for run_worker().
inline constexpr const char* kPiecesLookout = "pieces";
Lookout pieces_lookout(const Job& job, const World& world);

/// To be set as Job::lookout of a flight by this spec.
LookoutJob pieces_job(const TrialSpec& spec);

/// What a worker sent. Its planner shares the worker's memory: throws InputError unless all numbers
/// are what they can be in a flight by this spec, and all sizes those of its sensors.
FlownPiece flown_piece_from(const Message& message, const TrialSpec& spec,
                            const PlannerSetup& setup);

}  // namespace avoidbench
