#include "sweep/message.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

namespace avoidbench {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32U;
constexpr std::uint64_t kMagic =
    0x6176426e4d736731;  ///< begins a message: a planner may write here

bool write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool read_all(int fd, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(fd, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

}  // namespace

bool send_message(int fd, const Message& message) {
  const std::string text = message.json.dump();
  const std::array<std::uint64_t, 3> sizes{kMagic, text.size(), message.bytes.size()};
  return write_all(fd, std::as_bytes(std::span(sizes))) &&
         write_all(fd, std::as_bytes(std::span(text))) && write_all(fd, message.bytes);
}

std::optional<Message> receive_message(int fd) {
  std::array<std::uint64_t, 3> sizes{};
  if (!read_all(fd, std::as_writable_bytes(std::span(sizes)))) return std::nullopt;
  if (sizes[0] != kMagic || sizes[1] > kMaxBytes || sizes[2] > kMaxBytes) return std::nullopt;
  std::string text(sizes[1], '\0');
  Message message;
  message.bytes.resize(sizes[2]);
  if (!read_all(fd, std::as_writable_bytes(std::span(text)))) return std::nullopt;
  if (!read_all(fd, message.bytes)) return std::nullopt;
  message.json = nlohmann::json::parse(text, nullptr, false);
  if (!message.json.is_object()) return std::nullopt;
  return message;
}

nlohmann::json number_to_json(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double number_from_json(const nlohmann::json& json) {
  if (json.is_number()) return json.get<double>();
  const std::string text = json.get<std::string>();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace avoidbench
