#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>

namespace avoidbench {

/// A message that is not what its type says; the text says why. The readers of files add the place.
struct BadMessage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How the fields of a message are written one after another: ROS 1's little-endian fields without
/// gaps, or CDR with its header of four bytes, as ROS 2 writes it.
enum class MessageEncoding { ros1, cdr };

/// Takes the fields of one message, in order. Throws BadMessage where it ends early.
class MessageReader {
 public:
  MessageReader(std::string_view bytes, MessageEncoding encoding) : rest_(bytes) {
    if (encoding == MessageEncoding::ros1) return;
    constexpr std::string_view kZstd = "\x28\xb5\x2f\xfd";
    if (bytes.starts_with(kZstd)) {
      throw BadMessage(
          "the messages are compressed one by one; `ros2 bag convert` writes the recording without "
          "that (compression_mode: none)");
    }
    const std::string_view header = take(4);
    // Plain CDR, the first of its versions; the last two bytes mean nothing.
    if (header[0] != 0 || (header[1] != 0 && header[1] != 1)) {
      throw BadMessage("its first bytes are not those of CDR");
    }
    is_cdr_ = true;
    is_big_endian_ = header[1] == 0;
    size_ = rest_.size();
  }

  bool is_cdr() const { return is_cdr_; }
  std::size_t left() const { return rest_.size(); }

  template <class T>
  T number() {
    align(sizeof(T));
    char bytes[sizeof(T)];
    std::memcpy(bytes, take(sizeof(T)).data(), sizeof(T));
    if (is_big_endian_) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  /// Valid as long as the message's bytes.
  std::string_view text() {
    std::string_view bytes = take(number<std::uint32_t>());
    // CDR ends texts with a zero and counts it.
    if (is_cdr_ && bytes.ends_with('\0')) bytes.remove_suffix(1);
    return bytes;
  }

  void skip_doubles(std::size_t count) {
    align(sizeof(double));
    take(count * sizeof(double));
  }

 private:
  /// CDR puts a number at a multiple of its size, counted from behind the header.
  void align(std::size_t size) {
    const std::size_t place = size_ - rest_.size();
    if (is_cdr_) take((size - place % size) % size);
  }

  std::string_view take(std::size_t count) {
    if (rest_.size() < count) throw BadMessage("it is too short for its type");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
  std::size_t size_ = 0;  ///< of all behind the header of CDR
  bool is_cdr_ = false, is_big_endian_ = false;
};

}  // namespace avoidbench
