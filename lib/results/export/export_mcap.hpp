#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "export/flown_piece.hpp"
#include "export/mcap_writer.hpp"
#include "export/ros2_messages.hpp"
#include "replay/replay.hpp"
#include "world/world.hpp"

namespace avoidbench {

/// What a flight's file is made from; references must outlive it.
struct McapFlight {
  const StoredTrial& stored;
  /// With its movers, as it was flown in; null: the file has no map.
  const World* world = nullptr;
  std::string program;  ///< that writes it, with its version
};

/// Triangles of a map above which those of the obstacles far from the path are left out.
inline constexpr std::size_t kMostMcapTriangles = 500'000;

/// Writes a flight as an MCAP file of ROS 2 messages; docs/exports.md has the topics. What is
/// stored of it comes from the trial, what is not from pieces of the same flight flown again.
/// Messages are in order of their stamps, simulated time from 0, which is their log time, too. The
/// same flight gives the same bytes.
class McapExport {
 public:
  McapExport(const McapFlight& flight, std::ostream& stream);

  /// The next piece of the flight. Throws InputError where it can't be that: pieces come from a
  /// process that is not trusted.
  void add(const FlownPiece& piece);
  /// Writes the rest. Nothing may be added after it.
  void finish();

  std::uint64_t message_count() const { return writer_.message_count(); }
  /// Of the map, since it has too many.
  std::size_t left_out_triangles() const { return left_out_triangles_; }

 private:
  /// Something that is stored and when it happened.
  enum class Stored { begin, sample, call, contact, goal, tick, end };
  struct Moment {
    McapTime time = 0;
    Stored kind = Stored::sample;
    std::size_t index = 0;
  };
  /// A message that waits for those that come before it.
  struct Waiting {
    std::uint16_t channel = 0;
    std::vector<std::byte> data;
  };

  std::vector<Moment> stored_moments() const;
  void write_until(McapTime time);
  void write_stored(const Moment& moment);
  void write_begin(McapTime time);
  void write_sample(const Sample& sample, McapTime time);
  void write_call(const PlanCall& call, McapTime time);
  void write_contact(const Collision& contact, McapTime time);
  void write_goal(std::size_t index, McapTime time);
  void write_tick(McapTime time);
  void write_end(McapTime time);
  void write_event(McapTime time, std::uint8_t level, const std::string& name,
                   const std::string& text);
  void add_view(const FlownPiece& piece);
  void add_answer(const FlownPiece& piece);
  void add_picture(const SeenPicture& picture);
  void add_command(const FlownPiece& piece);

  template <class Message>
  std::uint16_t channel(const std::string& topic);
  template <class Message>
  void write(const std::string& topic, McapTime time, const Message& message);
  /// Of what is not stored: waits until nothing older can come.
  template <class Message>
  void keep(const std::string& topic, double time_s, const Message& message);

  const McapFlight flight_;
  PlannerSetup setup_;
  McapWriter writer_;
  std::map<std::string, std::uint16_t> channels_;  // by topic
  std::vector<Moment> moments_;                    // in order of time
  std::size_t next_moment_ = 0;
  std::vector<double> goal_times_s_;
  std::multimap<McapTime, Waiting> waiting_;
  McapTime longest_delay_ = 0;  ///< from a measurement's stamp until a piece has it
  McapTime written_until_ = 0;
  std::optional<std::uint64_t> last_piece_;
  double last_call_s_ = 0.0;
  std::size_t left_out_triangles_ = 0;
};

}  // namespace avoidbench
