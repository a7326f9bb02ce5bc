#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/spec_json.hpp"
#include "support/small_sweep.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/recorded_latency.hpp"
#include "sweep/schedule.hpp"
#include "worker/job.hpp"
#include "worker/worker_process.hpp"

namespace avoidbench {
namespace {

using test::small_sweep;
using test::SweepTest;

TEST_F(SweepTest, RowsAreTheSameForAnyNumberOfWorkersAndOnResume) {
  SweepSpec sweep = small_sweep();
  EXPECT_EQ(run(sweep, "one.db", 1).progress.done, 8);
  const std::string one = rows_;
  EXPECT_GT(one.size(), 1000U);
  EXPECT_EQ(run(sweep, "two.db", 2).progress.done, 8);
  EXPECT_EQ(rows_, one);
  EXPECT_EQ(run(sweep, "twice.db", 2).progress.done_before, 0);
  EXPECT_EQ(rows_, one);
  run(sweep, "in_process.db", 1, true);
  EXPECT_EQ(rows_, one);

  const RunSummary again = run(sweep, "one.db", 2);  // nothing left to do
  EXPECT_EQ(again.progress.done_before, 8);
  EXPECT_TRUE(again.progress.planners.empty());
  EXPECT_EQ(rows_, one);
}

TEST_F(SweepTest, GrowingASweepAddsAndKeepsWhatIsThere) {
  SweepSpec sweep = small_sweep();
  sweep.trials = 1;
  run(sweep, "grown.db", 1);
  sweep.trials = 2;
  const RunSummary grown = run(sweep, "grown.db", 2);
  EXPECT_EQ(grown.progress.done_before, 4);
  EXPECT_EQ(grown.progress.done, 8);
}

TEST_F(SweepTest, APlannerWithGlobalsFliesEachTrialInANewProcess) {
  for (const std::string told : {"AB_USES_GLOBALS", "0"}) {
    SweepSpec sweep = small_sweep();
    const std::string file = std::string(PLANNERS) + "/global_state_" + told + ".so";
    const PlannerDescription planner = PlannerLibrary::load(file).description();
    sweep.planners = {PlannerChoice{PluginChoice{.plugin = file,
                                                 .label = planner.name,
                                                 .file = file,
                                                 .file_digest = planner.file_digest,
                                                 .parameters = {},
                                                 .needs = planner.needs}}};
    run(sweep, told + ".db", 2);
    const Database database = Database::open_for_reading(folder_ / (told + ".db"));
    int good = 0, failed = 0;
    for (const auto& [key, outcome] : database.finished_trials()) {
      good += outcome == Outcome::planner_gave_up ? 1 : 0;
      failed += outcome == Outcome::planner_error ? 1 : 0;
    }
    EXPECT_EQ(good + failed, 4) << told;
    EXPECT_EQ(failed == 0, told != "0") << "without the flag processes are used again";
  }
}

TEST_F(SweepTest, ANewRevisionIsReportedWithWhatDiffers) {
  SweepSpec sweep = small_sweep();
  sweep.axes[0].values = {1};
  sweep.trials = 1;
  std::vector<SweepRevision> told;
  options_.on_revision = [&](const SweepRevision& revision) { told.push_back(revision); };
  run(sweep, "r.db", 1);
  run(sweep, "r.db", 1);
  EXPECT_TRUE(told.empty());
  SweepSpec other = sweep;
  other.base.mission.time_limit_s = 10.0;
  run(other, "r.db", 1);
  run(sweep, "r.db", 1);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_TRUE(told[0].is_new);
  EXPECT_EQ(told[0].revision, 2);
  EXPECT_EQ(told[0].changes, std::vector<std::string>{"mission.time_limit_s 20.0 → 10.0"});
  EXPECT_FALSE(told[1].is_new);
  EXPECT_EQ(told[1].revision, 1);
  EXPECT_EQ(told[1].latest, 2);
}

TEST(Expand, AxesAreSlowestAndPlannersFastest) {
  const auto trials = expand(small_sweep());
  ASSERT_EQ(trials.size(), 8U);
  EXPECT_EQ(trials[0].setting->map_seed, 1U);
  EXPECT_EQ(trials[0].planner_label(), "straight_line");
  EXPECT_EQ(trials[1].planner_label(), "reactive");
  EXPECT_EQ(trials[1].mission_index, 0);
  EXPECT_EQ(trials[2].mission_index, 1);
  EXPECT_EQ(trials[4].setting->map_seed, 2U);
  std::set<std::string> keys;
  for (const PlannedTrial& trial : trials) keys.insert(trial_key(trial.spec()));
  EXPECT_EQ(keys.size(), 8U);
}

TEST(Expand, FillsTheDigestsOfWindFields) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("wind_" + std::to_string(::getpid()) + ".txt");
  std::ofstream(file) << "min_x: 0";
  SweepSpec sweep = small_sweep();
  sweep.axes = {{.path = "wind.field.file", .values = {"", file.string()}}};
  const auto trials = expand(sweep);
  EXPECT_EQ(trials.front().setting->wind.field.file_digest, "");
  EXPECT_EQ(trials.back().setting->wind.field.file_digest, file_digest(file));
  EXPECT_NE(trial_key(trials.front().spec()), trial_key(trials.back().spec()));
  std::filesystem::remove(file);
  EXPECT_THROW(expand(sweep), InputError);
}

/// As by a build into the same place: what it flew from then on is no planner's result.
TEST_F(SweepTest, APlannerWrittenOverUnderWayStopsTheRunAndKeepsWhatWasFlown) {
  SweepSpec sweep = small_sweep();
  sweep.planners.resize(1);
  const std::filesystem::path copy = folder_ / "copy.so";
  std::filesystem::copy_file(sweep.planners[0].file, copy);
  sweep.planners[0].file = copy.string();
  options_.on_progress = [&](const Progress& progress) {
    if (progress.done != 1 || file_digest(copy) != sweep.planners[0].file_digest) return;
    // Of the same size, and with its old time of writing.
    const auto written = std::filesystem::last_write_time(copy);
    const auto bytes = static_cast<std::streamoff>(std::filesystem::file_size(copy));
    std::fstream(copy).seekp(bytes - 1).put('x');
    std::filesystem::last_write_time(copy, written);
  };
  try {
    run(sweep, "changed.db", 1);
    ADD_FAILURE() << "it went on";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("copy.so: the planner's file changed"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(Database::open_for_reading(folder_ / "changed.db").list_trials().size(), 1U);
}

TEST(TrialKey, IsTheDigestOfWhatIsNotAtItsDefault) {
  TrialSpec spec;
  spec.map = HallSpec{.poisson_radius_m = 4.5};
  spec.map_seed = 7;
  spec.mission_index = 0;
  spec.planner.plugin = "here/slow.so";
  spec.planner.file = "/there/here/slow.so";
  spec.planner.label = "slow";
  spec.planner.file_digest = "ab";
  spec.vehicle = VehicleSpec{};
  spec.vehicle.mass_kg = 1.5;
  spec.latency.mode = LatencyMode::zero;
  spec.latency.scale = 3.0;
  const auto key_of = [](const std::string& text) {
    return Digest().add(text).add(std::uint64_t{kResultVersion}).hex();
  };
  const std::string begin = R"({"latency":{"mode":"zero"},"map":{"generator":"hall",)"
                            R"("poisson_radius_m":4.5},"map_seed":7,"mission_index":0,)"
                            R"("planner":{"file_digest":"ab","label":"slow"},)",
                    vehicle = R"("vehicle":{"mass_kg":1.5}})";
  EXPECT_EQ(trial_key(spec), key_of(begin + vehicle));
  spec.sensor.more_cameras.resize(1);
  const auto method = [&](const char* camera) {
    return key_of(begin + R"("sensor":{"kind":"depth_ideal","more_cameras":[)" + camera + "]}," +
                  vehicle);
  };
  EXPECT_EQ(trial_key(spec), method(R"({"kind":"depth_ideal"})"));
  EXPECT_EQ(trial_key({}), key_of(R"({"mission_index":0})"));
  spec.sensor.more_cameras[0].method = StereoSgmSpec{.speckle_window_px = 9};
  EXPECT_EQ(trial_key(spec), method(R"({"kind":"stereo_sgm","speckle_window_px":9})"));
}

TEST(TrialKey, FollowsTheSpecAndNotThePath) {
  const TrialSpec spec = expand(small_sweep())[0].spec();
  TrialSpec moved = spec;
  moved.planner.file = "/elsewhere/straight_line.so";
  EXPECT_EQ(trial_key(spec), trial_key(moved));
  TrialSpec windy = spec;
  windy.wind.mean_world_mps[0] = 1e-9;
  EXPECT_NE(trial_key(spec), trial_key(windy));
  EXPECT_EQ(map_key(spec), map_key(windy));
  TrialSpec gusty = spec;
  gusty.wind.gust.rise_s += 1e-9;
  EXPECT_NE(trial_key(spec), trial_key(gusty));
  TrialSpec blown = spec;
  blown.wind.field.file = "/here/field.txt";
  EXPECT_EQ(trial_key(spec), trial_key(blown));  // its digest counts, not its place
  blown.wind.field.file_digest = "ab";
  EXPECT_NE(trial_key(spec), trial_key(blown));
  TrialSpec rebuilt = spec;
  rebuilt.planner.file_digest[0] = 'x';
  EXPECT_NE(trial_key(spec), trial_key(rebuilt));
  TrialSpec wide = spec;
  wide.vehicle.body_size_m[0] = 0.6;
  EXPECT_NE(map_key(spec), map_key(wide));
}

/// The key of a spec with a map from no file, from all of its text at once.
std::string defined_key(const TrialSpec& spec) {
  TrialSpec keyed = without_unused_latency(spec);
  keyed.planner.plugin.clear();
  keyed.planner.file.clear();
  keyed.planner.files.clear();
  nlohmann::json fields = sparse_json(keyed);
  fields["mission_index"] = spec.mission_index;
  if (spec.latency.mode == LatencyMode::replay) fields["latency_digest"] = spec.latency_digest;
  return Digest().add(fields.dump()).add(std::uint64_t{kResultVersion}).hex();
}

TEST(KeyMaker, GivesTheSameKeysAsOneByOne) {
  SweepSpec sweep = small_sweep();
  sweep.axes.push_back({.path = "wind.mean_world_mps", .values = {{0, 0, 0}, {1e-9, 0.1, -3}}});
  sweep.axes.push_back({.path = "latency.mode", .values = {"zero", "fixed", "measured"}});
  sweep.axes.push_back({.path = "vehicle.body_size_m", .values = {{0.5, 0.5, 0.1}, {1, 1, 1}}});
  sweep.trials = 30;
  std::vector<PlannedTrial> trials = expand(sweep);
  const auto add = [&](const auto& change) {
    TrialSpec spec = *trials.back().setting;
    change(spec);
    trials.push_back({.setting = std::make_shared<const TrialSpec>(spec),
                      .mission_index = 7,
                      .latency_digest = {}});
  };
  add([](TrialSpec& spec) { spec.map = ForestSpec{}; });
  add([](TrialSpec& spec) { spec.sensor.method = StereoSgbmSpec{}; });
  add([](TrialSpec& spec) { spec.sensor.method = StereoSgmSpec{}; });
  add([](TrialSpec& spec) { spec.sensor.method = StereoSgmSpec{.speckle_window_px = 9}; });
  for (int i = 0; i < 1100; ++i) {  // more settings than it keeps
    add([&](TrialSpec& spec) { spec.wind.mean_world_mps[2] = i; });
  }
  add([](TrialSpec& spec) { spec.planner.command = {kFileWord, "--fast"}; });
  add([](TrialSpec& spec) { spec.vehicle.thrust_to_weight = 4.0; });
  add([](TrialSpec& spec) { spec.latency.mode = LatencyMode::replay; });
  for (const char* digest : {"ab", "cd", "\"\u00e9\n"}) {
    trials.push_back(trials.back());
    trials.back().latency_digest = digest;
  }
  trials.push_back(trials.front());
  KeyMaker keys;
  std::set<std::string> all;
  for (const PlannedTrial& trial : trials) {
    const TrialSpec spec = trial.spec();
    ASSERT_EQ(keys.trial_key(trial), defined_key(spec));
    ASSERT_EQ(trial_key(spec), defined_key(spec));
    ASSERT_EQ(keys.map_key(trial), map_key(spec));
    all.insert(trial_key(spec));
  }
  EXPECT_EQ(all.size(), trials.size() - 1);
}

TEST(Schedule, HandsOutEveryTrialOnceAfterItsMap) {
  Schedule schedule = make_schedule(expand(small_sweep()), {});
  ASSERT_EQ(schedule.maps.size(), 2U);
  const auto first = next_assignment(schedule, {});
  ASSERT_TRUE(first && !first->trial);
  const auto second = next_assignment(schedule, {});
  ASSERT_TRUE(second && !second->trial);
  EXPECT_NE(first->map, second->map);
  EXPECT_FALSE(next_assignment(schedule, {}).has_value());  // both maps are being measured
  for (MapPlan& map : schedule.maps) map.record = MapRecord{};
  std::set<std::size_t> trials;
  for (int i = 0; i < 4; ++i) {
    const auto next = next_assignment(schedule, {.map = 1, .planner_label = {}});
    EXPECT_EQ(next->map, 1U);  // the worker's own map first
    trials.insert(*next->trial);
  }
  while (const auto next = next_assignment(schedule, {.map = 1, .planner_label = {}}))
    trials.insert(*next->trial);
  EXPECT_EQ(trials.size(), 8U);
}

TEST(Schedule, NamesThePlannerThatFliesFirstWhereAMapIsMeasured) {
  // Its worker gets that planner's sandbox, so that it need not be replaced and make the map twice.
  const auto trials = expand(small_sweep());
  Schedule schedule = make_schedule(trials, {trial_key(trials[0].spec())});
  for (std::size_t map = 0; map < schedule.maps.size(); ++map) {
    const std::string first = first_planner(schedule, map);
    schedule.maps[map].record = MapRecord{};
    const auto next = next_assignment(schedule, {.map = map, .planner_label = {}});
    ASSERT_TRUE(next && next->trial);
    EXPECT_EQ(schedule.trials[*next->trial].planner_label(), first);
    for (TrialGroup& group : schedule.maps[map].groups) group.waiting.clear();
    EXPECT_EQ(first_planner(schedule, map), "");
  }
}

TEST(Schedule, LeavesOutWhatIsFinished) {
  const auto trials = expand(small_sweep());
  const Schedule schedule =
      make_schedule(trials, {trial_key(trials[0].spec()), trial_key(trials[7].spec())});
  EXPECT_EQ(schedule.done_before, 2U);
  EXPECT_EQ(waiting_count(schedule.maps[0]), 3U);
  EXPECT_EQ(waiting_count(schedule.maps[1]), 3U);
}

TEST(Job, MessagesKeepEveryBit) {
  JobResult result;
  result.trial = TrialRecord{};
  result.trial->outcome = Outcome::collided;
  result.trial->reason = "touched tree 3";
  result.trial->end_time_s = 0.1 + 0.2;
  Sample sample;
  sample.time_s = 1.0 / 3.0;
  sample.position_world = {1e-300, -0.0, 1e300};
  sample.velocity_world = sample.acceleration_world = sample.rates_body_radps =
      sample.position_world;
  sample.reference_world = Eigen::Vector3d::Constant(std::nan(""));
  sample.q_world_body = Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4);
  result.trial->samples = {sample, sample};
  result.trial->plan_calls = {
      {.time_s = 0.1, .cpu_time_s = 1e-7, .wall_time_s = 0.3, .status = 1, .command_kind = 8}};
  result.trial->collisions = {
      {.time_s = 0.3, .speed_mps = 1.0 / 7.0, .obstacle = 3, .kind = "tree"}};
  result.metrics = {std::nan(""), HUGE_VAL, -0.0, 1.0 / 3.0};
  result.metrics.resize(metric_table().size());
  const auto taken = result_from(result_message(result), {.spec = {}, .mission = MissionRecord{}});
  ASSERT_TRUE(taken.has_value());
  const JobResult& back = *taken;
  EXPECT_EQ(back.trial->end_time_s, result.trial->end_time_s);
  EXPECT_EQ(back.trial->samples[1].position_world, sample.position_world);
  EXPECT_TRUE(std::isnan(back.trial->samples[1].reference_world.x()));
  EXPECT_EQ(back.trial->samples[1].q_world_body.coeffs(), sample.q_world_body.coeffs());
  EXPECT_EQ(back.trial->plan_calls[0].cpu_time_s, 1e-7);
  EXPECT_EQ(back.trial->collisions[0].speed_mps, 1.0 / 7.0);
  EXPECT_TRUE(std::isnan(back.metrics[0]));
  EXPECT_EQ(back.metrics[1], HUGE_VAL);
  EXPECT_TRUE(std::signbit(back.metrics[2]));
}

/// What a process has to say in the end.
WorkerProcess::Answer last_answer(WorkerProcess& process) {
  auto answer = process.receive();
  while (answer == WorkerProcess::Answer::incomplete) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    answer = process.receive();
  }
  return answer;
}

TEST(WorkerProcess, SaysHowItEnded) {
  WorkerProcess gone({"/bin/sh", "-c", "exit 7"});
  EXPECT_EQ(last_answer(gone), WorkerProcess::Answer::gone);
  const ProcessEnd end = gone.wait();
  EXPECT_EQ(end.exit_code, 7);
  WorkerProcess killed({"/bin/sh", "-c", "kill -11 $$"});
  EXPECT_EQ(last_answer(killed), WorkerProcess::Answer::gone);
  EXPECT_NE(killed.wait().text.find("signal 11"), std::string::npos);
}

}  // namespace
}  // namespace avoidbench
