#include <sqlite3.h>

#include <cstddef>
#include <map>
#include <memory>
#include <system_error>

#include "base/input_error.hpp"
#include "base/poll.hpp"
#include "logs/log_readers.hpp"

// rosbag2's storage `sqlite3`: the tables topics and messages. The room `store` knows SQLite
// better, but its messages are about databases of results, and it knows the simulator.
namespace avoidbench {
namespace {

constexpr int kMostRowBytes = 64 << 20;
constexpr std::int64_t kMostDb3MessageBytes = 1 << 20;  // of one that has poses

struct CloseDb3 {
  void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Db3 = std::unique_ptr<sqlite3, CloseDb3>;

[[noreturn]] void throw_db3_error(sqlite3* handle, int code, const std::filesystem::path& file) {
  const std::string message = handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  const int primary_code = code & 0xff;
  const bool is_damaged = primary_code == SQLITE_CORRUPT || primary_code == SQLITE_NOTADB;
  refuse_file(file, is_damaged ? "damaged (SQLite: " + message +
                                     "); `sqlite3 FILE .recover` saves what can be read"
                               : "can't be read (SQLite: " + message + ")");
}

/// A query. Numbers are SQLite's: its columns are whole numbers or damage.
class Db3Query {
 public:
  Db3Query(sqlite3* handle, const std::filesystem::path& file, const char* sql)
      : handle_(handle), file_(file) {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v2(handle, sql, -1, &statement, nullptr);
    if (code != SQLITE_OK) throw_db3_error(handle, code, file);
    statement_.reset(statement);
  }

  /// Begins again with this parameter.
  void restart(std::int64_t parameter) {
    sqlite3_reset(statement_.get());
    sqlite3_bind_int64(statement_.get(), 1, parameter);
  }
  bool step() {
    poll_caller();
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) throw_db3_error(handle_, code, file_);
    return code == SQLITE_ROW;
  }
  std::int64_t integer(int column) const {
    if (sqlite3_column_type(statement_.get(), column) != SQLITE_INTEGER) {
      damaged(std::string(sqlite3_column_name(statement_.get(), column)) +
              " is not a whole number");
    }
    return sqlite3_column_int64(statement_.get(), column);
  }
  /// Bytes or text. Valid until the next step.
  std::string_view bytes(int column) const {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
    const int size = sqlite3_column_bytes(statement_.get(), column);
    return data == nullptr ? std::string_view()
                           : std::string_view(data, static_cast<std::size_t>(size));
  }
  /// Throws that this row is damaged; its first column is its number.
  [[noreturn]] void damaged(const std::string& what) const {
    const std::int64_t row = sqlite3_column_int64(statement_.get(), 0);
    refuse_file(file_, "damaged at row " + std::to_string(row) + " of " +
                           sqlite3_column_name(statement_.get(), 0) + ": " + what);
  }

 private:
  sqlite3* handle_;
  const std::filesystem::path& file_;
  std::unique_ptr<sqlite3_stmt, CloseDb3> statement_;
};

/// `file` as a URI, for the option that SQLite takes no other way.
std::string immutable_uri(const std::filesystem::path& file) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    uri += '%';
    uri += kDigits[byte >> 4U];
    uri += kDigits[byte & 15U];
  }
  return uri + "?immutable=1";
}

/// Opens a file of a stranger to read it: nothing that its schema says is run. Where no log of the
/// recorder's lies beside it, nothing is locked or written, so that it may lie in a folder that
/// can't be written.
Db3 open_db3(const std::filesystem::path& file) {
  std::error_code error;
  const bool has_log = std::filesystem::exists(file.string() + "-wal", error) ||
                       std::filesystem::exists(file.string() + "-journal", error);
  sqlite3* opened = nullptr;
  const std::string name = has_log ? file.string() : immutable_uri(file);
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | (has_log ? 0 : SQLITE_OPEN_URI);
  const int code = sqlite3_open_v2(name.c_str(), &opened, flags, nullptr);
  Db3 handle(opened);
  if (code != SQLITE_OK) throw_db3_error(opened, code, file);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_limit(opened, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kMostRowBytes);
  sqlite3_exec(opened, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
  return handle;
}

void check_tables(sqlite3* handle, const std::filesystem::path& file) {
  Db3Query tables(handle, file,
                  "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND rootpage > 0 AND "
                  "name IN ('topics', 'messages')");
  if (!tables.step() || tables.integer(0) != 2) {
    refuse_file(
        file,
        "an SQLite file, but not a recording of rosbag2: it has no tables topics and messages");
  }
}

struct Db3Topic {
  std::size_t topic = 0;
  std::string encoding;
};

std::map<std::int64_t, Db3Topic> read_db3_topics(sqlite3* handle, const std::filesystem::path& file,
                                                 FlightBuilder& flight) {
  Db3Query rows(handle, file,
                "SELECT rowid AS topics, id, name, type, serialization_format FROM topics");
  std::map<std::int64_t, Db3Topic> topics;
  while (rows.step()) {
    try {
      topics[rows.integer(1)] = {.topic = flight.topic(rows.bytes(2), rows.bytes(3)),
                                 .encoding = std::string(rows.bytes(4).substr(0, 64))};
    } catch (const BadMessage& bad) {
      rows.damaged(bad.what());
    }
  }
  return topics;
}

}  // namespace

void read_db3(const std::filesystem::path& file, FlightBuilder& flight) {
  flight.set_format("rosbag2 (SQLite)");
  const Db3 handle = open_db3(file);
  check_tables(handle.get(), file);
  const auto topics = read_db3_topics(handle.get(), file, flight);
  // Two queries: SQLite reads only the columns asked for, and most messages are images of no
  // interest here.
  Db3Query rows(handle.get(), file, "SELECT rowid AS messages, topic_id, timestamp FROM messages");
  Db3Query row(handle.get(), file, "SELECT length(data), data FROM messages WHERE rowid = ?");
  while (rows.step()) {
    const auto topic = topics.find(rows.integer(1));
    if (topic == topics.end()) rows.damaged("its topic is not in the table topics");
    if (!flight.wants_message(topic->second.topic)) continue;
    if (topic->second.encoding != "cdr") {
      rows.damaged("messages of the serialization '" + topic->second.encoding +
                   "'; only cdr is supported");
    }
    row.restart(rows.integer(0));
    if (!row.step()) rows.damaged("it can't be found again");
    if (row.integer(0) > kMostDb3MessageBytes) rows.damaged("it is longer than its type");
    try {
      flight.read_message(topic->second.topic, {row.bytes(1), MessageEncoding::cdr},
                          rows.integer(2));
    } catch (const BadMessage& bad) {
      rows.damaged(bad.what());
    }
  }
}

}  // namespace avoidbench
