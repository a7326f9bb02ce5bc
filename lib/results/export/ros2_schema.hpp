#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fields.hpp"

namespace avoidbench {

/// Gathers the definition of a message, and those of the messages in it, each once.
class Ros2Definitions {
 public:
  template <class Message>
  void add() {
    const std::size_t index = texts_.size();
    texts_.emplace_back(Message::kName, "");
    const std::size_t outer = std::exchange(current_, index);
    Message message;
    visit(*this, message);
    current_ = outer;
  }
  template <class T>
  void field(std::string_view name, const T&) {
    // First: a type that is new here moves the texts.
    const std::string type = type_of(static_cast<T*>(nullptr));
    texts_[current_].second += type + ' ' + std::string(name) + '\n';
  }
  /// The first message's own fields, then each further one below a line and its name.
  std::string text() const;

 private:
  static std::string type_of(const double*) { return "float64"; }
  static std::string type_of(const float*) { return "float32"; }
  static std::string type_of(const bool*) { return "bool"; }
  static std::string type_of(const std::uint8_t*) { return "uint8"; }
  static std::string type_of(const std::int32_t*) { return "int32"; }
  static std::string type_of(const std::uint32_t*) { return "uint32"; }
  static std::string type_of(const std::string*) { return "string"; }
  template <class T>
  std::string type_of(const std::vector<T>*) {
    return type_of(static_cast<T*>(nullptr)) + "[]";
  }
  template <class T, std::size_t Size>
  std::string type_of(const std::array<T, Size>*) {
    return type_of(static_cast<T*>(nullptr)) + '[' + std::to_string(Size) + ']';
  }
  template <class Message>
  requires std::is_class_v<Message> std::string type_of(const Message*) {
    if (!has(Message::kName)) add<Message>();
    return short_name(Message::kName);
  }
  bool has(std::string_view name) const;
  /// "std_msgs/Header" of "std_msgs/msg/Header", as definitions name it.
  static std::string short_name(std::string_view name);

  std::vector<std::pair<std::string, std::string>> texts_;  // by name
  std::size_t current_ = 0;
};

/// The definition as MCAP embeds it (schema encoding "ros2msg").
template <class Message>
std::string ros2_definition() {
  Ros2Definitions definitions;
  definitions.add<Message>();
  return definitions.text();
}

}  // namespace avoidbench
