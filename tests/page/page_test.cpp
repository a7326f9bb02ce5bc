#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "base/random.hpp"
#include "maps/map_spec.hpp"
#include "page/flight_choice.hpp"
#include "page/flight_data.hpp"
#include "page/flight_page.hpp"
#include "page/packed.hpp"
#include "page/page.hpp"
#include "page/page_text.hpp"
#include "page/world_data.hpp"
#include "report/sweep_tables.hpp"
#include "store/run_sql.hpp"
#include "support/sample_rows.hpp"
#include "sweep/sweep_rows.hpp"

namespace avoidbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

/// The other way round, for tests only: the page's own reader is TypeScript.
std::vector<unsigned char> unpacked(const std::string& text) {
  static const std::string kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> deflated;
  std::uint32_t group = 0;
  unsigned bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = (group << 6U) | static_cast<std::uint32_t>(kLetters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    deflated.push_back(static_cast<unsigned char>((group >> bits) & 255U));
  }
  std::vector<unsigned char> bytes(1 << 22);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &size, deflated.data(), deflated.size()), Z_OK);
  bytes.resize(size);
  return bytes;
}

/// Reads numbers as apps/page/src/packed.ts does.
struct Reader {
  std::vector<unsigned char> bytes;
  std::size_t at = 0;

  std::int64_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const unsigned char byte = bytes.at(at++);
      value |= static_cast<std::uint64_t>(byte & 127U) << shift;
      if (byte < 128) break;
    }
    return (value & 1U) != 0 ? static_cast<std::int64_t>(~(value >> 1U))
                             : static_cast<std::int64_t>(value >> 1U);
  }
  std::vector<std::int64_t> deltas(std::size_t count) {
    std::vector<std::int64_t> values;
    std::int64_t last = 0;
    for (std::size_t i = 0; i < count; ++i) values.push_back(last += next());
    return values;
  }
  std::vector<std::int64_t> second_deltas(std::size_t count) {
    std::vector<std::int64_t> values;
    std::int64_t last = 0, delta = 0;
    for (std::size_t i = 0; i < count; ++i) values.push_back(last += delta += next());
    return values;
  }
};

TEST(Packed, Base64IsThatOfTheStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(bytes_of("")), "");
  EXPECT_EQ(base64(bytes_of("f")), "Zg==");
  EXPECT_EQ(base64(bytes_of("fo")), "Zm8=");
  EXPECT_EQ(base64(bytes_of("foo")), "Zm9v");
  EXPECT_EQ(base64(bytes_of("foobar")), "Zm9vYmFy");
}

TEST(Packed, WholeNumbersOfAnySizeComeBack) {
  const std::vector<std::int64_t> values{
      0, -1, 1, 63, -64, 64, 1'000'000'007, -12, 1 << 30, 5, 5, 5, -(std::int64_t{1} << 52)};
  Packed packed;
  packed.add_deltas(values);
  packed.add_second_deltas(values);
  Reader reader{unpacked(packed.text())};
  EXPECT_EQ(reader.deltas(values.size()), values);
  EXPECT_EQ(reader.second_deltas(values.size()), values);
  EXPECT_EQ(reader.at, reader.bytes.size());
}

TEST(Packed, StepsAreTheNearestAndNothingWhereThereIsNoNumber) {
  EXPECT_EQ(steps(1.2349, 0.01), 123);
  EXPECT_EQ(steps(-1.236, 0.01), -124);
  EXPECT_EQ(steps(std::nan(""), 0.01, -1), -1);
  EXPECT_EQ(steps(kInfinity, 0.01, 7), 7);
  EXPECT_EQ(steps(1e300, 0.01, 7), 7);
}

std::vector<Sample> wild_samples(std::size_t count) {
  RandomStream random = stream(3, "samples");
  std::vector<Sample> samples;
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (std::size_t i = 0; i < count; ++i) {
    Sample s;
    s.time_s = 0.01 * static_cast<double>(i);
    const auto vector = [&](double most) {
      return Eigen::Vector3d(random.uniform(-most, most), random.uniform(-most, most),
                             random.uniform(-most, most));
    };
    s.position_world = vector(100.0);
    s.velocity_world = vector(10.0);
    s.acceleration_world = vector(10.0);
    q = Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                           random.uniform(-1, 1))
            .normalized();
    s.q_world_body = q;
    s.rates_body_radps = vector(1.0);
    s.reference_world = vector(100.0);
    s.clearance_m = random.uniform(0.0, 6.0);
    samples.push_back(s);
  }
  return samples;
}

