#include <gtest/gtest.h>
#include <message_filters/cache.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/time_synchronizer.h>

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "simulated_ros.hpp"

namespace ros_shim::test {
namespace {

using geometry_msgs::PointStamped;
using geometry_msgs::PoseStamped;
using Pairs = std::vector<std::pair<int, int>>;

template <class M>
typename M::ConstPtr stamped(int milliseconds) {
  M message;
  message.header.stamp.fromNSec(std::int64_t{1000000} * milliseconds);
  return typename M::ConstPtr(new M(message));
}
template <class M>
int stamp_ms(const M& message) {
  return static_cast<int>(message.header.stamp.toNSec() / 1000000);
}

/// Pairs that a policy makes of messages of two topics, which come in this order: 'a' or 'b' and
/// their stamps.
template <class Policy>
Pairs pairs_of(const std::vector<std::pair<char, int>>& messages, std::uint32_t queue_size = 10) {
  message_filters::Synchronizer<Policy> synchronizer{Policy(queue_size)};
  Pairs pairs;
  synchronizer.registerCallback(
      std::function<void(const PointStamped::ConstPtr&, const PoseStamped::ConstPtr&)>(
          [&](const PointStamped::ConstPtr& a, const PoseStamped::ConstPtr& b) {
            pairs.emplace_back(stamp_ms(*a), stamp_ms(*b));
          }));
  for (const auto& [topic, stamp] : messages) {
    if (topic == 'a') {
      synchronizer.template add<0>(stamped<PointStamped>(stamp));
    } else {
      synchronizer.template add<1>(stamped<PoseStamped>(stamp));
    }
  }
  return pairs;
}
using Exact = message_filters::sync_policies::ExactTime<PointStamped, PoseStamped>;
using Approximate = message_filters::sync_policies::ApproximateTime<PointStamped, PoseStamped>;

TEST(ExactTime, PairsEqualStampsInOrder) {
  EXPECT_EQ(pairs_of<Exact>({{'a', 10}, {'b', 10}, {'a', 20}, {'a', 30}, {'b', 30}, {'b', 20}}),
            (Pairs{{10, 10}, {30, 30}}));  // 20 is older than what was given
}

TEST(ExactTime, AFullQueueForgetsTheOldest) {
  EXPECT_EQ(pairs_of<Exact>({{'a', 10}, {'a', 20}, {'a', 30}, {'b', 10}, {'b', 30}}, 2),
            (Pairs{{30, 30}}));
}

TEST(ApproximateTime, EqualStampsArePairs) {
  EXPECT_EQ(pairs_of<Approximate>({{'a', 10}, {'b', 10}, {'a', 20}, {'b', 20}}),
            (Pairs{{10, 10}, {20, 20}}));
}

/// A pair is known to be the nearest only when the next message has come.
TEST(ApproximateTime, TakesTheNearestOfBothSides) {
  EXPECT_EQ(pairs_of<Approximate>({{'a', 100}, {'b', 70}, {'b', 97}, {'b', 120}, {'a', 200}}),
            (Pairs{{100, 97}}));
  EXPECT_EQ(pairs_of<Approximate>({{'a', 100}, {'b', 70}, {'b', 102}, {'b', 140}, {'a', 200}}),
            (Pairs{{100, 102}}));
}

/// A camera at 10 Hz and odometry at 33 Hz: each image goes with the nearest odometry, none twice.
TEST(ApproximateTime, ASlowAndAFastTopicMeetAtTheSlowOnesPace) {
  std::vector<std::pair<char, int>> messages;
  for (int ms = 0; ms < 1000; ++ms) {
    if (ms % 100 == 7) messages.emplace_back('a', ms);
    if (ms % 30 == 0) messages.emplace_back('b', ms);
  }
  const Pairs pairs = pairs_of<Approximate>(messages);
  ASSERT_GE(pairs.size(), 9U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].first, static_cast<int>(i) * 100 + 7);
    EXPECT_LE(std::abs(pairs[i].first - pairs[i].second), 15);
  }
}

TEST(ApproximateTime, KeepsToTheGreatestInterval) {
  message_filters::Synchronizer<Approximate> synchronizer{Approximate(10)};
  synchronizer.setMaxIntervalDuration(ros::Duration(0.005));
  int count = 0;
  synchronizer.registerCallback(
      std::function<void(const PointStamped::ConstPtr&, const PoseStamped::ConstPtr&)>(
          [&](const PointStamped::ConstPtr&, const PoseStamped::ConstPtr&) { ++count; }));
  for (const int ms : {100, 200, 300}) {
    synchronizer.add<0>(stamped<PointStamped>(ms));
    synchronizer.add<1>(stamped<PoseStamped>(ms == 200 ? 203 : ms + 20));
  }
  EXPECT_EQ(count, 1);
}

struct Pair {
  void take(const PointStamped::ConstPtr& a, const PoseStamped::ConstPtr& b) {
    pairs.emplace_back(stamp_ms(*a), stamp_ms(*b));
  }
  Pairs pairs;
};

TEST(MessageFilters, SubscribersFeedASynchronizer) {
  Pair pair;
  std::size_t kept = 0;
  SimulatedRos ros({[&] {
                      ros::NodeHandle node;
                      message_filters::Subscriber<PointStamped> points(node, "points", 5);
                      message_filters::Subscriber<PoseStamped> poses(node, "poses", 5);
                      message_filters::TimeSynchronizer<PointStamped, PoseStamped> both(points,
                                                                                        poses, 5);
                      both.registerCallback(&Pair::take, &pair);
                      message_filters::Cache<PointStamped> cache(points, 2);
                      ros::spin();
                      kept = cache.getInterval(ros::Time(), ros::Time(100.0)).size();
                    },
                    [] {
                      ros::NodeHandle node;
                      ros::Publisher points = node.advertise<PointStamped>("points", 1);
                      ros::Publisher poses = node.advertise<PoseStamped>("poses", 1);
                      for (const int ms : {10, 20, 30}) {
                        points.publish(stamped<PointStamped>(ms));
                        if (ms != 20) poses.publish(stamped<PoseStamped>(ms));
                      }
                      ros::spin();
                    }});
  ros.run_to(0.1);
  end_nodes();
  EXPECT_EQ(pair.pairs, (Pairs{{10, 10}, {30, 30}}));
  EXPECT_EQ(kept, 2U);
}

}  // namespace
}  // namespace ros_shim::test
