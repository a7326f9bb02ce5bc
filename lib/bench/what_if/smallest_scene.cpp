#include "what_if/smallest_scene.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/math.hpp"
#include "map_file/export_map.hpp"
#include "maps/map_spec.hpp"
#include "replay/stored_flight.hpp"
#include "sweep/listed_missions.hpp"
#include "trial/flown_world.hpp"
#include "what_if/ddmin.hpp"
#include "world/scenery.hpp"

namespace avoidbench {
namespace {

/// The world with only these obstacles, and all that is scenery; prototypes that nothing uses any
/// more are left out.
World with_obstacles(const World& world, const IndexSet& obstacles) {
  const std::set<std::size_t> kept(obstacles.begin(), obstacles.end());
  World smaller = world;
  std::erase_if(smaller.instances, [&](const Instance& instance) {
    return !is_scenery(world.obstacles[instance.obstacle].kind) &&
           !kept.contains(instance.obstacle);
  });
  std::map<std::uint32_t, std::uint32_t> numbers;  // of prototypes, old to new
  smaller.prototypes.clear();
  for (Instance& instance : smaller.instances) {
    const auto [number, is_new] =
        numbers.emplace(instance.prototype, static_cast<std::uint32_t>(smaller.prototypes.size()));
    if (is_new) smaller.prototypes.push_back(world.prototypes[instance.prototype]);
    instance.prototype = number->second;
  }
  return smaller;
}

/// The obstacles, those nearest to the flown path first: parts of the list are then parts of the
/// way's surroundings.
IndexSet by_distance(const World& world, const std::vector<Sample>& path) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    const Obstacle& obstacle = world.obstacles[i];
    if (is_scenery(obstacle.kind)) continue;
    double nearest_m = 1e9;
    for (const Sample& sample : path) {
      const Eigen::Vector3d away = sample.position_world - obstacle.position_world;
      nearest_m = std::min(nearest_m, away.head<2>().norm() - 0.5 * obstacle.width_m);
    }
    order.emplace_back(nearest_m, i);
  }
  std::sort(order.begin(), order.end());
  IndexSet indices;
  for (const auto& [distance_m, index] : order) indices.push_back(index);
  return indices;
}

/// The heading next to this one that a file can say in degrees and read back to the same bits.
double written_yaw_rad(const Mission& mission) {
  constexpr int kMostSteps = 8;  // one is enough for nearly all
  double yaw_rad = mission.start_yaw_rad;
  // Left out in the file.
  if (yaw_rad == yaw_toward_goal_rad(mission.start_world, goals_of(mission).front()))
    return yaw_rad;
  for (int i = 0; i < kMostSteps; ++i) yaw_rad = yaw_rad / math::kDegree * math::kDegree;
  return yaw_rad;
}

std::vector<double> numbers_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A box of a start or goal: missions are listed, and none is drawn from it.
BoxSpec around(const Eigen::Vector3d& place, const Aabb& bounds) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1);
  return {.lowest_m = numbers_of((place - margin).cwiseMax(bounds.min())),
          .highest_m = numbers_of((place + margin).cwiseMin(bounds.max()))};
}

/// What a flight on a smaller map came to.
struct SceneEnd {
  Outcome outcome = Outcome::timed_out;
  std::string reason;
  bool has_failed() const { return outcome != Outcome::reached_goal; }
};

/// Flies the trial on maps that are files.
class SceneFlights {
 public:
  SceneFlights(const SceneRequest& request, Job job, World world)
      : request_(request), job_(std::move(job)), world_(std::move(world)) {}

  const World& world() const { return world_; }
  std::int64_t count() const { return count_; }
  bool is_stopped() const { return is_stopped_; }
  const SceneEnd& end_of(const IndexSet& set) const { return ends_.at(sorted(set)); }

  /// With its noise as that of the map's mission `index`.
  void use_mission(std::int64_t index) {
    job_.spec.mission_index = index;
    job_.mission->index = index;
    job_.spec.missions_digest = missions_digest(missions());
    ends_.clear();
  }

  std::vector<Mission> missions() const {
    return std::vector<Mission>(static_cast<std::size_t>(job_.spec.mission_index) + 1,
                                job_.mission->mission);
  }

  TestedSets test(const std::vector<IndexSet>& sets) {
    const auto batch = static_cast<std::size_t>(std::max(request_.fleet.jobs, 1));
    for (std::size_t begin = 0; begin < sets.size(); begin += batch) {
      const std::size_t end = std::min(begin + batch, sets.size());
      fly(sets, begin, end);
      if (is_stopped_) return {.first_failing = {}, .is_cut_short = true};
      for (std::size_t i = begin; i < end; ++i) {
        // Counted as if one after the other, so that the limit means the same for any number of
        // workers.
        if (counted_.insert({job_.spec.mission_index, sorted(sets[i])}).second) ++count_;
        if (count_ > request_.most_flights) return {.first_failing = {}, .is_cut_short = true};
        if (!end_of(sets[i]).has_failed()) continue;
        smallest_ = sets[i].size();
        tell();
        return {.first_failing = i, .is_cut_short = false};
      }
      tell();
    }
    return {};
  }

