#include "trial/perception.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "base/random.hpp"
#include "trial/noise_seed.hpp"
#include "trial/periods.hpp"
#include "trial/planner_view.hpp"

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

/// Exposes every camera of a kind and says when its next exposure is.
void expose(Perception& p, CameraGroup& group, const Scene& scene, const VehicleState& truth) {
  const Pose T_world_body = pose_of(truth);
  // The image is exposed at the true pose and told with the believed one.
  const Pose T_believed_body = pose_of(believed_state(p, truth));
  // An image that nobody asks for is not made; the next exposure is drawn all the same.
  const bool is_seen = p.image_needs.depth || p.image_needs.stereo || p.image_needs.color;
  for (std::size_t i = 0; is_seen && i < group.T_body_cameras.size(); ++i) {
    // Buffers of images that were seen are used again.
    if (p.exposure_count == p.exposures.size()) p.exposures.emplace_back();
    Exposure& exposure = p.exposures[p.exposure_count++];
    exposure.tick = truth.tick;
    exposure.ready = truth.tick + group.delay;
    exposure.camera = group.first_camera + static_cast<std::uint32_t>(i);
    exposure.T_world_camera = T_believed_body * group.T_body_cameras[i];
    const std::uint64_t seed =
        // By number, not drawn one after the other: an image's noise does not depend on which
        // images were asked for before.
        stream_seed(stream_seed(p.image_seed, static_cast<std::uint64_t>(group.image_index)),
                    std::uint64_t{exposure.camera});
    group.camera.expose(scene, T_world_body * group.T_body_cameras[i],
                        motion_of(truth, group.T_body_cameras[i]), p.image_needs, seed,
                        exposure.images);
  }
  ++group.image_index;
  group.next_exposure = group.image_index * group.period;
  // Jitter is drawn by itself for each image and does not add up.
  if (group.most_jitter > 0) {
    group.next_exposure += static_cast<Tick>(
        group.jitter_random.below(static_cast<std::uint64_t>(group.most_jitter) + 1));
  }
}

