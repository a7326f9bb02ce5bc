#include "process/print_capture.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace avoidbench {
namespace {

void print(const PrintCapture& capture, const std::string& text) {
  ASSERT_EQ(::write(capture.fd(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

/// Standard output and error of this process go to `capture` for as long as it lives, as a worker's
/// do.
class PrintsCaptured {
 public:
  explicit PrintsCaptured(const PrintCapture& capture)
      : out_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)),
        err_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    flush();
    ::dup2(capture.fd(), STDOUT_FILENO);
    ::dup2(capture.fd(), STDERR_FILENO);
  }
  ~PrintsCaptured() {
    flush();
    ::__fpurge(stdout);  // what did not fit is lost, and must not come out later
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
    ::close(out_);
    ::close(err_);
    std::clearerr(stdout);
    std::cout.clear();
    std::cerr.clear();
  }
  PrintsCaptured(const PrintsCaptured&) = delete;
  PrintsCaptured& operator=(const PrintsCaptured&) = delete;

 private:
  static void flush() {
    std::cout << std::flush;
    std::cerr << std::flush;
    std::fflush(nullptr);
  }
  int out_, err_;
};

TEST(PrintCapture, HoldsBothStreamsInOrderAndForgets) {
  PrintCapture capture;
  {
    const PrintsCaptured captured(capture);
    std::printf("one\n");
    std::fflush(stdout);
    std::cerr << "two\n";
    std::cout << "three" << std::flush;
  }
  EXPECT_EQ(capture.text(), "one\ntwo\nthree");
  capture.restart();
  EXPECT_EQ(capture.text(), "");
}

TEST(PrintCapture, StreamsPrintAgainAfterItWasFull) {
  PrintCapture capture, later;
  {
    const PrintsCaptured captured(capture);
    for (std::size_t i = 0; i < PrintCapture::kBytes; ++i) std::fputs("full", stdout);
    std::cout << std::string(100'000, 'c') << std::flush;
  }
  const PrintsCaptured captured(later);
  std::fputs("one", stdout);
  std::fflush(stdout);
  std::cout << "two" << std::flush;
  EXPECT_EQ(later.text(), "onetwo");
}

TEST(PrintCapture, IsOfAFixedSize) {
  PrintCapture capture;
  print(capture, std::string(PrintCapture::kBytes, 'a'));
  EXPECT_EQ(::write(capture.fd(), "b", 1), -1);
  EXPECT_NE(::ftruncate(capture.fd(), 1), 0);
  EXPECT_EQ(capture.text(), std::string(PrintCapture::kBytes, 'a'));
  // A planner may put the place to write to anywhere.
  ::lseek(capture.fd(), 1LL << 40U, SEEK_SET);
  EXPECT_EQ(capture.text().size(), PrintCapture::kBytes);
}

TEST(PrintTrimmer, KeepsBeginningAndEndOfWhatIsLong) {
  PrintCapture capture;
  PrintTrimmer trimmer(capture.fd());
  print(capture, "begin " + std::string(100'000, 'x'));
  trimmer.trim();
  print(capture, std::string(60'000, 'y'));
  trimmer.trim();
  print(capture, " end");
  trimmer.trim();
  const std::string text = capture.text();
  EXPECT_TRUE(text.starts_with("begin xxx"));
  EXPECT_TRUE(text.ends_with("yyy end"));
  const std::size_t kept = PrintTrimmer::kKeptHead + PrintTrimmer::kKeptTail;
  const std::size_t left_out = 6 + 100'000 + 60'000 - kept;
  const std::string mark = "\n[… " + std::to_string(left_out) + " bytes left out …]\n";
  EXPECT_NE(text.find(mark), std::string::npos) << text.substr(PrintTrimmer::kKeptHead, 60);
  EXPECT_EQ(text.size(), kept + mark.size() + 4);
}

TEST(PrintTrimmer, LeavesAFileAloneThatTookTheNumberOfTheCapture) {
  PrintCapture capture;
  const int fd = ::dup(capture.fd());
  PrintTrimmer trimmer(fd);
  std::FILE* other = std::tmpfile();
  ASSERT_NE(other, nullptr);
  ::dup2(::fileno(other), fd);
  const std::string text(100'000, 'z');
  ASSERT_EQ(::write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  trimmer.trim();
  EXPECT_EQ(::lseek(fd, 0, SEEK_CUR), 100'000);
  ::close(fd);
  std::fclose(other);
}

TEST(LastLineOf, IsTheLastWithAnythingToRead) {
  EXPECT_EQ(last_line_of("first\n  what(): lost\n\n \n"), "  what(): lost");
  EXPECT_EQ(last_line_of("only"), "only");
  EXPECT_EQ(last_line_of("\n \r\n"), "");
}

}  // namespace
}  // namespace avoidbench
