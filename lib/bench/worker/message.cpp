#include "worker/message.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace avoidbench {
namespace {

// So that sums of sizes can't overflow; the true limit is the inbox's, of each job's answer.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32U;
// "avBnMsg1".
constexpr std::uint64_t kMagic =
    0x6176426e4d736731;  ///< begins a message: a planner may write here

/// How a message begins.
struct Header {
  std::uint64_t magic = 0, text_bytes = 0, other_bytes = 0;

  bool is_sound() const {
    return magic == kMagic && text_bytes <= kMaxBytes && other_bytes <= kMaxBytes;
  }
  std::uint64_t message_bytes() const { return sizeof(Header) + text_bytes + other_bytes; }
};

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

/// The message after its header.
std::optional<Message> message_of(const Header& header, std::span<const std::byte> body) {
  const auto text = body.first(header.text_bytes);
  const auto bytes = body.subspan(header.text_bytes);
  const char* begin = reinterpret_cast<const char*>(text.data());
  // Without throwing: what is no JSON is no message.
  Message message{.json = nlohmann::json::parse(begin, begin + text.size(), nullptr, false),
                  .bytes = {bytes.begin(), bytes.end()}};
  if (!message.json.is_object()) return std::nullopt;
  return message;
}

}  // namespace

std::vector<std::byte> message_bytes(const Message& message) {
  const std::string text =
      // A planner's reason may be no UTF-8; the default handler would throw.
      message.json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const Header header{kMagic, text.size(), message.bytes.size()};
  std::vector<std::byte> all;
  all.reserve(header.message_bytes());
  const auto add = [&all](std::span<const std::byte> part) {
    all.insert(all.end(), part.begin(), part.end());
  };
  add(std::as_bytes(std::span(&header, 1)));
  add(std::as_bytes(std::span(text)));
  add(message.bytes);
  return all;
}

bool send_message(int fd, const Message& message) { return write_all(fd, message_bytes(message)); }

std::optional<Message> receive_message(int fd) {
  Header header;
  if (!read_all(fd, std::as_writable_bytes(std::span(&header, 1)))) return std::nullopt;
  if (!header.is_sound()) return std::nullopt;
  std::vector<std::byte> body(header.message_bytes() - sizeof header);
  if (!read_all(fd, body)) return std::nullopt;
  return message_of(header, body);
}

void MessageInbox::expect(std::size_t most_bytes, bool has_more) {
  bytes_.clear();
  most_bytes_ = most_bytes;
  has_more_ = has_more;
}

MessageInbox::State MessageInbox::add(std::span<const std::byte> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return state();
}

MessageInbox::State MessageInbox::state() const {
  Header header;
  const std::size_t known = std::min(bytes_.size(), sizeof header);
  std::ranges::copy(std::span(bytes_).first(known),
                    std::as_writable_bytes(std::span(&header, 1)).begin());
  if (known < sizeof header) {
    // What differs from the first byte on need not be waited for.
    const bool begins = std::memcmp(&header, &kMagic, std::min(known, sizeof kMagic)) == 0;
    return begins ? State::incomplete : State::malformed;
  }
  if (!header.is_sound() || header.message_bytes() > most_bytes_) return State::malformed;
  if (bytes_.size() < header.message_bytes()) return State::incomplete;
  // More came than the message has: where a worker sends nothing but its answer, that is none.
  const bool is_alone = bytes_.size() == header.message_bytes();
  return is_alone || has_more_ ? State::whole : State::malformed;
}

std::optional<Message> MessageInbox::take() {
  Header header;
  std::memcpy(&header, bytes_.data(), sizeof header);
  const auto size = static_cast<std::ptrdiff_t>(header.message_bytes());
  std::optional<Message> message =
      message_of(header, std::span(bytes_).first(header.message_bytes()).subspan(sizeof header));
  bytes_.erase(bytes_.begin(), bytes_.begin() + size);
  return message;
}

}  // namespace avoidbench
