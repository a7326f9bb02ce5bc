#include "worker/message.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <thread>
#include <tuple>

#include "metrics/metric_table.hpp"
#include "worker/job.hpp"

/// What comes through a pipe that planners may write to.
namespace avoidbench {
namespace {

using State = MessageInbox::State;
constexpr std::size_t kMostBytes = 1000;

std::vector<std::byte> bytes_of(std::uint64_t magic_change, std::uint64_t text,
                                std::uint64_t other) {
  std::vector<std::byte> bytes = message_bytes({.json = nlohmann::json::object(), .bytes = {}});
  std::uint64_t header[3];
  std::memcpy(header, bytes.data(), sizeof header);
  header[0] += magic_change;
  header[1] = text;
  header[2] = other;
  std::memcpy(bytes.data(), header, sizeof header);
  return bytes;
}

MessageInbox expecting(std::size_t most_bytes = kMostBytes) {
  MessageInbox inbox;
  inbox.expect(most_bytes);
  return inbox;
}

TEST(MessageInbox, TakesAMessageByteByByte) {
  const Message sent{.json = {{"a", 1}}, .bytes = {std::byte{7}, std::byte{8}}};
  const std::vector<std::byte> bytes = message_bytes(sent);
  MessageInbox inbox = expecting();
  for (std::size_t i = 0; i + 1 < bytes.size(); ++i) {
    ASSERT_EQ(inbox.add(std::span(bytes).subspan(i, 1)), State::incomplete) << i;
  }
  EXPECT_EQ(inbox.add(std::span(bytes).last(1)), State::whole);
  const auto message = inbox.take();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->json, sent.json);
  EXPECT_EQ(message->bytes, sent.bytes);
}

// A read that was interrupted leaves an inbox that never held a byte, whose data() is null.
TEST(MessageInbox, IsIncompleteWithoutAByte) {
  EXPECT_EQ(expecting().state(), State::incomplete);
  EXPECT_EQ(MessageInbox().state(), State::incomplete);
}

TEST(MessageInbox, SeesAtOnceWhatIsNoMessage) {
  EXPECT_EQ(expecting().add(std::as_bytes(std::span("x", 1))), State::malformed);
  EXPECT_EQ(expecting().add(bytes_of(1, 2, 0)), State::malformed);
}

/// 2 × 4 GiB announced: no memory is taken for them.
TEST(MessageInbox, RefusesWhatIsLongerThanExpected) {
  const std::uint64_t large = std::uint64_t{1} << 32U;
  EXPECT_EQ(expecting().add(bytes_of(0, large, large)), State::malformed);
  EXPECT_EQ(expecting().add(bytes_of(0, kMostBytes, 0)), State::malformed);
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(expecting().add(bytes_of(0, most, most)), State::malformed);
}

TEST(MessageInbox, RefusesWhatFollowsAMessage) {
  std::vector<std::byte> bytes = message_bytes({.json = nlohmann::json::object(), .bytes = {}});
  bytes.push_back(std::byte{0});
  EXPECT_EQ(expecting().add(bytes), State::malformed);
}

/// Half of the third comes with the second.
TEST(MessageInbox, TakesOneAfterTheOtherWhereMoreAreExpected) {
  std::vector<std::byte> bytes;
  for (int i = 0; i < 3; ++i) {
    const auto one = message_bytes({.json = {{"i", i}}, .bytes = {std::byte{9}}});
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  const std::size_t half = bytes.size() * 5 / 6;
  MessageInbox inbox;
  inbox.expect(kMostBytes, true);
  EXPECT_EQ(inbox.add(std::span(bytes).first(half)), State::whole);
  EXPECT_EQ(inbox.take()->json.at("i"), 0);
  EXPECT_EQ(inbox.state(), State::whole);
  EXPECT_EQ(inbox.take()->json.at("i"), 1);
  EXPECT_EQ(inbox.state(), State::incomplete);
  EXPECT_EQ(inbox.add(std::span(bytes).subspan(half)), State::whole);
  EXPECT_EQ(inbox.take()->json.at("i"), 2);
  EXPECT_EQ(inbox.state(), State::incomplete);
  EXPECT_EQ(inbox.size(), 0U);
  // Rubbish after a message is none.
  bytes.resize(bytes.size() / 3);
  bytes.insert(bytes.end(), 30, std::byte{1});
  EXPECT_EQ(inbox.add(bytes), State::whole);
  EXPECT_TRUE(inbox.take());
  EXPECT_EQ(inbox.state(), State::malformed);
}

TEST(MessageInbox, TextThatIsNoObjectIsNoMessage) {
  MessageInbox inbox = expecting();
  ASSERT_EQ(inbox.add(message_bytes({.json = "text", .bytes = {}})), State::whole);
  EXPECT_FALSE(inbox.take());
}

TEST(Message, GoesThroughAPipeInPieces) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  // More than a pipe holds.
  const Message sent{.json = {{"a", 1}}, .bytes = std::vector<std::byte>(300'000, std::byte{5})};
  std::thread writer([&] { EXPECT_TRUE(send_message(ends[1], sent)); });
  const std::optional<Message> message = receive_message(ends[0]);
  writer.join();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->json, sent.json);
  EXPECT_EQ(message->bytes, sent.bytes);
  // Half a message, and then the end.
  const std::vector<std::byte> bytes = message_bytes(sent);
  ASSERT_EQ(::write(ends[1], bytes.data(), 100), 100);
  ::close(ends[1]);
  EXPECT_FALSE(receive_message(ends[0]));
  ::close(ends[0]);
  errno = 0;
  EXPECT_FALSE(receive_message(ends[0]));
  EXPECT_FALSE(send_message(ends[0], sent));
}

TEST(Message, TextThatIsNotUtf8IsReplaced) {
  EXPECT_NO_THROW(message_bytes({.json = {{"reason", "\xff\xfe"}}, .bytes = {}}));
}

Job trial_job() { return {.token = "token", .spec = {}, .mission = MissionRecord{}}; }

JobResult good_result() {
  JobResult result;
  result.token = "token";
  result.trial = TrialRecord{};
  result.metrics.assign(metric_table().size(), 0.5);
  return result;
}

TEST(JobResult, IsTakenWhereItAnswersTheJob) {
  const auto result = result_from(result_message(good_result()), trial_job());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->metrics, good_result().metrics);
}

TEST(JobResult, TellsTheFlightAsItWas) {
  JobResult sent = good_result();
  TrialRecord& flown = *sent.trial;
  flown.outcome = Outcome::collided;
  flown.reason = "touched a tree";
  flown.end_time_s = 0.1 + 0.2;
  flown.collisions = {{.time_s = 1.25, .speed_mps = 3.5, .obstacle = 7, .kind = "tree"},
                      {.time_s = 2.75, .speed_mps = 0.5, .obstacle = 9, .kind = "wall"}};
  flown.plan_calls = {
      {.time_s = 0.5, .cpu_time_s = 0.001, .wall_time_s = 0.002, .status = 1, .latency_s = 0.003}};
  const auto result = result_from(result_message(sent), trial_job());
  ASSERT_TRUE(result);
  const TrialRecord& told = *result->trial;
  EXPECT_EQ(told.outcome, flown.outcome);
  EXPECT_EQ(told.reason, flown.reason);
  EXPECT_EQ(told.end_time_s, flown.end_time_s);
  ASSERT_EQ(told.collisions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(told.collisions[i].time_s, flown.collisions[i].time_s);
    EXPECT_EQ(told.collisions[i].speed_mps, flown.collisions[i].speed_mps);
    EXPECT_EQ(told.collisions[i].obstacle, flown.collisions[i].obstacle);
    EXPECT_EQ(told.collisions[i].kind, flown.collisions[i].kind);
  }
  ASSERT_EQ(told.plan_calls.size(), 1U);
  const PlanCall& call = told.plan_calls[0];
  EXPECT_EQ(std::tuple(call.time_s, call.cpu_time_s, call.wall_time_s, call.status, call.latency_s),
            std::tuple(0.5, 0.001, 0.002, 1, 0.003));
}

TEST(Job, ComesAsItWasSent) {
  Job sent = trial_job();
  sent.spec.map_seed = 7;
  sent.listed_missions = {{.start_world = {1.0, 2.0, 0.1 + 0.2}, .start_yaw_rad = -0.5}};
  sent.mission->index = 3;
  sent.mission->reference_length_m = std::nan("");
  sent.recorded_latency_s = {0.25, 0.5};
  sent.change = {.tracks_perfectly = true, .still_at_s = 1.5};
  sent.lookout = {.kind = "cause",
                  .wanted = {.json = {{"a", {1, "b"}}}, .bytes = {std::byte{7}}},
                  .most_bytes = 12,
                  .has_flight = false};
  const Message message = job_message(sent);
  const Job came = job_from(message);
  EXPECT_EQ(came.spec.map_seed, 7U);
  ASSERT_EQ(came.listed_missions.size(), 1U);
  EXPECT_EQ(came.listed_missions[0].start_world, sent.listed_missions[0].start_world);
  EXPECT_EQ(came.mission->index, 3);
  EXPECT_TRUE(std::isnan(came.mission->reference_length_m));
  EXPECT_EQ(came.recorded_latency_s, sent.recorded_latency_s);
  EXPECT_EQ(came.change.still_at_s, 1.5);
  EXPECT_EQ(came.lookout->wanted.bytes, sent.lookout->wanted.bytes);
  EXPECT_EQ(job_message(came).json, message.json);
  const Job bare = job_from(job_message({.token = "token", .spec = {}, .mission = {}}));
  EXPECT_FALSE(bare.mission || bare.recorded_latency_s || bare.change.still_at_s || bare.lookout);
}

TEST(JobResult, OfAnotherJobIsNone) {
  JobResult other = good_result();
  other.token = "another";
  EXPECT_FALSE(result_from(result_message(other), trial_job()));
  JobResult map = good_result();
  map.trial.reset();
  map.map = MapRecord{};
  EXPECT_FALSE(result_from(result_message(map), trial_job()));
}

TEST(JobResult, WithoutOneOfItsPartsIsNone) {
  EXPECT_FALSE(result_from({.json = nlohmann::json::object(), .bytes = {}}, trial_job()));
  const Message whole = result_message(good_result());
  for (const auto& [key, value] : whole.json.items()) {
    Message part = whole;
    part.json.erase(key);
    EXPECT_FALSE(result_from(part, trial_job())) << key;
    part.json[key] = nlohmann::json::array({nlohmann::json::object()});
    EXPECT_FALSE(result_from(part, trial_job())) << key;
  }
  for (const auto& [key, value] : whole.json["trial"].items()) {
    Message part = whole;
    part.json["trial"].erase(key);
    EXPECT_FALSE(result_from(part, trial_job())) << key;
    part.json["trial"][key] = "no such thing";
    EXPECT_TRUE(key == "reason" || !result_from(part, trial_job())) << key;
  }
}

TEST(JobResult, OfOtherSizesIsNone) {
  JobResult few = good_result();
  few.metrics.pop_back();
  EXPECT_FALSE(result_from(result_message(few), trial_job()));
  Message half = result_message(good_result());
  half.bytes.resize(7);
  EXPECT_FALSE(result_from(half, trial_job()));
  JobResult map;
  map.token = "token";
  map.map = MapRecord{};
  const Job job{.token = "token", .spec = {}, .mission_count = 1, .mission = {}};
  EXPECT_FALSE(result_from(result_message(map), job));
}

TEST(Token, IsNeverTheSame) {
  EXPECT_EQ(make_token().size(), 32U);
  EXPECT_NE(make_token(), make_token());
}

}  // namespace
}  // namespace avoidbench
