#include "ros_shim/synchronize.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ros_shim {

void ExactMatcher::add(std::size_t topic, const Stamped& stamped) {
  std::vector<AnyMessage>& set = by_stamp_[stamped.stamp_ns];
  set.resize(topics_);
  set[topic] = stamped.message;
  const bool is_whole =
      std::all_of(set.begin(), set.end(), [](const AnyMessage& one) { return one != nullptr; });
  if (is_whole) {
    const std::vector<AnyMessage> whole = set;
    // What is older can't become whole in order any more.
    by_stamp_.erase(by_stamp_.begin(), by_stamp_.upper_bound(stamped.stamp_ns));
    match_(whole);
  }
  while (queue_size_ > 0 && by_stamp_.size() > queue_size_) by_stamp_.erase(by_stamp_.begin());
}

ApproximateMatcher::ApproximateMatcher(std::size_t topics, std::uint32_t queue_size,
                                       MatchCallback match)
    : topics_(topics),
      queue_size_(std::max<std::uint32_t>(1, queue_size)),
      match_(std::move(match)),
      max_interval_ns_(std::numeric_limits<std::int64_t>::max()) {}

bool ApproximateMatcher::all_wait() const {
  return std::none_of(topics_.begin(), topics_.end(),
                      [](const Topic& topic) { return topic.waiting.empty(); });
}

ApproximateMatcher::Edges ApproximateMatcher::edges_of_fronts() const {
  Edges edges{0, 0, topics_[0].waiting.front().stamp_ns, topics_[0].waiting.front().stamp_ns};
  for (std::size_t i = 1; i < topics_.size(); ++i) {
    const std::int64_t stamp_ns = topics_[i].waiting.front().stamp_ns;
    if (stamp_ns < edges.first_ns) {
      edges.first = i;
      edges.first_ns = stamp_ns;
    }
    if (stamp_ns > edges.last_ns) {
      edges.last = i;
      edges.last_ns = stamp_ns;
    }
  }
  return edges;
}

std::int64_t ApproximateMatcher::earliest_possible_ns(const Topic& topic) const {
  if (!topic.waiting.empty()) return topic.waiting.front().stamp_ns;
  // A topic without a message waiting has one in the past: the candidate's at least.
  return std::max(topic.past.back().stamp_ns + topic.least_gap_ns, pivot_ns_);
}

ApproximateMatcher::Edges ApproximateMatcher::edges_of_possible() const {
  const std::int64_t begin_ns = earliest_possible_ns(topics_[0]);
  Edges edges{0, 0, begin_ns, begin_ns};
  for (std::size_t i = 1; i < topics_.size(); ++i) {
    const std::int64_t stamp_ns = earliest_possible_ns(topics_[i]);
    if (stamp_ns < edges.first_ns) {
      edges.first = i;
      edges.first_ns = stamp_ns;
    }
    if (stamp_ns > edges.last_ns) {
      edges.last = i;
      edges.last_ns = stamp_ns;
    }
  }
  return edges;
}

bool ApproximateMatcher::is_no_better(std::int64_t later_end_ns, std::int64_t other_gain_ns) const {
  return static_cast<double>(later_end_ns) * (1.0 + age_penalty_) >=
         static_cast<double>(other_gain_ns);
}

void ApproximateMatcher::step(std::size_t topic) {
  Topic& moved = topics_[topic];
  moved.past.push_back(moved.waiting.front());
  moved.waiting.pop_front();
}

void ApproximateMatcher::step_back(Topic& topic, std::size_t count) {
  for (; count > 0; --count) {
    topic.waiting.push_front(topic.past.back());
    topic.past.pop_back();
  }
}

void ApproximateMatcher::add(std::size_t topic, const Stamped& stamped) {
  Topic& to = topics_[topic];
  to.waiting.push_back(stamped);
  if (to.waiting.size() == 1 && all_wait()) process();
  if (to.waiting.size() + to.past.size() <= queue_size_) return;
  // Too many: what was searched is undone, the oldest goes, and the search begins again.
  for (Topic& one : topics_) step_back(one, one.past.size());
  to.waiting.pop_front();
  to.has_dropped = true;
  if (!has_pivot_) return;
  candidate_.clear();
  has_pivot_ = false;
  process();
}

void ApproximateMatcher::make_candidate(const Edges& edges) {
  candidate_.clear();
  for (Topic& topic : topics_) {
    candidate_.push_back(topic.waiting.front().message);
    topic.past.clear();  // before the candidate: never of a set any more
  }
  candidate_first_ns_ = edges.first_ns;
  candidate_last_ns_ = edges.last_ns;
}

void ApproximateMatcher::give_candidate() {
  const std::vector<AnyMessage> set = std::move(candidate_);
  candidate_.clear();
  has_pivot_ = false;
  for (Topic& topic : topics_) {
    step_back(topic, topic.past.size());
    topic.waiting.pop_front();  // the candidate's
  }
  match_(set);
}

/// Whether no set that can still come is better than the candidate. Steps on over messages that
/// are there, and undoes it.
bool ApproximateMatcher::is_proven() {
  std::vector<std::size_t> steps(topics_.size(), 0);
  bool proven = false;
  while (true) {
    const Edges edges = edges_of_possible();
    if (is_no_better(edges.last_ns - candidate_last_ns_, pivot_ns_ - candidate_first_ns_)) {
      proven = true;
      break;
    }
    if (!is_no_better(edges.last_ns - candidate_last_ns_, edges.first_ns - candidate_first_ns_)) {
      break;
    }
    step(edges.first);
    ++steps[edges.first];
  }
  for (std::size_t i = 0; i < topics_.size(); ++i) step_back(topics_[i], steps[i]);
  return proven;
}

void ApproximateMatcher::consider(const Edges& edges) {
  const bool is_worse =
      is_no_better(edges.last_ns - candidate_last_ns_, edges.first_ns - candidate_first_ns_);
  if (!is_worse) make_candidate(edges);
  step(edges.first);
}

void ApproximateMatcher::process() {
  while (all_wait()) {
    const Edges edges = edges_of_fronts();
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (i != edges.last) topics_[i].has_dropped = false;
    }
    if (!has_pivot_) {
      const bool is_wide = edges.last_ns - edges.first_ns > max_interval_ns_;
      // Of the topic that dropped messages, one of those may have been nearer.
      if (is_wide || topics_[edges.last].has_dropped) {
        topics_[edges.first].waiting.pop_front();
        continue;
      }
      make_candidate(edges);
      has_pivot_ = true;
      pivot_ = edges.last;
      pivot_ns_ = edges.last_ns;
      step(edges.first);
    } else {
      consider(edges);
    }
    // The pivot's own turn, or an end that costs more than any start before the pivot gains.
    const bool is_over =
        edges.first == pivot_ ||
        is_no_better(edges.last_ns - candidate_last_ns_, pivot_ns_ - candidate_first_ns_) ||
        (!all_wait() && is_proven());
    if (is_over) give_candidate();
  }
}

}  // namespace ros_shim