/// The rig's cameras by their kinds.
std::vector<CameraGroup> make_cameras(const SensorSpec& sensor, std::uint64_t seed) {
  std::vector<CameraGroup> groups;
  std::uint32_t first_camera = 0;
  const std::uint64_t jitter_seed = stream_seed(seed, "jitter");
  for (const CameraSpec& kind : camera_kinds(sensor)) {
    // The first kind has the stream that it had before there were others.
    const std::uint64_t own_seed =
        groups.empty() ? jitter_seed : stream_seed(jitter_seed, std::uint64_t{first_camera});
    CameraGroup group{.camera = Camera(kind),
                      .first_camera = first_camera,
                      .T_body_cameras = {},
                      .period = required_period(kind.rate_hz),
                      .delay = ticks(1e-3 * kind.delay_ms),
                      .most_jitter = ticks(1e-3 * kind.jitter_ms),
                      .jitter_random = RandomStream(own_seed)};
    AB_CHECK(group.most_jitter < group.period, group.most_jitter, group.period);
    for (const MountingSpec& mounting : mountings(kind)) {
      group.T_body_cameras.push_back(T_body_camera(mounting));
    }
    first_camera += static_cast<std::uint32_t>(group.T_body_cameras.size());
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Whether the planner's state of a later plan tick is that of `tick`.
bool is_state_tick(const Perception& p, Tick tick) {
  return (tick + p.state_delay) % p.plan_period == 0;
}

StateView state_view(const VehicleState& state) {
  return {.time_s = seconds(state.tick),
          .position_world = state.position_world,
          .velocity_world = state.velocity_world,
          .rates_body = state.rates_body,
          .q_world_body = state.q_world_body};
}

/// Whether the odometry's delay is over.
bool is_told(const Perception& p, const VehicleState& past, Tick now) {
  return past.tick <= now - p.state_delay;
}

}  // namespace

Perception make_perception(const TrialSpec& spec, std::uint32_t needs, const VehicleState& start) {
  const std::uint64_t seed = noise_seed(spec, "sensing");
  Perception p{.image_needs = {.depth = (needs & AB_INPUT_DEPTH) != 0,
                               .stereo = (needs & AB_INPUT_STEREO) != 0,
                               .color = (needs & AB_INPUT_COLOR) != 0},
               .cameras = make_cameras(seen_sensor(spec), seed),
               .image_seed = stream_seed(seed, "image"),
               .exposures = {},
               .imu = spec.imu,
               .sees_imu = (needs & AB_INPUT_IMU) != 0,
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
               .past = {},
               .sees_states = (needs & AB_INPUT_STATES) != 0,
               .states = {},
               .lidars = {}};
  p.imu_state = make_imu(p.imu, p.imu_random);
  p.odometry_state = make_odometry(p.odometry, start, p.odometry_random);
  // Until the first state is old enough the planner sees the start.
  p.past.push_back(believed_state(p, start));
  p.lidars = make_lidar_sensing(spec.sensor, needs, seed, start, p.past.back());
  return p;
}

Tick next_sensing(const Perception& p, Tick now) {
  const auto after = [now](Tick period) { return (now / period + 1) * period; };
  Tick next = std::min(after(p.imu_period), next_sweep_end(p.lidars, now));
  for (const CameraGroup& group : p.cameras) {
    next = std::min(next, group.next_exposure > now ? group.next_exposure : now + 1);
  }
  // Without noise and delay the state is the truth at any tick, and flights need no ticks of
  // odometry.
  if (p.is_perfect) return next;
  next = std::min(next, after(p.odometry_period));
  // The next tick whose state a plan will see.
  return std::min(next,
                  ((now + p.state_delay) / p.plan_period + 1) * p.plan_period - p.state_delay);
}

/// Odometry first, since images are told with the pose that it believes.
void sense(Perception& p, const Scene& scene, const VehicleModel& model, const VehicleState& truth,
           const Environment& environment) {
  if (!p.is_perfect) {
    if (truth.tick > 0 && truth.tick % p.odometry_period == 0) {
      advance(p.odometry_state, p.odometry, truth, seconds(p.odometry_period), p.odometry_random);
    }
    if (truth.tick > 0 && is_state_tick(p, truth.tick)) p.past.push_back(believed_state(p, truth));
  }
  // At ticks that flights have anyway: to be seen changes nothing.
  if (p.sees_states && truth.tick % p.imu_period == 0) {
    p.states.push_back(believed_state(p, truth));
  }
  if (p.sees_imu && truth.tick % p.imu_period == 0) {
    p.imu_samples.push_back(sense_imu(p.imu, p.imu_state, model, truth, environment,
                                      seconds(p.imu_period), p.imu_random));
  }
  for (CameraGroup& group : p.cameras) {
    if (truth.tick == group.next_exposure) expose(p, group, scene, truth);
  }
  if (p.lidars.is_seen) sense_points(p.lidars, scene, truth, believed_state(p, truth));
}

VehicleState believed_state(const Perception& p, const VehicleState& truth) {
  return p.is_perfect ? truth : estimated(p.odometry_state, truth);
}

VehicleState truth_believed_as(const Perception& p, const VehicleState& believed) {
  return p.is_perfect ? believed : estimated_as(p.odometry_state, believed);
}

PlannerView planner_view(Perception& p, const VehicleState& truth) {
  // The newest state that is as old as the delay.
  while (p.past.size() > 1 && p.past[1].tick <= truth.tick - p.state_delay) p.past.pop_front();
  const VehicleState& state = p.is_perfect ? truth : p.past.front();
  PlannerView view{state_view(state), seconds(truth.tick), {}, {}, {}, {}, {}};
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
  // Oldest first, as one integrates them.
  for (const ImuSample& sample : p.imu_samples) {
    view.imu.push_back(
        {seconds(sample.tick), sample.rates_body_radps, sample.specific_force_body_mps2});
  }
  for (const VehicleState& past : p.states) {
    if (is_told(p, past, truth.tick)) view.states.push_back(state_view(past));
  }
  if (p.lidars.is_seen) view.clouds = cloud_views(p.lidars, truth.tick);
  return view;
}

void forget_images(Perception& p, Tick tick) {
  const auto first = p.exposures.begin();
  const auto last = first + static_cast<std::ptrdiff_t>(p.exposure_count);
  // Not the first ones only: kinds of cameras have delays of their own.
  const auto seen = std::stable_partition(first, last, [tick](const Exposure& e) {
    return e.ready > tick;  // the seen ones' buffers are used again
  });
  p.exposure_count = static_cast<std::size_t>(seen - first);
  forget_sweeps(p.lidars, tick);
}

void forget_seen(Perception& p, Tick now) {
  forget_images(p, now);
  p.imu_samples.clear();
  std::erase_if(p.states, [&](const VehicleState& past) { return is_told(p, past, now); });
}

}  // namespace avoidbench
