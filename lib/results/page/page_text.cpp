#include "page/page_text.hpp"

#include <nlohmann/json.hpp>

namespace avoidbench {

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string script_safe(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size() + text.size() / 64);
  std::size_t from = 0;  // what is plain from here on is copied at once
  const auto replace = [&](std::size_t at, std::size_t size, std::string_view by) {
    out.append(text, from, at - from).append(by);
    from = at + size;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '<') {
      replace(i, 1, "\\u003c");
    } else if (text[i] == '>') {
      replace(i, 1, "\\u003e");
    } else if (text[i] == '&') {
      replace(i, 1, "\\u0026");
    } else if (text[i] == '\xe2') {
      // U+2028 and U+2029 end lines in scripts.
      const std::string_view letter = std::string_view(text).substr(i, 3);
      if (letter == "\xe2\x80\xa8") replace(i, 3, "\\u2028");
      if (letter == "\xe2\x80\xa9") replace(i, 3, "\\u2029");
    }
  }
  out.append(text, from);
  return out;
}

std::size_t size_in_page(const nlohmann::ordered_json& json) {
  return script_safe(json).size() + 1;  // with its comma
}

std::string page_text(const PageProgram& program, std::string_view title,
                      const nlohmann::ordered_json& data) {
  std::string page(program.head);
  page += html_text(title);
  page += program.body;
  page += script_safe(data);
  page += program.tail;
  return page;
}

}  // namespace avoidbench