TEST(FlightData, NumbersComeBackWithinHalfAStep) {
  TrialRecord record;
  record.samples = wild_samples(400);
  const nlohmann::ordered_json json = flight_json(record, 1000.0);
  const std::size_t n = json["n"];
  ASSERT_EQ(n, record.samples.size());
  Reader reader{unpacked(json["data"])};
  const auto times = reader.second_deltas(n);
  std::array<std::vector<std::int64_t>, 3> position, ahead;
  std::array<std::vector<std::int64_t>, 4> turn;
  for (auto& axis : position) axis = reader.second_deltas(n);
  for (auto& part : turn) part = reader.deltas(n);
  const auto speed = reader.deltas(n), clearance = reader.deltas(n), has = reader.deltas(n);
  for (auto& axis : ahead) axis = reader.deltas(n);
  EXPECT_EQ(reader.at, reader.bytes.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Sample& s = record.samples[i];
    const auto step = [](std::int64_t count, double size) {
      return static_cast<double>(count) * size;
    };
    EXPECT_NEAR(step(times[i], 0.001), s.time_s, 0.0005 + 1e-12);
    EXPECT_NEAR(step(speed[i], 0.01), s.velocity_world.norm(), 0.005 + 1e-12);
    EXPECT_NEAR(step(clearance[i], 0.01), std::min(s.clearance_m, kClearanceLimit_m),
                0.005 + 1e-12);
    EXPECT_EQ(has[i], 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      EXPECT_NEAR(step(position[k][i], 0.01), s.position_world[axis], 0.005 + 1e-12);
      EXPECT_NEAR(step(ahead[k][i], 0.01), s.reference_world[axis] - s.position_world[axis],
                  0.005 + 1e-12);
    }
    const Eigen::Quaterniond q(static_cast<double>(turn[0][i]), static_cast<double>(turn[1][i]),
                               static_cast<double>(turn[2][i]), static_cast<double>(turn[3][i]));
    // Four numbers that are each wrong by half a step: the angle is at most twice their length.
    const double bound_rad = 2.0 * 2.0 * 0.5 / kPageQuaternionSteps * 1.01;
    EXPECT_LT(q.normalized().angularDistance(s.q_world_body), bound_rad);
  }
}

TEST(FlightData, TheLeastClearanceBetweenKeptSamplesIsTold) {
  TrialRecord record;
  record.samples = wild_samples(101);
  for (Sample& s : record.samples) s.clearance_m = 2.0;
  record.samples[47].clearance_m = 0.13;  // between two that are kept
  const nlohmann::ordered_json json = flight_json(record, 10.0);
  const std::size_t n = json["n"];
  EXPECT_EQ(n, 11U);
  Reader reader{unpacked(json["data"])};
  for (int i = 0; i < 4; ++i) reader.second_deltas(n);
  for (int i = 0; i < 5; ++i) reader.deltas(n);
  const auto clearance = reader.deltas(n);
  EXPECT_EQ(clearance[5], 13);
  EXPECT_EQ(clearance[4], 200);
}

TEST(FlightData, KeepsFirstAndLastAndNoMoreThanTheRate) {
  const std::vector<Sample> samples = wild_samples(1001);  // 10 s
  const std::vector<std::size_t> kept = kept_samples(samples, 20.0);
  EXPECT_EQ(kept.size(), 201U);
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), 1000U);
  EXPECT_EQ(kept[1], 5U);
  EXPECT_TRUE(kept_samples({}, 20.0).empty());
}

