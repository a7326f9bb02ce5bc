#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "logs/pose_messages.hpp"
#include "logs/recorded_flight.hpp"

namespace avoidbench {

/// Gathers a flight in one pass over its log. All that readers of different formats share is here:
/// which topic and child frame is meant, which poses count, what is reported about them.
class FlightBuilder {
 public:
  explicit FlightBuilder(const RecordedFlightChoice& choice)
      : choice_(choice), child_frame_(choice.child_frame) {}

  // For logs with topics. Several connections or files may name the same topic.

  /// The topic's index. Throws BadMessage for more topics than any log has.
  std::size_t topic(std::string_view name, std::string_view type);
  std::string_view type_of(std::size_t topic) const { return topics_[topic].type; }
  /// Counts a message, and says whether read_message() or add() is to follow.
  bool wants_message(std::size_t topic);
  /// Reads a message of the chosen topic; `logged_ns` is when it was recorded. Throws BadMessage.
  void read_message(std::size_t topic, MessageReader message, std::int64_t logged_ns);
  /// For a format without types of ROS: these topics fit, and of those that have messages the first
  /// one is read where none is chosen.
  void prefer(std::vector<std::string> names) { preferred_ = std::move(names); }
  /// The name of the topic that is read; "" before one is found.
  std::string_view chosen_topic() const;

  /// Adds a pose in the order of the log. Returns its index, or nothing where it is left out.
  /// Throws BadMessage for more poses than any flight has.
  std::optional<std::size_t> add(const LoggedPose& pose);
  std::vector<RecordedPose>& poses() { return flight_.poses; }
  void warn(std::string warning) { flight_.warnings.push_back(std::move(warning)); }
  void set_format(std::string format) { flight_.format = std::move(format); }

  /// The flight, or InputError: see read_recorded_flight().
  RecordedFlight finish();

 private:
  struct Topic {
    std::string name, type;
    std::optional<PoseMessage> message;
    std::int64_t count = 0;
  };

  bool fits(const Topic& topic) const;
  bool is_preferred_to_chosen(const Topic& topic) const;
  /// Forgets all poses: those of this topic are better.
  void restart_with(std::size_t topic);
  std::string listed(bool only_fitting) const;
  [[noreturn]] void refuse(const std::string& message) const;
  void check_topic() const;
  void check_named_topic() const;
  void check_child_frame() const;
  bool is_of_child(std::string_view child_frame);
  void check_frame(std::string_view frame);
  void leave_out_bad_attitudes();
  void leave_out_bad_velocities();
  void report_left_out();

  RecordedFlightChoice choice_;
  RecordedFlight flight_;
  std::vector<Topic> topics_;
  std::vector<std::string> preferred_;
  std::optional<std::size_t> chosen_;  ///< the topic that is read
  std::map<std::string, std::int64_t, std::less<>> child_frames_;
  std::string child_frame_;           ///< the one that is read; "": not known yet
  std::optional<std::string> frame_;  ///< that poses are in
  std::int64_t not_finite_count_ = 0, back_in_time_count_ = 0, unstamped_count_ = 0;
};

}  // namespace avoidbench
