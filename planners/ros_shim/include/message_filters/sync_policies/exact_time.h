#ifndef MESSAGE_FILTERS_SYNC_POLICIES_EXACT_TIME_H
#define MESSAGE_FILTERS_SYNC_POLICIES_EXACT_TIME_H

#include "message_filters/synchronizer.h"

namespace message_filters {
namespace sync_policies {

/// Messages with one stamp.
template <class... M>
struct ExactTime {
  explicit ExactTime(std::uint32_t queue_size_) : queue_size(queue_size_) {}
  std::uint32_t queue_size;
};

}  // namespace sync_policies

template <class... M>
class Synchronizer<sync_policies::ExactTime<M...>>
    : public TypedSynchronizer<ros_shim::ExactMatcher, M...> {
 public:
  using Policy = sync_policies::ExactTime<M...>;
  explicit Synchronizer(const Policy& policy)
      : TypedSynchronizer<ros_shim::ExactMatcher, M...>(policy.queue_size) {}
  explicit Synchronizer(std::uint32_t queue_size) : Synchronizer(Policy(queue_size)) {}
  template <class First, class... Filter>
  Synchronizer(const Policy& policy, First& first, Filter&... filters) : Synchronizer(policy) {
    this->connectInput(first, filters...);
  }
};

}  // namespace message_filters

#endif
