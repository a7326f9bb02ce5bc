#include "sensing/lidar.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/random.hpp"
#include "render/rays.hpp"
#include "sensing/lidar_scan.hpp"

namespace avoidbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Two surfaces in one beam are two echoes where they are farther apart than this: half of a pulse
/// of 7 ns.
constexpr double kEchoGap_m = 1.0;

/// The poses between two, evenly: by normalised linear interpolation of rotations, which for the
/// turn of a physics step is even to 1e-7 rad.
class PosesBetween {
 public:
  PosesBetween(const Pose& from, const Pose& to)
      : from_(from.translation()),
        way_(to.translation() - from.translation()),
        q_from_(from.linear()),
        q_to_(to.linear()) {
    if (q_from_.dot(q_to_) < 0.0) q_to_.coeffs() = -q_to_.coeffs();
  }

  Vector3d position(double share) const { return from_ + share * way_; }
  Matrix3d rotation(double share) const {
    const Quaterniond q(q_from_.coeffs() + share * (q_to_.coeffs() - q_from_.coeffs()));
    return q.normalized().toRotationMatrix();
  }

 private:
  Vector3d from_, way_;
  Quaterniond q_from_, q_to_;
};

/// Two unit vectors across a unit vector, and across each other.
struct Across {
  explicit Across(const Vector3d& along) {
    const Vector3d least = std::abs(along.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
    one = along.cross(least).normalized();
    other = along.cross(one);
  }
  Vector3d one, other;
};

/// Where the rays of a beam lie in its cross-section, whose radius is 1: on a spiral, evenly.
std::vector<Eigen::Vector2d> beam_section(std::int64_t rays) {
  std::vector<Eigen::Vector2d> section;
  constexpr double kGoldenAngle_rad = 2.399963229728653;
  for (std::int64_t i = 0; i < rays; ++i) {
    if (rays == 1) return {Eigen::Vector2d::Zero()};
    const double radius = std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(rays));
    const double angle = kGoldenAngle_rad * static_cast<double>(i);
    section.emplace_back(radius * math::cos(angle), radius * math::sin(angle));
  }
  return section;
}

/// What one ray of a beam brings back.
struct Echo {
  double distance_m = 0.0, intensity = 0.0;
};

/// The strongest echo of a beam, whose rays' echoes are given; intensity 0 where there is none. The
/// light of each ray fades with the square of its distance.
Echo strongest(std::vector<Echo>& echoes, std::size_t rays) {
  std::sort(echoes.begin(), echoes.end(),
            [](const Echo& a, const Echo& b) { return a.distance_m < b.distance_m; });
  Echo best;
  double most = 0.0;
  for (std::size_t first = 0; first < echoes.size();) {
    double light = 0.0, path = 0.0, intensity = 0.0;
    std::size_t end = first;
    do {
      const double distance_m = std::max(echoes[end].distance_m, 1e-3);
      const double part = echoes[end].intensity / (distance_m * distance_m);
      light += part;
      path += part * distance_m;
      intensity += echoes[end].intensity;
      ++end;
    } while (end < echoes.size() &&
             echoes[end].distance_m - echoes[end - 1].distance_m <= kEchoGap_m);
    if (light > most) {
      most = light;
      best = {.distance_m = path / light, .intensity = intensity / static_cast<double>(rays)};
    }
    first = end;
  }
  return best;
}

}  // namespace

struct Lidar::Internals {
  explicit Internals(const LidarSpec& spec)
      : lidar(spec),
        shots(shots_per_sweep(spec)),
        period(required_period(spec.rate_hz)),
        section(beam_section(spec.rays_per_beam)) {
    if (!repeats(lidar.scan)) return;
    for (std::int64_t i = 0; i < shots; ++i) directions.push_back(shot_direction(lidar, 0, i));
  }

  /// A shot of the step under way.
  struct Shot {
    std::int64_t index = 0;
    Vector3d direction_lidar;  ///< as it is reported
    double share = 0.0;        ///< of the step's way
  };

  LidarSpec lidar;
  std::int64_t shots;
  Tick period;
  std::vector<Eigen::Vector2d> section;
  std::vector<Vector3d> directions;  ///< of all shots, where sweeps are alike

