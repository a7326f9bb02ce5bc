#ifndef MESSAGE_FILTERS_CONNECTION_H
#define MESSAGE_FILTERS_CONNECTION_H

#include <functional>
#include <utility>

namespace message_filters {

/// Ends a callback that registerCallback() began.
class Connection {
 public:
  Connection() = default;
  explicit Connection(std::function<void()> end) : end_(std::move(end)) {}
  void disconnect() {
    if (end_) end_();
    end_ = nullptr;
  }

 private:
  std::function<void()> end_;
};

}  // namespace message_filters

#endif
