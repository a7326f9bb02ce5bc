#ifndef ROS_SHIM_FRAMES_H
#define ROS_SHIM_FRAMES_H

#include <cstdint>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ros_shim {

/// Where a frame lies in another one: metres; a unit quaternion x, y, z, w.
struct FramePose {
  double translation[3];
  double rotation[4];
};
FramePose combined(const FramePose& first, const FramePose& then);
FramePose inverse(const FramePose& pose);

class FrameError : public std::runtime_error {
 public:
  enum Kind { unknown, unconnected, extrapolated };
  FrameError(Kind kind_, const std::string& text) : std::runtime_error(text), kind(kind_) {}
  Kind kind;
};

/// A tree of frames over time, as tf2 has it. A leading / of a name is left out.
class Frames {
 public:
  explicit Frames(std::int64_t kept_ns) : kept_ns_(kept_ns) {}
  /// Samples of a link may come in any order; older ones than `kept_ns` before the newest go.
  void set(const std::string& parent, const std::string& child, std::int64_t stamp_ns,
           const FramePose& pose, bool is_static);
  /// The source frame in the target frame, between two samples evenly; at time 0 the newest that
  /// all links between them have. `at_ns` gets the time. Throws FrameError.
  FramePose lookup(const std::string& target, const std::string& source, std::int64_t time_ns,
                   std::int64_t& at_ns) const;
  bool exists(const std::string& frame) const;
  std::int64_t kept_ns() const { return kept_ns_; }

 private:
  using Samples = std::deque<std::pair<std::int64_t, FramePose>>;
  struct Link {
    std::string parent;
    bool is_static = false;
    Samples samples;
  };
  std::vector<std::string> way_up(const std::string& frame) const;
  FramePose pose_at(const std::string& child, std::int64_t time_ns) const;

  std::int64_t kept_ns_;
  std::map<std::string, Link> links_;  ///< by the child's name
};

}  // namespace ros_shim

#endif
