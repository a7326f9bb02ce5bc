#include "sample_flight.hpp"

#include <algorithm>
#include <string>

#include "avoidbench/planner.hpp"
#include "base/random.hpp"
#include "pilot.hpp"
#include "plugin/host_buffers.hpp"
#include "trial/planner_view.hpp"

namespace agile {
namespace {

using avoidbench::PlannerSetup;
using avoidbench::RandomStream;

/// The settings that a plugin would get for this vehicle.
Settings settings_for(const PlannerSetup& setup, double speed_mps) {
  Settings settings;
  settings.max_speed_mps = std::min(speed_mps, setup.max_speed_mps);
  settings.vehicle_acceleration_mps2 = setup.max_acceleration_mps2;
  settings.heading.rate_radps = std::min(settings.heading.rate_radps, setup.max_yaw_rate_radps);
  return settings;
}

Sample labelled(const Situation& situation, const Image& image, const ClearanceField& field,
                RandomStream& random) {
  Sample sample;
  sample.image = image;
  sample.inputs = net_inputs(situation);
  sample.frame = situation.frame;
  sample.desired_speed_mps = situation.desired_speed_mps;
  const std::array<Label, kModes> labels = expert_labels(field, situation, random);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    sample.labels[i] = points_of(situation, labels[i].curve);
    sample.costs[i] = static_cast<float>(labels[i].cost);
  }
  return sample;
}

/// Bends what the expert would fly, for a few images from time to time.
class Disturbance {
 public:
  Disturbance(double ratio, std::uint64_t seed)
      : ratio_(ratio), random_(avoidbench::stream(seed, "disturbance")) {}

  void act_on(Modes& modes) {
    const double draw = random_.uniform();
    if (left_ == 0 && draw < ratio_) {
      left_ = 2 + static_cast<int>(random_.below(5));
      aside_ = random_.uniform(-0.8, 0.8);
      up_ = random_.uniform(-0.25, 0.25);
    }
    if (left_ == 0) return;
    --left_;
    for (Mode& mode : modes) {
      mode.cost = 0.0F;
      for (int i = 0; i < kPoints; ++i) {
        const auto part = static_cast<float>((i + 1.0) / kPoints);
        mode.points[std::size_t(i)][1] += static_cast<float>(aside_) * part * part;
        mode.points[std::size_t(i)][2] += static_cast<float>(up_) * part * part;
      }
    }
  }

 private:
  double ratio_;
  RandomStream random_;
  int left_ = 0;
  double aside_ = 0.0, up_ = 0.0;
};

}  // namespace

SampledFlight sample_flight(const avoidbench::TrialSpec& spec, const avoidbench::Scene& scene,
                            const avoidbench::Mission& mission, const ClearanceField& field,
                            const SamplingSpec& sampling, Network* network) {
  const std::uint64_t seed = avoidbench::stream_seed(
      avoidbench::stream_seed(sampling.seed, spec.map_seed), std::uint64_t(spec.mission_index));
  RandomStream random = avoidbench::stream(seed, "flight");
  RandomStream expert = avoidbench::stream(seed, "expert");
  Disturbance disturbance(sampling.disturbed_ratio, seed);
  const double speed_mps = random.uniform(sampling.least_speed_mps, sampling.most_speed_mps);
  avoidbench::Mission flown = mission;
  flown.start_yaw_rad += random.uniform(-sampling.start_yaw_rad, sampling.start_yaw_rad);

  SampledFlight result;
  const PlannerSetup setup = planner_setup(spec);
  Pilot pilot(settings_for(setup, speed_mps), [&](const Situation& situation, const Image& image) {
    if (!sampling.labels && network != nullptr) return network->run(image, net_inputs(situation));
    result.samples.push_back(labelled(situation, image, field, expert));
    const Sample& sample = result.samples.back();
    if (network != nullptr) return network->run(image, sample.inputs);
    Modes modes;
    for (std::size_t i = 0; i < modes.size(); ++i) modes[i] = {sample.costs[i], sample.labels[i]};
    disturbance.act_on(modes);
    return modes;
  });
  pilot.reset(to_mission(planner_mission(spec, flown, scene.world().bounds)));

  constexpr std::uint32_t kNeeds = AB_INPUT_STATE | AB_INPUT_DEPTH;
  avoidbench::ObservationBuffers buffers;
  avoidbench::Flight flight = begin_flight(spec, scene, flown, kNeeds);
  while (const avoidbench::PlannerView* view = next_plan(flight)) {
    avoidbench::PlanResult plan;
    plan.status = avoidbench::PlanStatus::command;
    plan.points = pilot.plan(seen_of(buffers.fill(*view, setup.cameras, kNeeds)));
    plan.command = avoidbench::make_command(AB_COMMAND_TRAJECTORY);
    answer(flight, plan);
  }
  result.outcome = end_flight(std::move(flight)).outcome;
  return result;
}

}  // namespace agile
