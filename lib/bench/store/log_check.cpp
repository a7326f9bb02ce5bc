#include "store/log_check.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

// Numbers of https://sqlite.org/fileformat2.html: all are stored with the highest byte first.
using FileHeader = std::array<unsigned char, 100>;

std::uint32_t number_at(std::span<const unsigned char> bytes, std::size_t at) {
  return (std::uint32_t{bytes[at]} << 24U) | (std::uint32_t{bytes[at + 1]} << 16U) |
         (std::uint32_t{bytes[at + 2]} << 8U) | std::uint32_t{bytes[at + 3]};
}

std::uint32_t page_bytes_of(const FileHeader& header) {
  const std::uint32_t bytes = number_at(header, 14) & 0xffffU;
  return bytes == 1 ? 65536 : bytes;  // which is one too large for its two bytes
}
bool is_sqlite(const FileHeader& header) {
  constexpr std::string_view kBegin("SQLite format 3\0", 16);
  return std::memcmp(header.data(), kBegin.data(), kBegin.size()) == 0;
}
/// Formats for writing and reading: 2 with a log, 1 without. SQLite sets 2 before it makes a log,
/// and 1 after it has deleted it.
bool has_log_mode(const FileHeader& header) { return header[18] == 2 && header[19] == 2; }
/// Opens change the schema, which adds to the lower half; transactions count from here.
constexpr std::uint32_t kFirstTransaction = 1024;
constexpr std::uint32_t kMostRunStep = 256;
std::uint32_t run_of(std::uint32_t cookie) { return cookie >> 16U; }
std::uint32_t transaction_of(std::uint32_t cookie) { return cookie & 0xffffU; }

std::uint32_t change_counter(const FileHeader& header) { return number_at(header, 24); }
std::uint32_t schema_cookie(const FileHeader& header) { return number_at(header, 40); }

/// What SQLite would take from a log: its frames up to the last one that commits.
struct LogContents {
  std::uint32_t page_bytes = 0;
  std::uint32_t page_count = 0;     ///< of the database after the last commit; 0: none is committed
  std::vector<FileHeader> headers;  ///< of the database's first page, in the order of writing
  std::vector<std::uint32_t> pages;  ///< that the log holds, in order

  bool operator==(const LogContents&) const = default;
};

/// The log's checksum: of pairs of 32-bit words, from its beginning on.
class Checksum {
 public:
  explicit Checksum(bool is_big_endian) : is_big_endian_(is_big_endian) {}
  void add(std::span<const unsigned char> bytes) {
    for (std::size_t i = 0; i + 8 <= bytes.size(); i += 8) {
      first_ += word(bytes, i) + second_;
      second_ += word(bytes, i + 4) + first_;
    }
  }
  bool is_at(std::span<const unsigned char> bytes, std::size_t at) const {
    return number_at(bytes, at) == first_ && number_at(bytes, at + 4) == second_;
  }

 private:
  std::uint32_t word(std::span<const unsigned char> bytes, std::size_t at) const {
    const std::uint32_t big = number_at(bytes, at);
    return is_big_endian_ ? big : __builtin_bswap32(big);
  }

  bool is_big_endian_;
  std::uint32_t first_ = 0, second_ = 0;
};

bool read_all(std::ifstream& file, std::span<unsigned char> bytes) {
  return static_cast<bool>(
      file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())));
}

/// Nothing where there is no log, or none that SQLite would read.
LogContents read_log(const std::filesystem::path& path) {
  constexpr std::size_t kHeaderBytes = 32, kFrameHeaderBytes = 24;
  LogContents log;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return log;
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, kHeaderBytes> header{};
  if (!read_all(file, header)) return log;
  const std::uint32_t magic = number_at(header, 0);
  log.page_bytes = number_at(header, 8);
  const bool is_size = log.page_bytes >= 512 && log.page_bytes <= 65536 &&
                       (log.page_bytes & (log.page_bytes - 1)) == 0;
  if ((magic & ~1U) != 0x377f0682U || !is_size) return log;
  Checksum checksum((magic & 1U) != 0);
  checksum.add(std::span(header).first(24));
  if (!checksum.is_at(header, 24)) return log;
  std::vector<unsigned char> frame(kFrameHeaderBytes + log.page_bytes);
  std::size_t header_count = 0, page_count = 0;  // of what is committed
  while (read_all(file, frame)) {
    const std::uint32_t page = number_at(frame, 0), database_pages = number_at(frame, 4);
    // Each generation of a log has its own salt; what is left of the one before is no frame of it.
    if (page == 0 || !std::equal(&frame[8], &frame[16], &header[16])) break;
    checksum.add(std::span(frame).first(8));
    checksum.add(std::span(frame).subspan(kFrameHeaderBytes));
    if (!checksum.is_at(frame, 16)) break;
    log.pages.push_back(page);
    if (page == 1) {
      std::copy_n(&frame[kFrameHeaderBytes], FileHeader{}.size(),
                  log.headers.emplace_back().begin());
    }
    if (database_pages == 0) continue;
    log.page_count = database_pages;
    header_count = log.headers.size();
    page_count = log.pages.size();
  }
  log.headers.resize(header_count);
  log.pages.resize(page_count);
  std::sort(log.pages.begin(), log.pages.end());
  return log;
}

