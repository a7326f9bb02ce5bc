#include "suite/suite_spec.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/digest.hpp"
#include "base/input_file.hpp"
#include "suite/suite_samples.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using suite_samples::SmallSuite;
using test::has;
using test::message_of;

TEST(SuiteSpec, ReadsWhatIsFrozen) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  EXPECT_EQ(suite.name, "small-1");
  EXPECT_EQ(suite.tracks, (std::vector<std::string>{"depth", "far"}));
  ASSERT_EQ(suite.cells.size(), 2U);
  EXPECT_EQ(suite.cells[1].sweeps.size(), 2U);
  EXPECT_EQ(suite.open.missions, 2);
}

/// Results of a track hang on what is frozen for it, and on nothing of another track.
TEST(SuiteSpec, ATrackHasItsSweepsAndADigestOfItsOwn) {
  SmallSuite files;
  const SuiteTrack depth = track_of(read_suite(files.folder()), "depth");
  const SuiteTrack far = track_of(read_suite(files.folder()), "far");
  EXPECT_EQ(depth.suite.cells[1].sweeps.size(), 2U);
  ASSERT_EQ(far.suite.cells[1].sweeps.size(), 1U);
  EXPECT_EQ(far.suite.cells[1].sweeps[0].name, "poles");
  EXPECT_NE(depth.sha256, far.sha256);
  const auto digests = [&] {
    const SuiteSpec suite = read_suite(files.folder());
    return std::pair(track_of(suite, "depth").sha256, track_of(suite, "far").sha256);
  };
  files.replace(", far: The same", "");
  files.replace(", far: ", ", near: ");
  files.replace(", far: ", ", near: ");
  files.replace("depth: Two tiny halls", "depth: Two halls, near: More");
  EXPECT_EQ(track_of(read_suite(files.folder()), "depth").sha256, depth.sha256);
  files.replace("near: More", "far: The same");
  files.replace(", near: ", ", far: ");
  files.replace(", near: ", ", far: ");
  EXPECT_EQ(digests(), std::pair(depth.sha256, far.sha256));
  files.replace("first_map_seed: 101", "first_map_seed: 102");
  EXPECT_NE(digests().first, depth.sha256);
  EXPECT_NE(digests().second, far.sha256);
}

TEST(SuiteSpec, NamesEveryProblemWithItsPlace) {
  SmallSuite files;
  files.replace("maps: 2", "maps: many");
  files.replace("missions: 2", "mission: 2");
  files.replace("cell: halls", "cell: ../halls");
  files.replace("far: The same", "far/er: The same");
  const std::string message = message_of([&] { read_suite(files.folder()); });
  EXPECT_TRUE(has(message, "suite.yaml:5:")) << message;
  EXPECT_TRUE(has(message, "splits.public: lacks 'missions'")) << message;
  EXPECT_TRUE(has(message, "expected a name of A-Z")) << message;
  EXPECT_TRUE(has(message, "maps: expected a whole number")) << message;
  EXPECT_TRUE(has(message, "tracks: expected a name of A-Z")) << message;
}

TEST(SuiteSpec, ASweepThatChangedIsRefused) {
  SmallSuite files;
  const SuiteTrack track = suite_track((files.folder() / "depth").string());
  const SuiteSweep& sweep = track.suite.cells[0].sweeps[0];
  EXPECT_EQ(frozen_file(track, sweep).filename(), "hall.yaml");
  files.append("depth/hall.yaml", "# a comment\n");
  const std::string message = message_of([&] { frozen_file(track, sweep); });
  EXPECT_TRUE(has(message, "is not the sweep that small-1 froze")) << message;
}

TEST(SuiteSpec, TracksThatAreNoneAreToldWithWhatThereIs) {
  EXPECT_TRUE(has(message_of([] { suite_track("avoidbench-1/deep"); }),
                  "did you mean avoidbench-1/depth?"));
  const SmallSuite files;
  EXPECT_TRUE(has(message_of([&] { suite_track((files.folder() / "near").string()); }), "/far"));
}

