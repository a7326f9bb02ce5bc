#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "base/enum_text.hpp"
#include "base/input_error.hpp"
#include "config/sweep_file.hpp"
#include "expert/clearance_field.hpp"
#include "expert/sample_files.hpp"
#include "expert/sample_flight.hpp"
#include "metrics/clearance_grid.hpp"
#include "metrics/map_record.hpp"
#include "sweep/listed_missions.hpp"
#include "sweep/sweep_spec.hpp"
#include "trial/map_scene.hpp"

/// agile_samples SWEEP --out FOLDER: flies the missions of a sweep by the expert or by weights, and
/// writes each image with the expert's ways, for training. With --outcomes FILE it only flies, and
/// writes how many flights ended in which way.
namespace {

using namespace agile;
namespace fs = std::filesystem;

struct Options {
  std::string sweep;
  std::vector<std::string> overrides;
  fs::path out, outcomes, weights;
  unsigned threads = std::thread::hardware_concurrency();
  SamplingSpec sampling;
};

/// The trials of one map.
struct MapTrials {
  std::shared_ptr<const avoidbench::TrialSpec> setting;
  std::vector<avoidbench::PlannedTrial> trials;
};

std::vector<MapTrials> maps_of(avoidbench::SweepSpec sweep) {
  avoidbench::PlannerChoice pilot;
  pilot.plugin = pilot.label = "expert";
  sweep.planners = {pilot};
  std::vector<MapTrials> maps;
  for (const avoidbench::PlannedTrial& trial : expand(sweep)) {
    if (maps.empty() || maps.back().setting != trial.setting) maps.push_back({trial.setting, {}});
    maps.back().trials.push_back(trial);
  }
  return maps;
}

class Sampler {
 public:
  explicit Sampler(const Options& options)
      : options_(options),
        sweep_(avoidbench::read_sweep(options.sweep, options.overrides)),
        maps_(maps_of(sweep_)) {}

  void run() {
    if (samples_wanted()) fs::create_directories(options_.out);
    {
      std::vector<std::jthread> helpers;
      for (unsigned i = 1; i < options_.threads; ++i) helpers.emplace_back([this] { work(); });
      work();
    }
    if (failure_) std::rethrow_exception(failure_);
    std::string line = std::to_string(samples_) + " samples of " + std::to_string(flights_) +
                       " flights on " + std::to_string(maps_.size()) + " maps:";
    for (const auto& [outcome, count] : outcomes_) {
      line += " " + std::to_string(count) + " " + std::string(avoidbench::text(outcome));
    }
    std::puts(line.c_str());
    if (!samples_wanted()) write_outcomes();
  }

 private:
  bool samples_wanted() const { return options_.outcomes.empty(); }

  void write_outcomes() const {
    nlohmann::json ends = {{"flights", flights_}};
    for (const auto& [outcome, count] : outcomes_) {
      ends[std::string(avoidbench::text(outcome))] = count;
    }
    write_json(options_.outcomes, ends);
  }

