#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <string>

namespace avoidbench {

/// What a process prints, in memory of a fixed size. A descriptor leads to it that stands in for
/// the process's standard streams; writing to it never waits, and fails when it is full. Whoever
/// holds the descriptor's other copies sees what was printed, also after the process has died.
class PrintCapture {
 public:
  static constexpr std::size_t kBytes = std::size_t{256} << 10U;

  /// Where the system gives no memory for it, what is printed is lost.
  PrintCapture();
  ~PrintCapture();
  PrintCapture(PrintCapture&& other) noexcept;
  PrintCapture& operator=(PrintCapture&& other) noexcept;

  int fd() const { return fd_; }
  /// Forgets what was printed.
  void restart();
  /// What was printed since.
  std::string text() const;

 private:
  int fd_ = -1;
};

/// In the process that prints: makes room in the capture behind a descriptor before it is full.
class PrintTrimmer {
 public:
  static constexpr std::size_t kKeptHead = std::size_t{8} << 10U,
                               kKeptTail = std::size_t{24} << 10U,
                               kMostKept = std::size_t{64} << 10U;

  explicit PrintTrimmer(int fd);
  /// What is printed from now on is another text.
  void restart();
  /// Of a text that has grown beyond kMostKept, leaves out the middle and says so in its place.
  void trim();

 private:
  bool is_still() const;

  int fd_;
  struct stat file_ {};
  std::size_t left_out_ = 0, mark_size_ = 0;
};

/// The last line of a text that has anything to read; "" if there is none.
std::string last_line_of(const std::string& text);

}  // namespace avoidbench