struct FileStart {
  FileHeader header{};
  std::int64_t bytes = 0;  ///< of the whole file

  bool operator==(const FileStart&) const = default;
};

/// By SQLite's own descriptor: closing another one would drop the locks that this process may have
/// on the file.
FileStart read_start(sqlite3* handle) {
  FileStart start;
  sqlite3_file* file = nullptr;
  sqlite3_file_control(handle, "main", SQLITE_FCNTL_FILE_POINTER, &file);
  if (file == nullptr || file->pMethods == nullptr) return start;
  sqlite3_int64 bytes = 0;
  if (file->pMethods->xFileSize(file, &bytes) == SQLITE_OK) start.bytes = bytes;
  // A shorter file is filled up with zeros.
  file->pMethods->xRead(file, start.header.data(), static_cast<int>(start.header.size()), 0);
  return start;
}

/// Whether the transaction with the second cookie may be the one after that with the first.
bool is_next(std::uint32_t before, std::uint32_t after) {
  constexpr std::uint32_t kMostChanges = 64;  // of the schema by another program
  if (after - before <= 1) return true;       // another program may leave it as it is
  if (transaction_of(after) >= kFirstTransaction) {
    return after == cookie_of_next_transaction(before);
  }
  const std::uint32_t runs = (run_of(after) - run_of(before)) & 0xffffU;
  return runs == 0 ? after - before < kMostChanges : runs <= kMostRunStep;
}

/// Whether the log goes on from the file's first page, or holds that very page.
bool continues(const FileHeader& file, const LogContents& log) {
  if (log.headers.empty() || schema_cookie(file) == 0) return true;  // 0: without any table yet
  const bool is_taken_in =
      std::find(log.headers.begin(), log.headers.end(), file) != log.headers.end();
  if (is_taken_in) return true;
  const FileHeader& first = log.headers.front();
  // A writer counts when it first changes the file, not at each commit to the log.
  return change_counter(first) - change_counter(file) <= 1 &&
         is_next(schema_cookie(file), schema_cookie(first));
}

/// Whether each page of the database is in the file or the log.
bool is_whole(std::int64_t file_bytes, const LogContents& log) {
  constexpr std::uint32_t kLockByte = 0x40000000;  // the page of SQLite's locks is never written
  const std::uint32_t lock_page = kLockByte / log.page_bytes + 1;
  auto next = log.pages.begin();
  const std::int64_t in_file = file_bytes / log.page_bytes;
  for (std::int64_t page = in_file + 1; page <= log.page_count; ++page) {
    next = std::lower_bound(next, log.pages.end(), page);
    const bool is_there = next != log.pages.end() && *next == page;
    if (!is_there && page != lock_page) return false;
  }
  return true;
}

bool fits(const FileStart& file, const LogContents& log) {
  if (log.page_count == 0) return true;
  return is_sqlite(file.header) && has_log_mode(file.header) &&
         page_bytes_of(file.header) == log.page_bytes && continues(file.header, log) &&
         is_whole(file.bytes, log);
}

}  // namespace

std::uint32_t cookie_of_next_run(std::uint32_t cookie, bool is_new_file) {
  std::uint32_t random = 0;
  sqlite3_randomness(sizeof random, &random);
  // A new file begins anywhere; a step that is not too large still tells whose file it was.
  const std::uint32_t step = is_new_file ? random : 1 + random % kMostRunStep;
  return ((run_of(cookie) + step) & 0xffffU) << 16U;
}

std::uint32_t cookie_of_next_transaction(std::uint32_t cookie) {
  return transaction_of(cookie) < kFirstTransaction ? (cookie & 0xffff0000U) + kFirstTransaction
                                                    : cookie + 1;
}

void check_log(sqlite3* handle, const std::filesystem::path& file) {
  // What another process writes meanwhile may be seen by halves: only what stands still is judged,
  // and where nothing does, that process has long found its log to be the right one.
  constexpr int kTries = 20, kMisfits = 2;
  constexpr std::chrono::milliseconds kPause{20};
  const std::filesystem::path path = file.string() + "-wal";
  int misfits = 0;
  for (int i = 0; i < kTries && misfits < kMisfits; ++i) {
    const FileStart before = read_start(handle);
    const LogContents log = read_log(path);
    if (fits(before, log)) return;
    std::this_thread::sleep_for(kPause);
    const bool stands_still = read_start(handle) == before && read_log(path) == log;
    misfits += stands_still ? 1 : 0;
  }
  if (misfits < kMisfits) return;
  refuse_file(file, "next to it is " + path.filename().string() +
                        ", the log of another file of that name, from a run that was killed: the "
                        "two don't belong together. Both are left as they are. If " +
                        file.filename().string() + " is the file that you want, move " +
                        path.filename().string() +
                        " away; if you want the killed run's results, put its file back");
}

void check_no_lost_log(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (!error && bytes > 0) return;
  const std::filesystem::path path = file.string() + "-wal";
  if (read_log(path).page_count == 0) return;
  refuse_file(file, std::string(error ? "is not there" : "is empty") + ", but its log " +
                        path.filename().string() +
                        " is, with rows that a killed run has committed: put the file back, or "
                        "move the log away");
}

}  // namespace avoidbench
