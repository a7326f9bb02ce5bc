#ifndef ROS_TRANSPORT_HINTS_H
#define ROS_TRANSPORT_HINTS_H

namespace ros {

/// Nothing is transported here.
struct TransportHints {
  TransportHints& reliable() { return *this; }
  TransportHints& unreliable() { return *this; }
  TransportHints& tcp() { return *this; }
  TransportHints& udp() { return *this; }
  TransportHints& tcpNoDelay(bool = true) { return *this; }
  TransportHints& maxDatagramSize(int) { return *this; }
};

}  // namespace ros

#endif