  /// The map of these obstacles as a file, and the spec that flies it.
  TrialSpec write_map(const IndexSet& set, const std::filesystem::path& file) const {
    export_mesh(with_obstacles(world_, set), file);
    MeshSpec mesh;
    mesh.file = std::filesystem::absolute(file).string();
    mesh.file_digest = file_digest(file);
    mesh.up_axis = UpAxis::y;  // as glTF has it
    mesh.bounds = {.lowest_m = numbers_of(world_.bounds.min()),
                   .highest_m = numbers_of(world_.bounds.max())};
    mesh.start_region = around(job_.mission->mission.start_world, world_.bounds);
    mesh.goal_region = around(job_.mission->mission.goal_world, world_.bounds);
    TrialSpec spec = job_.spec;
    spec.map = std::move(mesh);
    spec.movers = {};  // they stand in the map
    return spec;
  }

 private:
  static IndexSet sorted(IndexSet set) {
    std::sort(set.begin(), set.end());
    return set;
  }

  void tell() const {
    if (request_.on_progress) request_.on_progress(count_, smallest_);
  }

  /// Flies those of the sets that were not flown before.
  void fly(const std::vector<IndexSet>& sets, std::size_t begin, std::size_t end) {
    std::size_t index = begin;
    std::map<std::size_t, std::filesystem::path> tried;
    const auto next = [&](const Memory&) -> std::optional<FleetJob> {
      while (index < end && ends_.contains(sorted(sets[index]))) ++index;
      if (index == end) return std::nullopt;
      const std::size_t now = index++;
      tried[now] = request_.folder / ("tried_" + std::to_string(now) + ".glb");
      FleetJob flight = fleet_job(now, job_);
      flight.map = now;
      flight.job.spec = write_map(sets[now], tried[now]);
      return flight;
    };
    const auto ended = [&](const FleetJob& job, const JobEnd& its_end) {
      if (!its_end.killed_by.empty()) {
        throw InputError("the workers that flew were killed, by " + its_end.killed_by +
                         ": run the same command again, with fewer workers if memory is short");
      }
      if (its_end.answer && !its_end.answer->error.empty()) throw InputError(its_end.answer->error);
      const TrialRecord record = record_of(its_end, job.job.spec.planner);
      ends_[sorted(sets[job.index])] = {record.outcome, record.reason};
    };
    const auto forget = [&] {
      std::error_code error;
      for (const auto& [now, file] : tried) std::filesystem::remove(file, error);
    };
    try {
      avoidbench::fly(next, ended, request_.fleet);
    } catch (...) {
      forget();
      throw;
    }
    forget();
    for (std::size_t i = begin; i < end; ++i) {
      is_stopped_ = is_stopped_ || !ends_.contains(sorted(sets[i]));
    }
  }

  const SceneRequest& request_;
  Job job_;
  World world_;
  std::map<IndexSet, SceneEnd> ends_;
  std::set<std::pair<std::int64_t, IndexSet>> counted_;
  std::int64_t count_ = 0;
  std::size_t smallest_ = 0;  ///< of the sets that fail
  bool is_stopped_ = false;
};

void check_scene_request(const SceneRequest& request) {
  const StoredTrial& stored = request.stored;
  if (stored.row.record.outcome == Outcome::reached_goal) {
    throw InputError("the trial reached its goal: there is no failure to reduce");
  }
  if (is_measured(stored.spec.latency)) {
    throw InputError(
        "the trial's latency was measured: a sweep file can't express it, so the flight can't be "
        "repeated");
  }
}

}  // namespace

SmallestScene smallest_scene(const SceneRequest& request) {
  check_scene_request(request);
  std::vector<std::string> warnings;
  const StoredTrial stored = with_files(request.stored, request.files);
  ReplayPlanners planners(request.files);
  Job job = stored_job(stored, planners.of(stored.spec.planner), warnings);
  // Its goals are listed from here on.
  job.spec.mission.waypoints = 0;
  job.spec.mission.return_to_start = false;
  job.mission->mission.start_yaw_rad = written_yaw_rad(job.mission->mission);
  const std::vector<Sample>& path = stored.row.record.samples;
  World world = standing_at(flown_world(stored.spec, job.mission->mission),
                            path.empty() ? 0.0 : path.back().time_s);
  SceneFlights flights(request, std::move(job), std::move(world));
  const IndexSet all = by_distance(flights.world(), path);
  // Mission 0 of a list of one if that fails, too; else as many as keep the number, from which
  // noise follows.
  flights.use_mission(0);
  bool has_failed = flights.test({all}).first_failing.has_value();
  if (!has_failed && !flights.is_stopped() && stored.spec.mission_index > 0) {
    flights.use_mission(stored.spec.mission_index);
    has_failed = flights.test({all}).first_failing.has_value();
  }
  if (!has_failed && !flights.is_stopped()) {
    throw InputError(
        "the flight reaches its goal on the complete map written to a file (rounded triangles, "
        "full texture on all surfaces, nothing moves): there is no failure to reduce");
  }
  SmallestScene scene;
  scene.obstacles_before = all.size();
  scene.is_stopped = flights.is_stopped();
  if (scene.is_stopped) return scene;
  const SmallestSet smallest =
      smallest_failing(all, [&](const std::vector<IndexSet>& sets) { return flights.test(sets); });
  scene.is_stopped = flights.is_stopped();
  scene.is_minimal = smallest.is_minimal;
  scene.obstacles = smallest.elements.size();
  scene.flights = flights.count();
  for (const std::size_t index : smallest.elements) {
    scene.kinds.push_back(flights.world().obstacles[index].kind);
  }
  scene.spec = flights.write_map(smallest.elements, request.folder / kSceneMapFile);
  scene.missions = flights.missions();
  scene.outcome = flights.end_of(smallest.elements).outcome;
  scene.reason = flights.end_of(smallest.elements).reason;
  return scene;
}

}  // namespace avoidbench
