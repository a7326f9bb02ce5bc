#include "base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/input_error.hpp"
#include "base/poll.hpp"

namespace avoidbench {
namespace {

constexpr std::size_t kMostAtOnce = std::size_t{1} << 24U;  // then whoever waits is asked again

/// Whether the path names a descriptor that this process was started with.
bool is_held(const std::filesystem::path& path) {
  const std::string folder = path.parent_path().string();
  return folder == "/dev/fd" || folder == "/proc/self/fd" || path == "/dev/stdin";
}

/// Regular files, and pipes that this process was given.
void check_kind(const std::filesystem::path& path, mode_t mode) {
  if (S_ISREG(mode) || (S_ISFIFO(mode) && is_held(path))) return;
  if (S_ISDIR(mode)) refuse_file(path, "is a folder, not a file");
  const char* kind = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  refuse_file(path,
              std::string("is ") + kind + ", not a regular file: write its output to a file first");
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, std::uint64_t most_bytes)
    : path_(path), most_bytes_(most_bytes) {
  // Looked at before it is opened, which may itself do something to a device; and after, since
  // another file may have taken its place.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const bool is_missing = errno == ENOENT || errno == ENOTDIR;
    if (errno == ELOOP) refuse_file(path, "is a symbolic link in a loop");
    refuse_file(
        path, is_missing ? "no such file" : std::string("can't be read: ") + std::strerror(errno));
  }
  check_kind(path, status.st_mode);
  // Not to wait for a pipe's writer yet, nor to make a terminal this process's own.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) refuse_file(path, std::string("can't be read: ") + std::strerror(errno));
  try {
    if (::fstat(descriptor_, &status) != 0) refuse_file(path, "can't be read");
    check_kind(path, status.st_mode);
    if (S_ISFIFO(status.st_mode)) {  // waits for its writer
      ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
    }
    size_bytes_ = static_cast<std::uint64_t>(status.st_size);
    check_size(size_bytes_);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

InputFile::~InputFile() { ::close(descriptor_); }

void InputFile::check_size(std::uint64_t bytes) const {
  constexpr std::uint64_t kMega = 1'000'000;
  if (bytes <= most_bytes_) return;
  refuse_file(path_, "is larger than " + std::to_string(most_bytes_ / kMega) + " MB");
}

std::size_t InputFile::read(std::span<char> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    poll_caller();
    const std::size_t piece = std::min(bytes.size() - filled, kMostAtOnce);
    const ssize_t count = ::read(descriptor_, bytes.data() + filled, piece);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_file(path_, std::string("can't be read: ") + std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  read_bytes_ += filled;
  // Again, since the file may have grown since it was opened.
  check_size(read_bytes_);
  return filled;
}

std::string InputFile::read_rest() {
  // The size is a guess: a file may grow as it is read, and files of the kernel say 0.
  constexpr std::size_t kPiece = std::size_t{1} << 16U;
  const std::uint64_t expected = size_bytes_ > read_bytes_ ? size_bytes_ - read_bytes_ : 0;
  std::string text;
  std::size_t filled = 0;
  do {
    // A byte more than expected: a read that ends before it has seen the file's end.
    text.resize(std::max<std::size_t>(filled + kPiece, expected + 1));
    filled += read(std::span(text).subspan(filled));
  } while (filled == text.size());
  text.resize(filled);
  return text;
}

std::string read_standard_input(std::uint64_t most_bytes) {
  std::string text;
  char piece[4096];
  while (true) {
    const ssize_t count = ::read(STDIN_FILENO, piece, sizeof piece);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      refuse_file("standard input", std::string("can't be read: ") + std::strerror(errno));
    if (count == 0) return text;
    text.append(piece, static_cast<std::size_t>(count));
    if (text.size() > most_bytes) {
      refuse_file("standard input",
                  "gives more than " + std::to_string(most_bytes / 1'000'000) + " MB");
    }
  }
}

std::string read_input_file(const std::filesystem::path& path, std::uint64_t most_bytes) {
  return InputFile(path, most_bytes).read_rest();
}

}  // namespace avoidbench