  void work() {
    std::unique_ptr<Network> network;
    try {
      if (!options_.weights.empty()) network = std::make_unique<Network>(options_.weights);
      while (true) {
        const std::size_t number = next_++;
        if (number >= maps_.size() || has_failed_) return;
        sample_map(number, network.get());
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      has_failed_ = true;
      if (!failure_) failure_ = std::current_exception();
    }
  }

  void sample_map(std::size_t number, Network* network) {
    const MapTrials& map = maps_[number];
    const avoidbench::TrialSpec& setting = *map.setting;
    const avoidbench::MapScene made(setting);
    std::map<std::int64_t, avoidbench::Mission> missions;
    std::vector<Eigen::Vector3d> free_places;
    const auto listed = missions_of(sweep_.missions, setting);
    for (const avoidbench::PlannedTrial& trial : map.trials) {
      const auto mission = the_mission(made.scene, setting, trial.mission_index, listed);
      if (!mission) continue;
      missions[trial.mission_index] = *mission;
      free_places.push_back(mission->start_world);
    }
    avoidbench::ClearanceGrid grid(made.scene, made.world.bounds, avoidbench::kMapCell_m);
    const ClearanceField field = make_clearance_field(grid, free_places);
    std::vector<Sample> samples;
    std::map<avoidbench::Outcome, int> outcomes;
    for (const avoidbench::PlannedTrial& trial : map.trials) {
      const auto mission = missions.find(trial.mission_index);
      if (mission == missions.end()) continue;
      SampledFlight flight = sample_flight(trial.spec(), made.scene, mission->second, field,
                                           options_.sampling, network);
      samples.insert(samples.end(), flight.samples.begin(), flight.samples.end());
      ++outcomes[flight.outcome];
    }
    const auto numbers = [](const Eigen::Vector3d& v) {
      return nlohmann::json{v.x(), v.y(), v.z()};
    };
    if (samples_wanted()) {
      write_samples(options_.out, number, samples, field,
                    {{"sweep", sweep_.name},
                     {"map", map_scene_key(setting)},
                     {"sensor", setting.sensor.name},
                     {"pilot", network == nullptr ? "expert" : "network"},
                     {"lowest", numbers(made.world.bounds.min())},
                     {"highest", numbers(made.world.bounds.max())}});
    }
    const std::lock_guard lock(mutex_);
    samples_ += samples.size();
    for (const auto& [outcome, count] : outcomes) {
      outcomes_[outcome] += count;
      flights_ += count;
    }
    std::fprintf(stderr, "\r%zu of %zu maps, %zu samples ", ++done_, maps_.size(), samples_);
    if (done_ == maps_.size()) std::fputc('\n', stderr);
  }

  const Options& options_;
  avoidbench::SweepSpec sweep_;
  std::vector<MapTrials> maps_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> has_failed_ = false;
  std::mutex mutex_;  // of what follows
  std::exception_ptr failure_;
  std::size_t samples_ = 0, done_ = 0;
  int flights_ = 0;
  std::map<avoidbench::Outcome, int> outcomes_;
};

int sample(int argument_count, char** arguments) {
  Options options;
  CLI::App app("Flies the missions of a sweep and writes each image with the expert's ways.");
  app.add_option("sweep", options.sweep, "Sweep file; its planners are not looked at")->required();
  auto* out = app.add_option("--out", options.out, "Folder for the samples");
  app.add_option("--set", options.overrides, "key=value instead of what the sweep says");
  auto* weights =
      app.add_option("--weights", options.weights, "Fly by these weights; the expert only labels");
  auto* outcomes =
      app.add_option("--outcomes", options.outcomes, "No samples: how flights by --weights end");
  outcomes->excludes(out)->needs(weights);
  app.add_option("--threads", options.threads, "Maps flown at once");
  app.add_option("--seed", options.sampling.seed, "Of speeds, disturbances and the expert");
  app.add_option("--least-speed", options.sampling.least_speed_mps, "Of a flight, m/s");
  app.add_option("--most-speed", options.sampling.most_speed_mps, "Of a flight, m/s");
  app.add_option("--disturbed", options.sampling.disturbed_ratio,
                 "Of the expert's plans that begin to lead astray");
  CLI11_PARSE(app, argument_count, arguments);
  if (options.out.empty() && options.outcomes.empty()) {
    throw avoidbench::InputError("--out or --outcomes is needed");
  }
  SamplingSpec& sampling = options.sampling;
  sampling.labels = options.outcomes.empty();
  if (!(sampling.least_speed_mps > 0.0 && sampling.least_speed_mps <= sampling.most_speed_mps)) {
    throw avoidbench::InputError("--least-speed must be above 0 and not above --most-speed");
  }
  Sampler(options).run();
  return 0;
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    return sample(argument_count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "agile_samples: %s\n", error.what());
  } catch (...) {
    std::fputs("agile_samples: what was thrown is no exception\n", stderr);
  }
  return 2;
}
