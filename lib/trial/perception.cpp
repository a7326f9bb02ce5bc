#include "trial/perception.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "trial/noise_seed.hpp"
#include "trial/periods.hpp"

namespace avoidbench {
namespace {

CameraMotion motion_of(const VehicleState& truth, const Pose& T_body_camera) {
  const Eigen::Matrix3d R_world_body = truth.q_world_body.toRotationMatrix();
  CameraMotion motion;
  motion.rates_world_radps = R_world_body * truth.rates_body;
  const Eigen::Vector3d arm = R_world_body * T_body_camera.translation();
  // A camera off the centre of gravity moves with the body's turning, too.
  motion.velocity_world = truth.velocity_world + motion.rates_world_radps.cross(arm);
  return motion;
}

/// Exposes every camera and says when the next exposure is.
void expose(Perception& p, const Scene& scene, const VehicleState& truth) {
  const Pose T_world_body = pose_of(truth);
  const Pose T_believed_body = pose_of(believed_state(p, truth));
  const bool is_seen = p.image_needs.depth || p.image_needs.stereo || p.image_needs.color;
  for (std::size_t i = 0; is_seen && i < p.T_body_cameras.size(); ++i) {
    if (p.exposure_count == p.exposures.size()) p.exposures.emplace_back();
    Exposure& exposure = p.exposures[p.exposure_count++];
    exposure.tick = truth.tick;
    exposure.ready = truth.tick + p.image_delay;
    exposure.camera = static_cast<std::uint32_t>(i);
    exposure.T_world_camera = T_believed_body * p.T_body_cameras[i];
    const std::uint64_t seed =
        // By number, not drawn one after the other: an image's noise does not depend on which
        // images were asked for before.
        stream_seed(stream_seed(p.image_seed, static_cast<std::uint64_t>(p.image_index)), i);
    p.camera.expose(scene, T_world_body * p.T_body_cameras[i],
                    motion_of(truth, p.T_body_cameras[i]), p.image_needs, seed, exposure.images);
  }
  ++p.image_index;
  p.next_exposure = p.image_index * p.camera_period;
  if (p.most_jitter > 0) {
    p.next_exposure +=
        static_cast<Tick>(p.jitter_random.below(static_cast<std::uint64_t>(p.most_jitter) + 1));
  }
}

/// Whether the planner's state of a later plan tick is that of `tick`.
bool is_state_tick(const Perception& p, Tick tick) {
  return (tick + p.state_delay) % p.plan_period == 0;
}

}  // namespace

Perception make_perception(const TrialSpec& spec, std::uint32_t needs, const VehicleState& start) {
  const std::uint64_t seed = noise_seed(spec, "sensing");
  Perception p{.sensor = spec.sensor,
               .image_needs = {.depth = (needs & AB_SEES_DEPTH) != 0,
                               .stereo = (needs & AB_SEES_STEREO) != 0,
                               .color = (needs & AB_SEES_COLOR) != 0},
               .camera = Camera(spec.sensor),
               .T_body_cameras = {},
               .camera_period = required_period(spec.sensor.rate_hz),
               .image_delay = ticks(1e-3 * spec.sensor.delay_ms),
               .most_jitter = ticks(1e-3 * spec.sensor.jitter_ms),
               .image_seed = stream_seed(seed, "image"),
               .jitter_random = stream(seed, "jitter"),
               .exposures = {},
               .imu = spec.imu,
               .sees_imu = (needs & AB_SEES_IMU) != 0,
               .imu_period = required_period(spec.imu.rate_hz),
               .imu_state = {},
               .imu_random = stream(seed, "imu"),
               .imu_samples = {},
               .odometry = spec.odometry,
               .is_perfect = is_perfect(spec.odometry),
               .odometry_period = required_period(spec.odometry.rate_hz),
               .state_delay = ticks(1e-3 * spec.odometry.delay_ms),
               .plan_period = required_period(spec.rates.plan_hz),
               .odometry_state = {},
               .odometry_random = stream(seed, "odometry"),
               .past = {}};
  AB_CHECK(p.most_jitter < p.camera_period, p.most_jitter, p.camera_period);
  for (const MountingSpec& mounting : mountings(spec.sensor)) {
    p.T_body_cameras.push_back(T_body_camera(mounting));
  }
  p.imu_state = make_imu(p.imu, p.imu_random);
  p.odometry_state = make_odometry(p.odometry, start, p.odometry_random);
  p.past.push_back(believed_state(p, start));
  return p;
}

Tick next_sensing(const Perception& p, Tick now) {
  const auto after = [now](Tick period) { return (now / period + 1) * period; };
  Tick next = std::min(p.next_exposure > now ? p.next_exposure : now + 1, after(p.imu_period));
  // Without noise and delay the state is the truth at any tick, and flights need no ticks of
  // odometry.
  if (p.is_perfect) return next;
  next = std::min(next, after(p.odometry_period));
  return std::min(next,
                  ((now + p.state_delay) / p.plan_period + 1) * p.plan_period - p.state_delay);
}

void sense(Perception& p, const Scene& scene, const VehicleModel& model, const VehicleState& truth,
           const Environment& environment) {
  if (!p.is_perfect) {
    if (truth.tick > 0 && truth.tick % p.odometry_period == 0) {
      advance(p.odometry_state, p.odometry, truth, seconds(p.odometry_period), p.odometry_random);
    }
    if (truth.tick > 0 && is_state_tick(p, truth.tick)) p.past.push_back(believed_state(p, truth));
  }
  if (p.sees_imu && truth.tick % p.imu_period == 0) {
    p.imu_samples.push_back(sense_imu(p.imu, p.imu_state, model, truth, environment,
                                      seconds(p.imu_period), p.imu_random));
  }
  if (truth.tick == p.next_exposure) expose(p, scene, truth);
}

VehicleState believed_state(const Perception& p, const VehicleState& truth) {
  return p.is_perfect ? truth : estimated(p.odometry_state, truth);
}

PlannerView planner_view(Perception& p, const VehicleState& truth) {
  // The newest state that is as old as the delay.
  while (p.past.size() > 1 && p.past[1].tick <= truth.tick - p.state_delay) p.past.pop_front();
  const VehicleState& state = p.is_perfect ? truth : p.past.front();
  PlannerView view{.time_s = seconds(state.tick),
                   .position_world = state.position_world,
                   .velocity_world = state.velocity_world,
                   .rates_body = state.rates_body,
                   .q_world_body = state.q_world_body,
                   .depth = {},
                   .stereo = {},
                   .color = {},
                   .imu = {}};
  for (std::size_t i = p.exposure_count; i-- > 0;) {  // newest first
    const Exposure& seen = p.exposures[i];
    if (seen.ready > truth.tick) continue;
    const double time_s = seconds(seen.tick);
    const CameraImages& images = seen.images;
    if (p.image_needs.depth) {
      view.depth.push_back({time_s, seen.T_world_camera, seen.camera, images.depth_m});
    }
    if (p.image_needs.stereo) {
      view.stereo.push_back({time_s, seen.T_world_camera, seen.camera, images.left, images.right});
    }
    if (p.image_needs.color) {
      view.color.push_back({time_s, seen.T_world_camera, seen.camera, images.color});
    }
  }
  for (const ImuSample& sample : p.imu_samples) {
    view.imu.push_back(
        {seconds(sample.tick), sample.rates_body_radps, sample.specific_force_body_mps2});
  }
  return view;
}

void forget_images(Perception& p, Tick tick) {
  const auto first = p.exposures.begin();
  const auto last = first + static_cast<std::ptrdiff_t>(p.exposure_count);
  const auto unseen = std::find_if(first, last, [tick](const auto& e) { return e.ready > tick; });
  p.exposure_count = static_cast<std::size_t>(last - unseen);
  std::rotate(first, unseen, last);  // the seen ones' buffers are used again
}

void forget_seen(Perception& p, Tick now) {
  forget_images(p, now);
  p.imu_samples.clear();
}

}  // namespace avoidbench
