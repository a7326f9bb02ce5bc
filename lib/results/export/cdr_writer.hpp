#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fields.hpp"

namespace avoidbench {

template <class T>
concept CdrNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Writes a message as ROS 2 puts it on the wire: CDR (OMG DDSI-RTPS, version 1, little-endian) of
/// the fields that visit() names, in their order. Numbers lie at multiples of their size, counted
/// after the four bytes that name the encoding.
class CdrWriter {
 public:
  CdrWriter() : bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}} {}

  template <class T>
  void field(std::string_view, const T& value) {
    write(value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHeaderBytes = 4;
  static_assert(std::endian::native == std::endian::little);

  template <CdrNumber T>
  void write(const T& number) {
    write_all(std::span<const T>(&number, 1));
  }
  void write(bool value) { write(static_cast<std::uint8_t>(value ? 1 : 0)); }
  /// The length counts the zero at the end.
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    write_all(std::span<const char>(text.c_str(), text.size() + 1));
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    write_all(std::span<const T>(values));
  }
  template <class T, std::size_t Size>
  void write(const std::array<T, Size>& values) {
    write_all(std::span<const T>(values));
  }
  template <class Message>
  requires std::is_class_v<Message>
  void write(const Message& message) { visit(*this, message); }

  template <class T>
  void write_all(std::span<const T> values) {
    if constexpr (CdrNumber<T>) {
      if (values.empty()) return;  // what is not there needs no place
      const std::size_t at = bytes_.size() - kHeaderBytes;
      bytes_.resize(bytes_.size() + (sizeof(T) - at % sizeof(T)) % sizeof(T));
      const auto bytes = std::as_bytes(values);
      bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    } else {
      for (const T& value : values) write(value);
    }
  }

  std::vector<std::byte> bytes_;
};

template <class Message>
std::vector<std::byte> cdr_bytes(const Message& message) {
  CdrWriter writer;
  visit(writer, message);
  return writer.take();
}

}  // namespace avoidbench