  std::int64_t sweep_index = 0, fired = 0;
  std::vector<float> range_errors, angle_errors;  ///< one and two a shot, in standard deviations
  std::vector<bool> is_dropped;
  std::vector<LidarPoint> points;
  /// The same where they are de-skewed: by where the odometry believed the lidar to be.
  std::vector<Vector3d> believed_points_world, believed_misses_world;
  std::vector<Eigen::Vector3f> misses;

  std::vector<Shot> step;
  std::vector<Ray> rays;  ///< as many a shot as a beam has
  std::vector<RayHit> hits;
  std::vector<Echo> echoes;

  std::int64_t fired_until(Tick tick) const { return tick * shots / period; }
  double time_s(std::int64_t shot) const {
    return static_cast<double>(shot + 1) / static_cast<double>(shots) * seconds(period);
  }
  void choose_shots(const LidarMotion& motion);
  void aim(const LidarMotion& motion);
  Echo echo_of(const Scene& scene, std::size_t shot);
  void keep(const Shot& shot, const Echo& echo, const PosesBetween& believed);
};

/// Those of the step, and where on its way each is fired.
void Lidar::Internals::choose_shots(const LidarMotion& motion) {
  step.clear();
  const std::int64_t last = std::min(fired_until(motion.to), shots);
  const double from_s = seconds(motion.from), way_s = seconds(motion.to - motion.from);
  for (; fired < last; ++fired) {
    step.push_back({.index = fired,
                    .direction_lidar = directions.empty()
                                           ? shot_direction(lidar, sweep_index, fired)
                                           : directions[static_cast<std::size_t>(fired)],
                    .share = (time_s(fired) - from_s) / way_s});
  }
}

/// The rays of all the step's shots, from where the lidar is at each one's time.
void Lidar::Internals::aim(const LidarMotion& motion) {
  rays.clear();
  const PosesBetween truth(motion.T_world_from, motion.T_world_to);
  const double sigma_rad = lidar.angle_sigma_deg * math::kDegree;
  const double radius_rad = 0.5e-3 * lidar.divergence_mrad;
  for (const Shot& shot : step) {
    const Vector3d origin = truth.position(shot.share);
    const Matrix3d R_world_lidar = truth.rotation(shot.share);
    const auto at = 2 * static_cast<std::size_t>(shot.index);
    const bool is_bent = sigma_rad > 0.0 || section.size() > 1;
    if (!is_bent) {
      rays.push_back({origin, R_world_lidar * shot.direction_lidar});
      continue;
    }
    const Across across(shot.direction_lidar);
    const Eigen::Vector2d error =
        sigma_rad * Eigen::Vector2d(static_cast<double>(angle_errors[at]),
                                    static_cast<double>(angle_errors[at + 1]));
    for (const Eigen::Vector2d& place : section) {
      const Eigen::Vector2d aside = error + radius_rad * place;
      const Vector3d bent =
          shot.direction_lidar + aside.x() * across.one + aside.y() * across.other;
      rays.push_back({origin, R_world_lidar * bent.normalized()});
    }
  }
}

/// What comes back of the step's shot of this index; intensity 0: nothing.
Echo Lidar::Internals::echo_of(const Scene& scene, std::size_t shot) {
  const World& world = scene.world();
  echoes.clear();
  for (std::size_t i = shot * section.size(); i < (shot + 1) * section.size(); ++i) {
    const RayHit& hit = hits[i];
    if (!(hit.distance_m < lidar.max_range_m)) continue;
    const Prototype& prototype = world.prototypes[world.instances[hit.instance].prototype];
    const double cosine = std::abs(hit.normal_world.dot(rays[i].direction_world));
    const double part = reflectance(prototype.triangle_materials[hit.triangle]);
    echoes.push_back({.distance_m = hit.distance_m, .intensity = part * cosine});
  }
  const Echo echo = strongest(echoes, section.size());
  // The power of an echo is intensity over the square of its distance: a tenth at the range of a
  // tenth is the least that is noticed.
  const double range_m = lidar.range_at_10_percent_m * std::sqrt(10.0 * echo.intensity);
  const bool comes_back = echo.distance_m <= range_m && echo.distance_m >= lidar.min_range_m;
  return comes_back ? echo : Echo{};
}

