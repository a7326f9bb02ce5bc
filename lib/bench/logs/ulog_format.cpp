#include "logs/ulog_format.hpp"

#include <utility>

#include "base/number_text.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostUlogMessageBytes = 65535;
constexpr std::size_t kMostUlogDepth = 16;
constexpr std::size_t kMostUlogMembers = 200'000;  // of all types together

struct PlainType {
  std::string_view name;
  UlogType type;
  std::size_t bytes;
};

const PlainType* plain_type(std::string_view name) {
  static constexpr PlainType kTypes[] = {
      {"int8_t", UlogType::i8, 1},   {"uint8_t", UlogType::u8, 1},
      {"int16_t", UlogType::i16, 2}, {"uint16_t", UlogType::u16, 2},
      {"int32_t", UlogType::i32, 4}, {"uint32_t", UlogType::u32, 4},
      {"int64_t", UlogType::i64, 8}, {"uint64_t", UlogType::u64, 8},
      {"float", UlogType::f32, 4},   {"double", UlogType::f64, 8},
      {"bool", UlogType::u8, 1},     {"char", UlogType::u8, 1}};
  for (const PlainType& type : kTypes) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

std::size_t bytes_of(UlogType type) {
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

}  // namespace

double UlogField::in(std::string_view message, std::size_t index) const {
  const std::size_t start = place + index * bytes_of(type);
  if (start + bytes_of(type) > message.size()) throw BadMessage("it is too short for its format");
  const auto as = [&]<class T>(T) { return static_cast<double>(load_ulog<T>(message, start)); };
  switch (type) {
    case UlogType::i8:
      return as(std::int8_t{});
    case UlogType::u8:
      return as(std::uint8_t{});
    case UlogType::i16:
      return as(std::int16_t{});
    case UlogType::u16:
      return as(std::uint16_t{});
    case UlogType::i32:
      return as(std::int32_t{});
    case UlogType::u32:
      return as(std::uint32_t{});
    case UlogType::i64:
      return as(std::int64_t{});
    case UlogType::u64:
      return as(std::uint64_t{});
    case UlogType::f32:
      return as(float{});
    case UlogType::f64:
      return as(double{});
  }
  return 0.0;
}

void UlogFormats::add(std::string_view definition) {
  const std::size_t colon = definition.find(':');
  if (colon == definition.npos) throw BadMessage("a format without a name");
  std::vector<Member> members;
  std::string_view rest = definition.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t end = rest.find(';');
    const std::string_view field = rest.substr(0, end);
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    const std::size_t blank = field.find(' ');
    if (blank == field.npos) throw BadMessage("a format's field without a name");
    std::string_view type = field.substr(0, blank);
    Member member{.type = {}, .name = std::string(field.substr(blank + 1))};
    if (const std::size_t bracket = type.find('['); bracket != type.npos) {
      const auto count =
          type.ends_with(']')
              ? number_from<std::uint32_t>(type.substr(bracket + 1, type.size() - bracket - 2))
              : std::nullopt;
      if (!count || *count > kMostUlogMessageBytes) throw BadMessage("a format's field of no size");
      member.count = *count;
      type = type.substr(0, bracket);
    }
    member.type = type;
    members.push_back(std::move(member));
    if (++member_count_ > kMostUlogMembers) throw BadMessage("formats of more than 200000 fields");
  }
  types_.insert_or_assign(std::string(definition.substr(0, colon)), std::move(members));
  sizes_.clear();
}

std::size_t UlogFormats::size_of_type(std::string_view type, std::size_t depth) const {
  if (const PlainType* plain = plain_type(type)) return plain->bytes;
  if (const auto found = sizes_.find(type); found != sizes_.end()) return found->second;
  const auto members = types_.find(type);
  if (members == types_.end())
    throw BadMessage("the type " + std::string(type) + " is not defined");
  if (depth == kMostUlogDepth) throw BadMessage("a type that contains itself");
  std::size_t size = 0;
  for (const Member& member : members->second) {
    size += member.count * size_of_type(member.type, depth + 1);
    if (size > kMostUlogMessageBytes) throw BadMessage("a type that is larger than any message");
  }
  sizes_.emplace(type, size);
  return size;
}

std::optional<UlogField> UlogFormats::field(std::string_view type, std::string_view name) const {
  const auto members = types_.find(type);
  if (members == types_.end()) {
    throw BadMessage("a topic of the type " + std::string(type) + ", which is not defined");
  }
  std::size_t place = 0;
  for (const Member& member : members->second) {
    const PlainType* plain = plain_type(member.type);
    if (member.name == name && plain != nullptr) {
      return UlogField{.place = place, .type = plain->type, .count = member.count};
    }
    place += member.count * size_of_type(member.type, 0);
    if (place > kMostUlogMessageBytes) throw BadMessage("a type that is larger than any message");
  }
  return std::nullopt;
}

}  // namespace avoidbench
