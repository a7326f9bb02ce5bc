#include "base/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "base/digest.hpp"
#include "base/input_error.hpp"

namespace avoidbench {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  refuse_file(file, "can't be written: " + reason);
}

/// By how it begins, whatever it is called.
bool is_database(const std::filesystem::path& file) {
  std::error_code error;
  // Others, such as pipes, may wait for whoever writes.
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::string start(16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start.starts_with("SQLite format 3");
}

/// Whether SQLite takes it for a part of the database beside it, whose last rows may be there only.
bool is_part_of_database(const std::filesystem::path& file) {
  const std::string name = file.string();
  for (const std::string_view ending : {"-wal", "-shm", "-journal"}) {
    if (name.ends_with(ending) && is_database(name.substr(0, name.size() - ending.size()))) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::string safe_file_name(std::string_view text) {
  // 80 letters, a dash and 8 of the digest: a name made here is kept as it is if it comes again.
  constexpr std::size_t kMostLetters = 100, kMostKept = 80, kDigestLetters = 8;
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  };
  std::string name(text);
  for (char& c : name) c = is_plain(c) ? c : '_';
  // Hidden files, and what looks like an option.
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  const bool is_kept = name == text && !name.empty() && name.size() <= kMostLetters;
  if (is_kept) return name;
  // Texts that become the same name stay apart by their digests.
  const std::string digest = Digest().add_bytes(std::as_bytes(std::span(text))).hex();
  return name.substr(0, kMostKept) + "-" + digest.substr(0, kDigestLetters);
}

void check_output_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::is_directory(file, error)) refuse(file, "it is a folder");
  if (!std::filesystem::is_directory(folder, error)) refuse(file, "no folder " + folder.string());
  if (is_database(file)) {
    refuse(file, "it is a database (SQLite): delete it first, or name another file");
  }
  if (is_part_of_database(file)) {
    refuse(file, "SQLite would take it for part of the database next to it: name another file");
  }
  const std::filesystem::path& to_write = std::filesystem::exists(file, error) ? file : folder;
  if (::access(to_write.c_str(), W_OK) != 0) refuse(file, std::strerror(errno));
}

std::ofstream open_output(const std::filesystem::path& file) {
  check_output_file(file);
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) refuse(file, errno != 0 ? std::strerror(errno) : "it can't be opened");
  return stream;
}

void close_output(std::ofstream& stream, const std::filesystem::path& file) {
  stream.close();
  if (!stream) refuse_file(file, "writing failed; is the disk full?");
}

WholeFile::WholeFile(std::filesystem::path file)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  check_output_file(file_);
  restart();
}

WholeFile::~WholeFile() {
  stream_.close();
  std::error_code error;
  std::filesystem::remove(part_, error);
}

void WholeFile::restart() {
  stream_.close();
  stream_ = open_output(part_);
}

void WholeFile::check() const {
  if (!stream_) refuse_file(file_, "writing failed; is the disk full?");
}

void WholeFile::finish() {
  close_output(stream_, file_);
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) refuse(file_, error.message());
}

}  // namespace avoidbench