/// Known seeds, so that a sealed key means the same maps for ever: computed with
/// `printf CELL/SWEEP/map/0 | openssl dgst -sha256 -hmac KEY`.
TEST(SuiteSpec, SealedSeedsFollowFromTheKeyAlone) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  const std::string key = files.key();
  const SuiteCell& cell = suite.cells[0];
  const SweepSeeds seeds = seeds_of(suite, cell, cell.sweeps[0], Split::sealed, key);
  ASSERT_EQ(seeds.map_seeds.size(), 2U);
  const std::string mac = hmac_sha256(key, "halls/hall/map/1");
  EXPECT_EQ(seeds.map_seeds[1], std::stoull(mac.substr(0, 13), nullptr, 16));
  EXPECT_EQ(seeds.seed,
            std::stoull(hmac_sha256(key, "halls/hall/missions").substr(0, 13), nullptr, 16));
  EXPECT_EQ(seeds.missions, 1);
  std::set<std::uint64_t> all{seeds.seed};
  for (const std::uint64_t seed : seeds.map_seeds) {
    all.insert(seed);
    EXPECT_LT(seed, std::uint64_t{1} << 52U);
  }
  EXPECT_EQ(all.size(), 3U);
}

TEST(SuiteSpec, KnownSplitsCountFromTheirFirstSeed) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  const SuiteCell& cell = suite.cells[0];
  const SweepSeeds dev = seeds_of(suite, cell, cell.sweeps[0], Split::dev, "");
  EXPECT_EQ(dev.map_seeds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(dev.missions, 1);
  const SweepSeeds open = seeds_of(suite, cell, cell.sweeps[0], Split::open, "");
  EXPECT_EQ(open.map_seeds, (std::vector<std::uint64_t>{101, 102}));
  EXPECT_EQ(open.missions, 2);
}

TEST(SuiteSpec, TakesTheRightKeyOnly) {
  const SmallSuite files;
  const SuiteSpec suite = read_suite(files.folder());
  EXPECT_EQ(read_suite_key(files.write("key", "  " + files.key() + "\r\n"), suite), files.key());
  const std::string other(64, 'b');
  const std::string message = message_of([&] { read_suite_key(files.write("key", other), suite); });
  EXPECT_TRUE(has(message, "is not the key of small-1")) << message;
  EXPECT_FALSE(has(message, other)) << message;  // keys are no text for logs
  EXPECT_TRUE(has(message_of([&] { read_suite_key(files.write("key", "secret"), suite); }),
                  "is not a key: expected 64 hexadecimal digits"));
}

/// The hashes that avoidbench-1 was announced with.
TEST(SuiteSpec, TheBuiltInSuiteIsTheAnnouncedOne) {
  const std::map<std::string, std::string> announced = {
      {"depth", "927050e2a28a9196a6cd3ce87ab856de737e8ce903a6d9fb799573009650eafb"},
      {"dynamic", "d9a6791e389839f4de4eee4a5dfc782c5cde72dbe011534da5e89da2d86bc98f"},
      {"lidar", "722218fabcb1caaeb28b9f153a10253f94c6431f106cd876ed3bc8b6029d02b5"},
      {"stereo", "9f40caeaf308b30d6a3fbc27cbac600c94d291ee3fb2978828d65522a865e4d9"}};
  for (const auto& [name, digest] : announced) {
    const SuiteTrack track = suite_track("avoidbench-1/" + name);
    EXPECT_EQ(track.sha256, digest) << name;
    EXPECT_EQ(track.suite.sealed_key_sha256,
              "82e486380afc9653b60bb2a0a8b992acc750be4e7e2061a5b32a6702b0fd0e1d");
    EXPECT_EQ(track.suite.cells.size(), 8U) << name;
    for (const SuiteCell& cell : track.suite.cells) {
      std::int64_t maps = 0;
      for (const SuiteSweep& sweep : cell.sweeps) {
        frozen_file(track, sweep);  // throws where it is another file
        maps += sweep.map_count;
      }
      EXPECT_EQ(maps, 12) << cell.name;
    }
  }
  EXPECT_EQ(announced.size(), suite_track("avoidbench-1/depth").suite.tracks.size());
}

}  // namespace
}  // namespace avoidbench
