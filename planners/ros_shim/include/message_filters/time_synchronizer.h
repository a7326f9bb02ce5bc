#ifndef MESSAGE_FILTERS_TIME_SYNCHRONIZER_H
#define MESSAGE_FILTERS_TIME_SYNCHRONIZER_H

#include "message_filters/sync_policies/exact_time.h"

namespace message_filters {

template <class... M>
class TimeSynchronizer : public Synchronizer<sync_policies::ExactTime<M...>> {
 public:
  using Policy = sync_policies::ExactTime<M...>;
  explicit TimeSynchronizer(std::uint32_t queue_size) : Synchronizer<Policy>(Policy(queue_size)) {}
  /// The filters, then the size of the queue.
  template <class First, class Second>
  TimeSynchronizer(First& first, Second& second, std::uint32_t queue_size)
      : Synchronizer<Policy>(Policy(queue_size), first, second) {}
  template <class First, class Second, class Third>
  TimeSynchronizer(First& first, Second& second, Third& third, std::uint32_t queue_size)
      : Synchronizer<Policy>(Policy(queue_size), first, second, third) {}
  template <class First, class Second, class Third, class Fourth>
  TimeSynchronizer(First& first, Second& second, Third& third, Fourth& fourth,
                   std::uint32_t queue_size)
      : Synchronizer<Policy>(Policy(queue_size), first, second, third, fourth) {}
};

}  // namespace message_filters

#endif
