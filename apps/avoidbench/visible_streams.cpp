#include "visible_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "base/visible_text.hpp"

namespace avoidbench {
namespace {

// What terminal_text() paints with.
constexpr std::array<std::string_view, 5> kOwnColours{"\033[0m", "\033[1m", "\033[2m", "\033[32m",
                                                      "\033[33m"};

/// Length of the colour at the start of `text`, or 0.
std::size_t colour_length(std::string_view text) {
  for (const std::string_view colour : kOwnColours) {
    if (text.starts_with(colour)) return colour.size();
  }
  return 0;
}

/// Hands on to another buffer what visible_text() makes of the text.
class VisibleBuffer : public std::streambuf {
 public:
  explicit VisibleBuffer(std::streambuf* target) : target_(target) {}

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char letter = traits_type::to_char_type(c);
    return xsputn(&letter, 1) == 1 ? c : traits_type::eof();
  }

  std::streamsize xsputn(const char* text, std::streamsize count) override {
    held_.append(text, static_cast<std::size_t>(count));
    const std::size_t length = held_.size() - unfinished_bytes(held_);
    const bool is_written = put(std::string_view(held_).substr(0, length));
    held_.erase(0, length);
    return is_written ? count : 0;
  }

  int sync() override {
    const bool is_written = put(held_);
    held_.clear();
    return is_written && target_->pubsync() == 0 ? 0 : -1;
  }

 private:
  bool put(std::string_view text) {
    std::string shown;
    while (!text.empty()) {
      const std::size_t colour = colour_length(text);
      shown += text.substr(0, colour);
      text.remove_prefix(colour);
      const std::size_t next = text.find('\033', colour == 0 && text.starts_with('\033') ? 1 : 0);
      shown += visible_text(text.substr(0, next));
      text.remove_prefix(std::min(text.size(), next));
    }
    const auto size = static_cast<std::streamsize>(shown.size());
    return target_->sputn(shown.data(), size) == size;
  }

  std::streambuf* target_;
  std::string held_;  ///< the beginning of a character whose rest is still to come
};

/// Standard error opened once more, to be written to without waiting: the flag is of the open file,
/// which this program shares with the shell and others. -1 where it never waits or can't be opened.
int open_error_again() {
  struct stat file {};
  // A file on a disk never waits, and opened again it would be written from its beginning.
  const bool may_wait = ::isatty(STDERR_FILENO) == 1 ||
                        (::fstat(STDERR_FILENO, &file) == 0 && S_ISFIFO(file.st_mode));
  if (!may_wait) return -1;
  return ::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

/// What was opened again while it is still what standard error is; else -1. In a child, or while
/// prints are captured, standard error is another file, and the number may be that of one.
int unwaiting_error() {
  static const int again = open_error_again();
  struct stat own {
  }, shared{};
  const bool is_same = again >= 0 && ::fstat(again, &own) == 0 &&
                       ::fstat(STDERR_FILENO, &shared) == 0 && own.st_dev == shared.st_dev &&
                       own.st_ino == shared.st_ino;
  return is_same ? again : -1;
}

/// Writes to standard error for as long as it takes something within `patience`; whether it took
/// all. What replaced it, as the capture of a planner's prints, is written to as ever.
bool write_error(std::string_view text, std::chrono::milliseconds patience) {
  // What a pipe takes whole where it says that it takes anything: PIPE_BUF.
  constexpr std::size_t kMostAtOnce = 4096;
  const int unwaiting = unwaiting_error();
  while (!text.empty()) {
    pollfd ready{.fd = unwaiting, .events = POLLOUT, .revents = 0};
    const int count = unwaiting >= 0 ? ::poll(&ready, 1, static_cast<int>(patience.count())) : 1;
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    const ssize_t written = ::write(unwaiting >= 0 ? unwaiting : STDERR_FILENO, text.data(),
                                    std::min(text.size(), kMostAtOnce));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Standard error. After one wait in vain it does not wait again until something was taken.
class ErrorBuffer : public std::streambuf {
 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char letter = traits_type::to_char_type(c);
    xsputn(&letter, 1);
    return c;
  }

  /// What is lost is no error: the next message may be seen.
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    constexpr std::chrono::seconds kPatience(10);
    const std::string_view all(text, static_cast<std::size_t>(count));
    if (all.empty()) return 0;
    is_stuck_ = !write_error(all, is_stuck_ ? std::chrono::seconds(0) : kPatience);
    return count;
  }

 private:
  bool is_stuck_ = false;
};

/// std::cout's own buffer, before make_streams_visible().
std::streambuf* plain_output() {
  static std::streambuf* const buffer = std::cout.rdbuf();
  return buffer;
}

}  // namespace

void make_streams_visible() {
  // Never destroyed: streams are written to until the very end of the program.
  plain_output();
  unwaiting_error();  // now: what a child has there is not the user's
  std::cout.rdbuf(new VisibleBuffer(std::cout.rdbuf()));
  std::cerr.rdbuf(new VisibleBuffer(new ErrorBuffer));
}

void show_at_once(std::string_view text) { write_error(text, std::chrono::seconds(0)); }

std::ostream& data_output() {
  static const bool is_terminal = ::isatty(STDOUT_FILENO) == 1;
  if (is_terminal) return std::cout;
  static std::ostream plain(plain_output());
  std::cout.flush();  // what was said before stands before
  return plain;
}

}  // namespace avoidbench