void Lidar::Internals::keep(const Shot& shot, const Echo& echo, const PosesBetween& believed) {
  const auto index = static_cast<std::size_t>(shot.index);
  if (echo.intensity <= 0.0 || is_dropped[index]) {
    if (lidar.deskewed) {
      believed_misses_world.emplace_back(believed.rotation(shot.share) * shot.direction_lidar);
    } else {
      misses.emplace_back(shot.direction_lidar.cast<float>());
    }
    return;
  }
  const double error_m = lidar.range_sigma_m * static_cast<double>(range_errors[index]);
  const Vector3d place = std::max(echo.distance_m + error_m, 0.0) * shot.direction_lidar;
  points.push_back({.position_lidar = place.cast<float>(),
                    .time_s = static_cast<float>(time_s(shot.index) - seconds(period)),
                    .intensity = static_cast<float>(echo.intensity)});
  if (lidar.deskewed) {
    believed_points_world.emplace_back(believed.position(shot.share) +
                                       believed.rotation(shot.share) * place);
  }
}

LidarMotion at_rest(const LidarSpec& lidar, const Pose& T_world_lidar) {
  return {.from = 0,
          .to = required_period(lidar.rate_hz),
          .T_world_from = T_world_lidar,
          .T_world_to = T_world_lidar,
          .T_believed_from = T_world_lidar,
          .T_believed_to = T_world_lidar};
}

Lidar::Lidar(const LidarSpec& spec) : internals_(std::make_unique<Internals>(spec)) {}
Lidar::~Lidar() = default;
Lidar::Lidar(Lidar&&) noexcept = default;
Lidar& Lidar::operator=(Lidar&&) noexcept = default;

void Lidar::begin_sweep(std::int64_t index, std::uint64_t seed) {
  Internals& self = *internals_;
  self.sweep_index = index;
  self.fired = 0;
  self.points.clear();
  self.misses.clear();
  self.believed_points_world.clear();
  self.believed_misses_world.clear();
  // A stream for each: noise of one kind leaves the other as it is.
  const auto count = static_cast<std::size_t>(self.shots);
  self.range_errors.resize(count);
  stream(seed, "range").coarse_normals(self.range_errors);
  self.angle_errors.resize(2 * count);
  stream(seed, "angle").coarse_normals(self.angle_errors);
  RandomStream dropouts = stream(seed, "dropouts");
  self.is_dropped.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    self.is_dropped[i] = dropouts.uniform() < self.lidar.dropout_ratio;
  }
}

void Lidar::fire(const Scene& scene, const LidarMotion& motion) {
  Internals& self = *internals_;
  AB_CHECK(motion.from < motion.to && motion.to <= self.period, motion.from, motion.to);
  AB_CHECK(!self.is_dropped.empty(), "no sweep was begun");
  self.choose_shots(motion);
  self.aim(motion);
  self.hits.resize(self.rays.size());
  first_hits(scene, self.rays, self.lidar.max_range_m, self.hits);
  const PosesBetween believed(motion.T_believed_from, motion.T_believed_to);
  for (std::size_t i = 0; i < self.step.size(); ++i) {
    self.keep(self.step[i], self.echo_of(scene, i), believed);
  }
}

void Lidar::end_sweep(const Pose& T_believed_lidar, LidarSweep& sweep) {
  Internals& self = *internals_;
  std::swap(sweep.points, self.points);
  std::swap(sweep.misses, self.misses);
  if (!self.lidar.deskewed) return;
  const Pose T_lidar_believed = T_believed_lidar.inverse();
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    sweep.points[i].position_lidar =
        (T_lidar_believed * self.believed_points_world[i]).cast<float>();
  }
  sweep.misses.clear();
  for (const Vector3d& direction : self.believed_misses_world) {
    sweep.misses.emplace_back((T_lidar_believed.linear() * direction).cast<float>());
  }
}

}  // namespace avoidbench
