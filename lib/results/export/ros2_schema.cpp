#include "export/ros2_schema.hpp"

#include <algorithm>

namespace avoidbench {

std::string Ros2Definitions::text() const {
  constexpr std::size_t kLine = 80;
  std::string text = texts_.front().second;
  for (std::size_t i = 1; i < texts_.size(); ++i) {
    const auto& [name, fields] = texts_[i];
    text += std::string(kLine, '=') + "\nMSG: " + short_name(name) + '\n' + fields;
  }
  return text;
}

bool Ros2Definitions::has(std::string_view name) const {
  return std::any_of(texts_.begin(), texts_.end(),
                     [name](const auto& known) { return known.first == name; });
}

std::string Ros2Definitions::short_name(std::string_view name) {
  constexpr std::string_view kMiddle = "/msg/";
  std::string text(name);
  return text.replace(text.find(kMiddle), kMiddle.size(), "/");
}

}  // namespace avoidbench
