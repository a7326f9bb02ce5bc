#ifndef ROS_SHIM_SYNCHRONIZE_H
#define ROS_SHIM_SYNCHRONIZE_H

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <vector>

#include "ros_shim/pointer.h"

namespace ros_shim {

/// A message of one of the topics that are brought together.
struct Stamped {
  std::int64_t stamp_ns = 0;
  AnyMessage message;
};
using MatchCallback = std::function<void(const std::vector<AnyMessage>&)>;

/// Messages of all topics with one stamp.
class ExactMatcher {
 public:
  ExactMatcher(std::size_t topics, std::uint32_t queue_size, MatchCallback match)
      : topics_(topics), queue_size_(queue_size), match_(std::move(match)) {}
  void add(std::size_t topic, const Stamped& stamped);

 private:
  std::size_t topics_;
  std::uint32_t queue_size_;
  MatchCallback match_;
  std::map<std::int64_t, std::vector<AnyMessage>> by_stamp_;
};

/// Messages of all topics with stamps as near as can be: the sets of ROS's ApproximateTime. Each
/// set spans the least time of all that contain its pivot, the latest of the first messages; sets
/// do not cross, and no message is in two.
class ApproximateMatcher {
 public:
  ApproximateMatcher(std::size_t topics, std::uint32_t queue_size, MatchCallback match);
  void add(std::size_t topic, const Stamped& stamped);
  void set_age_penalty(double penalty) { age_penalty_ = penalty; }
  void set_inter_message_lower_bound(std::size_t topic, std::int64_t bound_ns) {
    topics_.at(topic).least_gap_ns = bound_ns;
  }
  void set_max_interval_ns(std::int64_t interval_ns) { max_interval_ns_ = interval_ns; }

 private:
  struct Topic {
    std::deque<Stamped> waiting;
    std::vector<Stamped> past;  ///< before the front, kept until the candidate is decided
    std::int64_t least_gap_ns = 0;
    bool has_dropped = false;
  };
  struct Edges {
    std::size_t first, last;
    std::int64_t first_ns, last_ns;
  };

  bool all_wait() const;
  Edges edges_of_fronts() const;
  /// As edges_of_fronts(), with the earliest that a topic without a message could still bring.
  Edges edges_of_possible() const;
  std::int64_t earliest_possible_ns(const Topic& topic) const;
  bool is_no_better(std::int64_t later_end_ns, std::int64_t other_gain_ns) const;
  void process();
  void consider(const Edges& edges);
  bool is_proven();
  void make_candidate(const Edges& edges);
  void give_candidate();
  void step(std::size_t topic);
  void step_back(Topic& topic, std::size_t count);

  std::vector<Topic> topics_;
  std::uint32_t queue_size_;
  MatchCallback match_;
  double age_penalty_ = 0.1;
  std::int64_t max_interval_ns_;
  bool has_pivot_ = false;
  std::size_t pivot_ = 0;
  std::int64_t pivot_ns_ = 0, candidate_first_ns_ = 0, candidate_last_ns_ = 0;
  std::vector<AnyMessage> candidate_;
};

}  // namespace ros_shim

#endif
