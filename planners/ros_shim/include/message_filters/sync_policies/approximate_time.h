#ifndef MESSAGE_FILTERS_SYNC_POLICIES_APPROXIMATE_TIME_H
#define MESSAGE_FILTERS_SYNC_POLICIES_APPROXIMATE_TIME_H

#include "message_filters/synchronizer.h"
#include "ros/time.h"

namespace message_filters {
namespace sync_policies {

/// Messages with stamps as near as can be, as ROS's policy of this name picks them.
template <class... M>
struct ApproximateTime {
  explicit ApproximateTime(std::uint32_t queue_size_) : queue_size(queue_size_) {}
  std::uint32_t queue_size;
};

}  // namespace sync_policies

template <class... M>
class Synchronizer<sync_policies::ApproximateTime<M...>>
    : public TypedSynchronizer<ros_shim::ApproximateMatcher, M...> {
 public:
  using Policy = sync_policies::ApproximateTime<M...>;
  explicit Synchronizer(const Policy& policy)
      : TypedSynchronizer<ros_shim::ApproximateMatcher, M...>(policy.queue_size) {}
  explicit Synchronizer(std::uint32_t queue_size) : Synchronizer(Policy(queue_size)) {}
  template <class First, class... Filter>
  Synchronizer(const Policy& policy, First& first, Filter&... filters) : Synchronizer(policy) {
    this->connectInput(first, filters...);
  }
  Synchronizer* getPolicy() { return this; }
  void setAgePenalty(double penalty) { this->matcher_.set_age_penalty(penalty); }
  void setInterMessageLowerBound(int topic, ros::Duration bound) {
    this->matcher_.set_inter_message_lower_bound(static_cast<std::size_t>(topic), bound.toNSec());
  }
  void setInterMessageLowerBound(ros::Duration bound) {
    for (std::size_t i = 0; i < sizeof...(M); ++i) {
      this->matcher_.set_inter_message_lower_bound(i, bound.toNSec());
    }
  }
  void setMaxIntervalDuration(ros::Duration interval) {
    this->matcher_.set_max_interval_ns(interval.toNSec());
  }
};

}  // namespace message_filters

#endif
