// A real database in which values of any type stand in any column, rows are missing or twice, and
// texts are cut and patched: each command reads it or says InputError. The bytes choose the edits.
// The first one decides which command reads it and whether digests of rows are left in place.
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.hpp"
#include "fuzz/read_database.hpp"
#include "support/redigest.hpp"

namespace {

using namespace avoidbench::fuzz;

/// Takes bytes from the front; zeros when there are none left.
struct Bytes {
  const std::uint8_t* data;
  std::size_t size;

  std::uint8_t next() {
    if (size == 0) return 0;
    --size;
    return *data++;
  }
  std::string_view text(std::size_t most) {
    const std::size_t count = std::min(most, size);
    const std::string_view taken(reinterpret_cast<const char*>(data), count);
    data += count;
    size -= count;
    return taken;
  }
  template <class Number>
  Number number() {
    Number value{};
    for (std::size_t i = 0; i < sizeof value; ++i) {
      reinterpret_cast<unsigned char*>(&value)[i] = next();
    }
    return value;
  }
};

struct Column {
  std::string table, name;
};

void run(sqlite3* handle, const std::string& sql) {
  sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr);
}

std::vector<std::string> texts(sqlite3* handle, const std::string& sql) {
  std::vector<std::string> found;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) std::abort();
  while (sqlite3_step(statement) == SQLITE_ROW) {
    found.emplace_back(reinterpret_cast<const char*>(sqlite3_column_text(statement, 0)));
  }
  sqlite3_finalize(statement);
  return found;
}

/// The file's bytes without STRICT, so that any value goes anywhere, and its columns.
struct Template {
  std::vector<std::uint8_t> bytes;
  std::vector<Column> columns;
};

const Template& made_template() {
  static const Template made = [] {
    Template result;
    const std::filesystem::path file = scratch_folder() / "template.db";
    write_sample_database(file);
    sqlite3* handle = nullptr;
    if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) std::abort();
    for (const std::string& table :
         texts(handle, "SELECT name FROM sqlite_schema WHERE type = 'table'")) {
      for (std::string& name :
           texts(handle, "SELECT name FROM pragma_table_info('" + table + "')")) {
        result.columns.push_back({table, std::move(name)});
      }
    }
    run(handle,
        "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(replace(sql, ') "
        "STRICT, W', ') /*S*/ W'), ') STRICT', ') /*S*/') WHERE type = 'table'");
    sqlite3_close(handle);
    std::ifstream in(file, std::ios::binary);
    result.bytes.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    return result;
  }();
  return made;
}

constexpr std::array<double, 8> kOddNumbers{0.0,
                                            -1.0,
                                            1e300,
                                            -1e300,
                                            1e-320,
                                            9e15,
                                            std::numeric_limits<double>::infinity(),
                                            -std::numeric_limits<double>::infinity()};
constexpr std::array<std::int64_t, 8> kOddWholes{
    0, -1, 1, 255, 1'000'000'000, INT64_MAX, INT64_MIN, 2147483648};

/// Sets a column of one row, or of all.
void set_value(sqlite3* handle, const Column& column, Bytes& bytes) {
  const std::uint8_t row = bytes.next(), kind = bytes.next();
  const std::string name = '"' + column.name + '"';
  std::string value = "?1";
  if (kind % 8 == 6) value = "substr(" + name + ", 1, ?2) || ?1 || substr(" + name + ", ?2 + ?3)";
  if (kind % 8 == 7) value = "(SELECT " + name + " FROM " + column.table + " LIMIT 1 OFFSET ?2)";
  const std::string where = row % 8 == 7 ? ""
                                         : " WHERE " + name + " = (SELECT " + name + " FROM " +
                                               column.table + " LIMIT 1 OFFSET " +
                                               std::to_string(row % 8) + ")";
  const std::string sql =
      "UPDATE OR IGNORE " + column.table + " SET " + name + " = " + value + where;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) return;
  const auto bind_text = [&](std::string_view text) {
    sqlite3_bind_text(statement, 1, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  };
  switch (kind % 8) {
    case 0:
      break;  // NULL
    case 1:
      sqlite3_bind_int64(statement, 1, kOddWholes[bytes.next() % kOddWholes.size()]);
      break;
    case 2:
      sqlite3_bind_int64(statement, 1, bytes.number<std::int64_t>());
      break;
    case 3:
      sqlite3_bind_double(statement, 1, kOddNumbers[bytes.next() % kOddNumbers.size()]);
      break;
    case 4:
      bind_text(bytes.text(bytes.next()));
      break;
    case 5: {
      const std::string_view blob = bytes.text(bytes.next());
      sqlite3_bind_blob(statement, 1, blob.data(), static_cast<int>(blob.size()), SQLITE_TRANSIENT);
      break;
    }
    case 6:  // a patch of the text that is there
      sqlite3_bind_int(statement, 2, bytes.number<std::uint16_t>() % 4096);
      sqlite3_bind_int(statement, 3, bytes.next() % 32);
      bind_text(bytes.text(bytes.next() % 32));
      break;
    default:
      sqlite3_bind_int(statement, 2, bytes.next() % 8);
  }
  sqlite3_step(statement);
  sqlite3_finalize(statement);
}

void edit(sqlite3* handle, const Template& base, Bytes& bytes) {
  const std::uint8_t what = bytes.next();
  if (what % 16 == 0) {
    const Column& column = base.columns[bytes.next() % base.columns.size()];
    const std::string row = std::to_string(bytes.next() % 8);
    run(handle, "DELETE FROM " + column.table + " WHERE " + column.name + " = (SELECT " +
                    column.name + " FROM " + column.table + " LIMIT 1 OFFSET " + row + ")");
  } else {
    set_value(handle, base.columns[bytes.next() % base.columns.size()], bytes);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Template& base = made_template();
  const std::filesystem::path file = scratch_folder() / "edited.db";
  write_bytes(file, base.bytes);
  sqlite3* handle = nullptr;
  if (sqlite3_open(file.c_str(), &handle) != SQLITE_OK) std::abort();
  run(handle,
      "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY; PRAGMA "
      "ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
  Bytes bytes{data, size};
  const std::uint8_t first = bytes.next();
  const bool keeps_digests = first / kCommandCount % 4 == 0;
  while (bytes.size > 0) edit(handle, base, bytes);
  if (!keeps_digests) {
    try {
      avoidbench::test::redigest(handle);
    } catch (const avoidbench::InputError&) {  // damaged by an edit
    }
  }
  run(handle,
      "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(replace(sql, ') /*S*/ "
      "W', "
      "') STRICT, W'), ') /*S*/', ') STRICT') WHERE type = 'table'");
  sqlite3_close(handle);
  read_as_command_does(first % kCommandCount, file);
  return 0;
}
