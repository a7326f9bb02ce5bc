#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace avoidbench {

/// A table of words, as `planners list` and `metrics` print: for results see report/table.hpp.
struct ReferenceTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`
};

struct TableOptions {
  std::string format = "table";
  std::string output = "-";
};

/// Adds --format and --output.
void add_table_options(CLI::App& command, TableOptions& options);

/// The table as text that ends with a newline. For people (`table`) the last column is wrapped so
/// that lines stay within 100 terminal columns; csv is RFC 4180; json is an array of objects.
std::string table_text(const ReferenceTable& table, const std::string& format);

/// Writes the text to options.output. Throws InputError where that can't be written.
void write_text(const std::string& text, const std::string& output);
void write_table(const ReferenceTable& table, const TableOptions& options);

}  // namespace avoidbench
