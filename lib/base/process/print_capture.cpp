#include "process/print_capture.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

namespace avoidbench {
namespace {

/// Where writing goes on: the file's own size is fixed.
std::size_t printed_bytes(int fd) {
  const off_t end = ::lseek(fd, 0, SEEK_CUR);
  if (end < 0) return 0;
  return std::min(static_cast<std::size_t>(end), PrintCapture::kBytes);
}

std::string bytes_at(int fd, std::size_t begin, std::size_t count) {
  std::string bytes(count, '\0');
  const ssize_t got = ::pread(fd, bytes.data(), count, static_cast<off_t>(begin));
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

/// What did not fit any more has left them in a state in which they print nothing.
void clear_streams() {
  std::clearerr(stdout);
  std::cout.clear();
  std::cerr.clear();
}

}  // namespace

PrintCapture::PrintCapture() {
  fd_ = ::memfd_create("avoidbench_prints", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  // Of this size for good: a planner can neither fill the memory nor take it away from a reader.
  const bool is_sized = fd_ >= 0 && ::ftruncate(fd_, static_cast<off_t>(kBytes)) == 0 &&
                        ::fcntl(fd_, F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK | F_SEAL_SEAL) == 0;
  if (is_sized) return;
  if (fd_ >= 0) ::close(fd_);
  // What is printed is lost then, and planners can print all the same.
  fd_ = ::open("/dev/null", O_RDWR | O_CLOEXEC);
}

PrintCapture::~PrintCapture() {
  if (fd_ >= 0) ::close(fd_);
}

PrintCapture::PrintCapture(PrintCapture&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

PrintCapture& PrintCapture::operator=(PrintCapture&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

void PrintCapture::restart() { ::lseek(fd_, 0, SEEK_SET); }

std::string PrintCapture::text() const { return bytes_at(fd_, 0, printed_bytes(fd_)); }

PrintTrimmer::PrintTrimmer(int fd) : fd_(fd) {
  if (::fstat(fd_, &file_) != 0) fd_ = -1;
}

void PrintTrimmer::restart() {
  left_out_ = mark_size_ = 0;
  clear_streams();
}

bool PrintTrimmer::is_still() const {
  // A planner may have closed it, and opened a file of its own under the same number.
  struct stat now {};
  return fd_ >= 0 && ::fstat(fd_, &now) == 0 && now.st_dev == file_.st_dev &&
         now.st_ino == file_.st_ino;
}

/// Head and tail stay; the mark between them says how much is gone, that of earlier times included.
void PrintTrimmer::trim() {
  if (fd_ < 0 || printed_bytes(fd_) <= kMostKept || !is_still()) return;
  const std::size_t end = printed_bytes(fd_);
  const std::string tail = bytes_at(fd_, end - kKeptTail, kKeptTail);
  left_out_ += end - kKeptTail - kKeptHead - mark_size_;
  const std::string kept = "\n[… " + std::to_string(left_out_) + " bytes left out …]\n" + tail;
  mark_size_ = kept.size() - tail.size();
  const ssize_t written = ::pwrite(fd_, kept.data(), kept.size(), static_cast<off_t>(kKeptHead));
  if (written < 0) return;
  ::lseek(fd_, static_cast<off_t>(kKeptHead + kept.size()), SEEK_SET);
}

std::string last_line_of(const std::string& text) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  const std::size_t before = text.find_last_of("\r\n", last);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, last + 1 - begin);
}

}  // namespace avoidbench