TEST(FlightData, NoClearanceAndNoReferenceAreSaid) {
  TrialRecord record;
  record.samples = wild_samples(2);
  for (Sample& s : record.samples) {
    s.clearance_m = std::nan("");
    s.reference_world.setConstant(std::nan(""));
  }
  const nlohmann::ordered_json json = flight_json(record, 100.0);
  EXPECT_FALSE(json["reference"]);
  Reader reader{unpacked(json["data"])};
  for (int i = 0; i < 4; ++i) reader.second_deltas(2);
  for (int i = 0; i < 5; ++i) reader.deltas(2);
  EXPECT_EQ(reader.deltas(2), (std::vector<std::int64_t>{-1, -1}));
}

TEST(DepthByte, ErrsByLessThanHalfAStepOfItsLogarithm) {
  EXPECT_EQ(depth_byte(std::nan(""), 0.1, 15.0), 0);
  EXPECT_EQ(depth_byte(kInfinity, 0.1, 15.0), 255);
  EXPECT_EQ(depth_byte(0.1, 0.1, 15.0), 1);
  EXPECT_EQ(depth_byte(15.0, 0.1, 15.0), 254);
  EXPECT_TRUE(std::isnan(depth_of_byte(0, 0.1, 15.0)));
  EXPECT_TRUE(std::isinf(depth_of_byte(255, 0.1, 15.0)));
  const double most = 0.5 * std::log(150.0) / 253.0;  // in the logarithm: 1 %
  for (double depth_m = 0.1; depth_m < 15.0; depth_m *= 1.003) {
    const double back_m = depth_of_byte(depth_byte(depth_m, 0.1, 15.0), 0.1, 15.0);
    EXPECT_LE(std::abs(std::log(back_m / depth_m)), most + 1e-12);
  }
}

TEST(FlightOrder, FailuresThenOneSuccessEachThenCompanionsThenTheRest) {
  const std::vector<FlightCandidate> candidates{
      {.planner = 0, .map = 0, .mission = 0, .is_finished = true},   // first success
      {.planner = 0, .map = 0, .mission = 1, .is_finished = true},   // rest
      {.planner = 0, .map = 0, .mission = 2, .is_finished = true},   // beside a failure
      {.planner = 1, .map = 0, .mission = 2, .is_finished = false},  // failure
      {.planner = 1, .map = 0, .mission = 3, .is_finished = false},  // second failure there
      {.planner = 0, .map = 1, .mission = 0, .is_finished = false},  // failure
  };
  EXPECT_EQ(flight_order(candidates), (std::vector<std::size_t>{3, 5, 4, 0, 2, 1}));
  EXPECT_TRUE(flight_order({}).empty());
}

