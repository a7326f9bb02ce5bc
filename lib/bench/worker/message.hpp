#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace avoidbench {

/// What goes through the pipe between the parent and a worker, either way: a JSON object and bytes
/// beside it.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct Message {
  nlohmann::json json;
  std::vector<std::byte> bytes;
};

/// The message as it goes through a pipe. Text that is no UTF-8 is replaced.
std::vector<std::byte> message_bytes(const Message& message);

/// Writes the whole message; waits for the reader. False when the other side is gone.
bool send_message(int fd, const Message& message);

/// Waits for a whole message. Nothing when the other side is gone or what came is no message.
std::optional<Message> receive_message(int fd);

/// What has come of one message through a pipe that anything may have been written to. Memory is
/// taken for what came, not for what its beginning announces.
class MessageInbox {
 public:
  enum class State { incomplete, whole, malformed };

  /// Forgets what came; the next message has at most this many bytes. `has_more`: others, of as
  /// many bytes at most, may come after it.
  void expect(std::size_t most_bytes, bool has_more = false);
  /// Malformed: no message, a longer one, or more than one where that is not expected.
  State add(std::span<const std::byte> bytes);
  State state() const;
  std::size_t size() const { return bytes_.size(); }  ///< bytes that came and were not taken
  /// Takes out the message that is whole; nothing where its text is no JSON object.
  std::optional<Message> take();

 private:
  std::vector<std::byte> bytes_;
  std::size_t most_bytes_ = 0;
  bool has_more_ = false;
};

}  // namespace avoidbench
