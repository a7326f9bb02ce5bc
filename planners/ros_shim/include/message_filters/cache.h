#ifndef MESSAGE_FILTERS_CACHE_H
#define MESSAGE_FILTERS_CACHE_H

#include <algorithm>
#include <deque>
#include <vector>

#include "message_filters/simple_filter.h"
#include "ros/message_traits.h"
#include "ros/time.h"

namespace message_filters {

/// The last messages of a topic by their stamps.
template <class M>
class Cache : public SimpleFilter<M> {
 public:
  using ConstPtr = typename SimpleFilter<M>::ConstPtr;

  explicit Cache(unsigned size = 1) : size_(size) {}
  template <class Filter>
  explicit Cache(Filter& filter, unsigned size = 1) : size_(size) {
    connectInput(filter);
  }
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  ~Cache() { input_.disconnect(); }

  template <class Filter>
  void connectInput(Filter& filter) {
    input_.disconnect();
    input_ = filter.registerCallback(
        std::function<void(const ConstPtr&)>([this](const ConstPtr& message) { add(message); }));
  }
  void setCacheSize(unsigned size) { size_ = size; }
  void add(const ConstPtr& message) {
    const auto later = [](const ConstPtr& a, const ConstPtr& b) { return stamp(a) < stamp(b); };
    messages_.insert(std::upper_bound(messages_.begin(), messages_.end(), message, later), message);
    while (messages_.size() > size_) messages_.pop_front();
    this->signalMessage(message);
  }
  std::vector<ConstPtr> getInterval(const ros::Time& from, const ros::Time& to) const {
    std::vector<ConstPtr> found;
    for (const ConstPtr& message : messages_) {
      if (stamp(message) >= from && stamp(message) <= to) found.push_back(message);
    }
    return found;
  }
  ConstPtr getElemBeforeTime(const ros::Time& time) const {
    ConstPtr found;
    for (const ConstPtr& message : messages_) {
      if (stamp(message) < time) found = message;
    }
    return found;
  }
  ConstPtr getElemAfterTime(const ros::Time& time) const {
    for (const ConstPtr& message : messages_) {
      if (stamp(message) > time) return message;
    }
    return ConstPtr();
  }
  ros::Time getOldestTime() const {
    return messages_.empty() ? ros::Time() : stamp(messages_.front());
  }
  ros::Time getLatestTime() const {
    return messages_.empty() ? ros::Time() : stamp(messages_.back());
  }

 private:
  static ros::Time stamp(const ConstPtr& message) {
    return ros::message_traits::TimeStamp<M>::value(*message);
  }

  unsigned size_;
  std::deque<ConstPtr> messages_;
  Connection input_;
};

}  // namespace message_filters

#endif
