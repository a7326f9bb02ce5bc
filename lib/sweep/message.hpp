#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace avoidbench {

/// What goes through the pipe between the parent and a worker, either way: a JSON object and bytes
/// beside it.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json says it of its own members
struct Message {
  nlohmann::json json;
  std::vector<std::byte> bytes;
};

/// Writes the whole message. False when the other side is gone.
bool send_message(int fd, const Message& message);

/// Waits for a whole message. Nothing when the other side is gone or what came is no message.
std::optional<Message> receive_message(int fd);

/// A double as JSON that reads back to the same bits; JSON itself has no NaN and no infinity.
nlohmann::json number_to_json(double value);
double number_from_json(const nlohmann::json& json);

}  // namespace avoidbench
