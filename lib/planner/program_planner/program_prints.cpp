#include "program_planner/program_prints.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_error.hpp"
#include "base/visible_text.hpp"

namespace avoidbench {
namespace {

std::atomic<int> prints_fd{-1};

// last_lines() tells three lines of it.
constexpr std::size_t kMostTail = 4096;
constexpr std::size_t kMostPassedOn = 16384;  // of what one look finds: floods are cut

void pass_on(std::string_view words) {
  const int fd = prints_fd;
  if (fd < 0) return;
  if (words.size() > kMostPassedOn) words.remove_prefix(words.size() - kMostPassedOn);
  // A full capture takes no more: what is lost is only shown.
  [[maybe_unused]] const ssize_t written = ::write(fd, words.data(), words.size());
}

}  // namespace

void pass_prints_on(int fd) { prints_fd = fd; }

ProgramPrints::ProgramPrints() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw InputError(std::string("can't start a planner's program: pipe: ") + std::strerror(errno));
  }
  read_fd_ = ends[0];
  write_fd_ = ends[1];
  ::fcntl(read_fd_, F_SETFL, O_NONBLOCK);  // the program's end waits where the pipe is full
}

ProgramPrints::~ProgramPrints() {
  ::close(read_fd_);
  close_write_end();
}

void ProgramPrints::close_write_end() {
  if (write_fd_ >= 0) ::close(std::exchange(write_fd_, -1));
}

bool ProgramPrints::drain() {
  // Half a megabyte a look: who prints without end must not keep the host from the answer.
  constexpr int kMostReads = 8;
  std::array<char, 65536> bytes;
  for (int i = 0; i < kMostReads && is_open_; ++i) {
    const ssize_t count = ::read(read_fd_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return true;
    is_open_ = count > 0;
    if (!is_open_) break;
    const std::string_view words(bytes.data(), static_cast<std::size_t>(count));
    pass_on(words);
    tail_ += words;
    if (tail_.size() > kMostTail) tail_.erase(0, tail_.size() - kMostTail);
  }
  return is_open_;
}

std::string ProgramPrints::last_lines() const {
  constexpr std::size_t kMostLines = 3, kMostBytes = 300;
  std::vector<std::string> lines;
  std::string_view rest = tail_;
  while (!rest.empty() && lines.size() < kMostLines) {
    const std::size_t end = rest.find_last_not_of(" \t\r\n");
    if (end == std::string_view::npos) break;
    rest = rest.substr(0, end + 1);
    const std::size_t begin = rest.find_last_of("\r\n");
    const std::size_t first = begin == std::string_view::npos ? 0 : begin + 1;
    const std::size_t text = rest.find_first_not_of(" \t", first);
    lines.push_back(visible_line(rest.substr(text)));
    rest = rest.substr(0, first);
  }
  std::string all;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    all += (all.empty() ? "" : " / ") + *line;
  }
  if (all.size() > kMostBytes) {
    std::string_view cut = std::string_view(all).substr(all.size() - kMostBytes);
    while (!cut.empty() && (static_cast<unsigned char>(cut.front()) & 0xC0U) == 0x80U) {
      cut.remove_prefix(1);  // not in the middle of a character
    }
    all = "…" + std::string(cut);
  }
  return all;
}

}  // namespace avoidbench
