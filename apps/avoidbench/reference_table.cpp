#include "reference_table.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/input_error.hpp"
#include "table/csv.hpp"
#include "table/table_text.hpp"
#include "text/visible_text.hpp"
#include "visible_streams.hpp"

namespace avoidbench {

enum class ReferenceFormat { table, csv, json, markdown };
template <>
struct EnumText<ReferenceFormat> {
  static constexpr std::pair<ReferenceFormat, std::string_view> entries[] = {
      {ReferenceFormat::table, "table"},
      {ReferenceFormat::csv, "csv"},
      {ReferenceFormat::json, "json"},
      {ReferenceFormat::markdown, "markdown"}};
};

namespace {

constexpr std::size_t kWidth = 100, kGap = 2;

std::string padded(const std::string& word, std::size_t width) {
  const std::size_t used = display_width(word);
  return word + std::string(width > used ? width - used : 0, ' ');
}

/// The table without control characters, each word on one line.
ReferenceTable visible_table(ReferenceTable table) {
  for (auto& row : table.rows) {
    for (std::string& word : row) word = visible_line(word);
  }
  return table;
}

std::string for_people(const ReferenceTable& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    widths.push_back(display_width(table.columns[i]));
    for (const auto& row : table.rows) widths[i] = std::max(widths[i], display_width(row[i]));
  }
  const auto line = [&](const std::vector<std::string>& row) {
    std::string text;
    std::size_t left = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      text += padded(row[i], widths[i] + kGap);
      left += widths[i] + kGap;
    }
    constexpr std::size_t kLeastWidth = 30;
    const std::size_t room = left + kLeastWidth < kWidth ? kWidth - left : kLeastWidth;
    std::string last = wrapped(row.back(), room, 0);
    for (std::size_t at = last.find('\n'); at != std::string::npos; at = last.find('\n', at + 1)) {
      last.insert(at + 1, std::string(left, ' '));
    }
    text += last;
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  };
  std::string text = line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string csv(const ReferenceTable& table) {
  const auto line = [](const std::vector<std::string>& row) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + csv_field(row[i]);
    return text + "\r\n";
  };
  std::string text = line(table.columns);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string json(const ReferenceTable& table) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i) object[table.columns[i]] = row[i];
    all.push_back(std::move(object));
  }
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string markdown(const ReferenceTable& table) {
  const auto line = [](const std::vector<std::string>& row) {
    std::string text = "|";
    for (const std::string& word : row) {
      text += ' ';
      for (const char c : word) text += c == '|' ? std::string("\\|") : std::string(1, c);
      text += " |";
    }
    return text + "\n";
  };
  std::string text = line(table.columns) + "|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) text += " --- |";
  text += "\n";
  for (const auto& row : table.rows) text += line(row);
  return text;
}

}  // namespace

void add_table_options(CLI::App& command, TableOptions& options) {
  command.add_option("--format", options.format, "table, csv, json or markdown")
      ->capture_default_str();
  command.add_option("--output", options.output, "File to write, - for standard output")
      ->capture_default_str();
}

std::string table_text(const ReferenceTable& table, const std::string& format) {
  const auto known = enum_from_text<ReferenceFormat>(format);
  if (!known) {
    throw InputError("--format " + format + ": unknown" +
                     did_you_mean(format, enum_texts<ReferenceFormat>()) +
                     "; it is one of table, csv, json, markdown");
  }
  switch (*known) {
    case ReferenceFormat::csv:
      return csv(table);
    case ReferenceFormat::json:
      return json(table);
    case ReferenceFormat::markdown:
      return markdown(visible_table(table));
    case ReferenceFormat::table:
      break;
  }
  return for_people(visible_table(table));
}

void write_text(const std::string& text, const std::string& output) {
  if (output == "-") {
    data_output() << text << std::flush;
    if (!data_output()) throw InputError("standard output can't be written");
    return;
  }
  std::ofstream file(output, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw InputError(InputProblem{output, 0, 0, "can't be written"});
}

void write_table(const ReferenceTable& table, const TableOptions& options) {
  write_text(table_text(table, options.format), options.output);
}

}  // namespace avoidbench
