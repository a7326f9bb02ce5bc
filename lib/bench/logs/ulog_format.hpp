#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "logs/message_reader.hpp"

/// What the messages of a ULog look like, as the file itself says.
namespace avoidbench {

/// The caller has checked that the number is there.
template <class T>
T load_ulog(std::string_view data, std::size_t place) {
  T value;
  std::memcpy(&value, data.data() + place, sizeof value);
  return value;
}

enum class UlogType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// A number, or several of one type, within a topic's messages.
struct UlogField {
  std::size_t place = 0;  ///< byte within a message
  UlogType type = UlogType::f32;
  std::size_t count = 1;

  /// One of its numbers in a message. Throws BadMessage where the message ends before it.
  double in(std::string_view message, std::size_t index = 0) const;
};

/// The formats that a log defines: names of types and their fields in order, without gaps but those
/// that are fields.
class UlogFormats {
 public:
  /// "name:type field;type[3] field;". Throws BadMessage for any other text.
  void add(std::string_view definition);
  /// A field of numbers of a type. Nothing where there is none of that name. Throws BadMessage for
  /// a type that is not defined, contains itself, or is larger than a message can be.
  std::optional<UlogField> field(std::string_view type, std::string_view name) const;

 private:
  struct Member {
    std::string type, name;
    std::size_t count = 1;
  };

  std::size_t size_of_type(std::string_view type, std::size_t depth) const;

  std::map<std::string, std::vector<Member>, std::less<>> types_;
  mutable std::map<std::string, std::size_t, std::less<>> sizes_;  ///< found before
  std::size_t member_count_ = 0;
};

}  // namespace avoidbench