TEST(FlightOrder, APageMayHaveThreeMegabytesForAThousandTrials) {
  EXPECT_EQ(usual_page_bytes(32), 3'000'000U);
  EXPECT_EQ(usual_page_bytes(1000), 3'000'000U);
  EXPECT_EQ(usual_page_bytes(2000), 6'000'000U);
  EXPECT_EQ(usual_page_bytes(10'000), 15'000'000U);
}

TEST(SweepData, AMapIsCalledByWhatItsSweepVaries) {
  MapRow map;
  map.generator = "forest";
  map.spec_json = R"({"poisson_radius_m":3.4999999999,"trees":{"count":3}})";
  map.map_seed = 7;
  EXPECT_EQ(map_text(map, {}), "forest, seed 7");
  EXPECT_EQ(map_text(map, {"map.poisson_radius_m", "map.trees.count", "map.none"}),
            "forest, seed 7, poisson_radius_m 3.5, count 3");
}

TEST(PageText, NothingIsMarkup) {
  const nlohmann::ordered_json data = {
      {"name", "</script><script>alert(1)</script><!-- & \xe2\x80\xa8 \xe2\x80\xa9 \xff"}};
  const std::string text = script_safe(data);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
  EXPECT_EQ(text.find("\xe2\x80\xa8"), std::string::npos);
  EXPECT_EQ(text.find("\xe2\x80\xa9"), std::string::npos);
  // A reader gets back what went in, but for bytes that are no UTF-8.
  EXPECT_EQ(nlohmann::json::parse(text)["name"],
            "</script><script>alert(1)</script><!-- & \xe2\x80\xa8 \xe2\x80\xa9 \xef\xbf\xbd");
  EXPECT_EQ(html_text("<a href='x'>\"&"), "&lt;a href=&#39;x&#39;&gt;&quot;&amp;");
}

TEST(PageText, HasTheDataBetweenItsParts) {
  const PageProgram some{.head = "<h>", .body = "<b>", .tail = "<t>"};
  EXPECT_EQ(page_text(some, "a<b", nlohmann::ordered_json{{"x", 1}}), "<h>a&lt;b<b>{\"x\":1}<t>");
}

TEST(SweepPage, TrialsThatCantBeFlownAreInItsTablesAndTheirFlightsAreWarnedOf) {
  const sample_rows::TemporaryFolder folder;
  {
    Database database = sample_rows::begun(folder / "a.db");
    database.add_trial(sample_rows::finished());
    database.add_trial(sample_rows::collided());
  }
  const Database database = Database::open_for_reading(folder / "a.db");
  const SweepResult result = database.read_sweep("forest", 1);
  PageSweep sweep{.summary = summarize(result),
                  .section = {},
                  .result = result,
                  .axes = {},
                  .listing_of = {},
                  .runs = {sample_rows::run_row()},
                  .cause_of = {}};
  sweep.section = sweep_section(sweep.summary);
  for (const TrialListing& listing : database.list_trials("forest", 1)) {
    sweep.listing_of.emplace(listing.key, listing);
  }
  const std::vector<PageDatabase> databases{{.database = &database, .files = {}}};
  const PageOrigin origin{.version = "1", .git_hash = "a", .compiler = "c", .command = "d"};
  const nlohmann::ordered_json page = sweeps_page({sweep}, databases, origin, 1'000'000);
  const nlohmann::ordered_json& trials = page["sweeps"][0]["trials"];
  EXPECT_EQ(trials["count"], 2);
  Reader outcomes{unpacked(trials["outcome"])};
  EXPECT_EQ(outcomes.deltas(2),
            (std::vector<std::int64_t>{static_cast<std::int64_t>(result.trials[0].outcome),
                                       static_cast<std::int64_t>(result.trials[1].outcome)}));
  // Their spec is none that this program could have stored.
  EXPECT_TRUE(page["flights"].empty());
  EXPECT_FALSE(page["scene_warnings"].empty());
  // The host stays at home.
  EXPECT_EQ(page.dump().find("\"" + sample_rows::run_row().host + "\""), std::string::npos);
  EXPECT_EQ(page, sweeps_page({sweep}, databases, origin, 1'000'000));
}

TEST(SweepPage, WhereALimitIsLookedForAPlannerIsOneWhateverTheValue) {
  PageSweep sweep{.summary = {},
                  .section = {},
                  .result = {},
                  .axes = {},
                  .listing_of = {},
                  .runs = {},
                  .cause_of = {}};
  for (const char* label :
       {"ego[max_speed_mps=1]", "ego[max_speed_mps=2]", "agile[max_speed_mps=1]"}) {
    PlannerRow& row = sweep.result.planners.emplace_back();
    row.label = row.parameters_json = label;  // the key is of both
    TrialSummary& trial = sweep.result.trials.emplace_back();
    trial.planner_key = planner_key(row);
    sweep.summary.planners.emplace_back(label);
  }
  EXPECT_EQ(page_planners(sweep).of_trials, (std::vector<std::size_t>{0, 1, 2}));
  sweep.summary.limits.rule.field = "planner.max_speed_mps";
  const PagePlanners planners = page_planners(sweep);
  EXPECT_EQ(planners.labels, (std::vector<std::string>{"ego", "agile"}));
  EXPECT_EQ(planners.rows, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(planners.of_trials, (std::vector<std::size_t>{0, 0, 1}));
}

/// The page of sweep "forest" of this file, as large as `limit_bytes`.
nlohmann::ordered_json page_of(const std::filesystem::path& file, std::size_t limit_bytes) {
  const Database database = Database::open_for_reading(file);
  const SweepResult result = database.read_sweep("forest", 1);
  const PageSweep sweep{.summary = summarize(result),
                        .section = {},
                        .result = result,
                        .axes = {},
                        .listing_of = {},
                        .runs = {},
                        .cause_of = {}};
  const std::vector<PageDatabase> databases{{.database = &database, .files = {}}};
  return sweeps_page({sweep}, databases, {}, limit_bytes);
}

TEST(SweepPage, AFullPageLeavesFlightsOutAndSaysHowMany) {
  const sample_rows::TemporaryFolder folder;
  {
    Database database = sample_rows::begun(folder / "a.db");
    database.add_trial(sample_rows::finished());
  }
  const nlohmann::ordered_json page = page_of(folder / "a.db", 10);
  EXPECT_EQ(page["flights_left_out"], 1);
  // Its numbers have no room either, and stay.
  EXPECT_EQ(page["sweeps"][0]["trials"]["count"], 1);
  ASSERT_EQ(page["scene_warnings"].size(), 1U);
  const std::string warning = page["scene_warnings"][0];
  EXPECT_NE(warning.find("numbers of 1 trial alone take 0.0 MB"), std::string::npos) << warning;
}

TEST(SweepPage, WhatAPlannerSaysAtLengthIsCutAndSoManyPairsAreLeftOut) {
  const sample_rows::TemporaryFolder folder;
  {
    Database database = sample_rows::begun(folder / "a.db");
    TrialRow row = sample_rows::collided();
    row.record.reason = std::string(100'000, 'x');
    database.add_trial(row);
    database.add_trial(sample_rows::trial_row("b", 0, 0, Outcome::reached_goal));
  }
  const Database database = Database::open_for_reading(folder / "a.db");
  const SweepResult result = database.read_sweep("forest", 1);
  PageSweep sweep{.summary = summarize(result),
                  .section = {},
                  .result = result,
                  .axes = {},
                  .listing_of = {},
                  .runs = {},
                  .cause_of = {}};
  for (const TrialListing& listing : database.list_trials("forest", 1)) {
    sweep.listing_of.emplace(listing.key, listing);
  }
  sweep.summary.contrasts.resize(500, sweep.summary.contrasts.at(0));
  sweep.section = sweep_section(sweep.summary);
  const std::vector<PageDatabase> databases{{.database = &database, .files = {}}};
  const nlohmann::ordered_json page = sweeps_page({sweep}, databases, {}, 50'000);
  EXPECT_LT(size_in_page(page), 50'000U);
  EXPECT_NE(page["sweeps"][0]["trials"].dump().find("xxxx…"), std::string::npos);
  for (const auto& table : page["sweeps"][0]["tables"]) EXPECT_NE(table["name"], "pairs");
  EXPECT_NE(page["scene_warnings"].dump().find("500 pairs of planners of sweep forest"),
            std::string::npos);
}

TEST(SweepPage, OnlyFlightsThatAreShownHaveToBeWhole) {
  constexpr int kTrials = 60;
  const sample_rows::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.db";
  std::vector<std::string> keys;  // in the order of the page: all are failures of one map
  {
    Database database = sample_rows::begun(file, 0);
    database.add_map(sample_rows::map_row(0, kTrials), "forest");
    for (int i = 0; i < kTrials; ++i) {
      TrialRow row = sample_rows::trial_row("a", 0, i, Outcome::collided);
      TrialSpec spec;
      spec.mission_index = i;
      row.spec_json = trial_json(spec);
      database.add_trial(row);
    }
  }
  const nlohmann::ordered_json whole = page_of(file, 10'000'000);
  ASSERT_EQ(whole["flights"].size(), kTrials);
  EXPECT_EQ(whole["flights_left_out"], 0);
  // Room for some of them beside tables and map.
  const std::size_t limit_bytes = whole["sweeps"].dump().size() + whole["worlds"].dump().size() +
                                  whole["meshes"].dump().size() + 20'000;
  const nlohmann::ordered_json full = page_of(file, limit_bytes);
  // The whole page, with all that is in it, keeps to it.
  EXPECT_LE(size_in_page(full), limit_bytes);
  EXPECT_GT(size_in_page(full), limit_bytes - 10'000);
  // Where there is no room for the map, neither it nor any flight is there.
  const nlohmann::ordered_json none =
      page_of(file, limit_bytes - whole["meshes"].dump().size() - 10'000);
  EXPECT_TRUE(none["flights"].empty() && none["worlds"].empty() && none["rigs"].empty() &&
              none["meshes"].empty());
  EXPECT_EQ(none["flights_left_out"], kTrials);
  const std::size_t shown = full["flights"].size();
  ASSERT_GT(shown, 5U);
  ASSERT_LT(shown, kTrials);
  EXPECT_EQ(full["flights_left_out"], kTrials - shown);
  // They are the first ones of the whole page.
  for (std::size_t i = 0; i < shown; ++i) EXPECT_EQ(full["flights"][i], whole["flights"][i]);

  const auto damage = [&](const std::string& where) {
    test::run_sql(file, "UPDATE trajectories SET samples = x'00' WHERE trial_key " + where +
                            " (SELECT trial_key FROM sweep_trials ORDER BY trial_key LIMIT " +
                            std::to_string(shown) + ")");
  };
  damage("NOT IN");
  EXPECT_EQ(page_of(file, limit_bytes), full);
  damage("IN");
  const nlohmann::ordered_json damaged = page_of(file, limit_bytes);
  EXPECT_TRUE(damaged["flights"].empty());
  const std::string warning = damaged["scene_warnings"][0];
  EXPECT_NE(warning.find("samples can't be unpacked"), std::string::npos) << warning;
}

TEST(WorldData, MeshesThatAreAlikeAreThereOnceAndTheirCornersWithinAStep) {
  const World world = make_world(ForestSpec{}, 1), again = make_world(ForestSpec{}, 2);
  MeshStore meshes;
  const nlohmann::ordered_json one = world_json(world, meshes);
  const std::size_t count = meshes.json().size();
  world_json(again, meshes);
  // Another ground; the same plants.
  EXPECT_EQ(meshes.json().size(), count + 1);
  EXPECT_EQ(one["instances"], world.instances.size());
  const Prototype& plant = world.prototypes.at(1);
  MeshStore single;
  single.add(plant);
  const nlohmann::ordered_json mesh = single.json()[0];
  Reader reader{unpacked(mesh["data"])};
  Eigen::AlignedBox3f box;
  for (const auto& vertex : plant.mesh.vertices) box.extend(vertex);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto places = reader.deltas(plant.mesh.vertices.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double size = static_cast<double>(box.sizes()[k]);
      const double back = static_cast<double>(box.min()[k]) +
                          size * static_cast<double>(places[i]) / static_cast<double>(kMeshSteps);
      EXPECT_NEAR(back, static_cast<double>(plant.mesh.vertices[i][k]),
                  0.5 * size / static_cast<double>(kMeshSteps) + 1e-6);
    }
  }
}

}  // namespace
}  // namespace avoidbench
