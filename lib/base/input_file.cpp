#include "base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string message) {
  throw InputError(InputProblem{.file = path.string(), .message = std::move(message)});
}

void check_kind(const std::filesystem::path& path, mode_t mode) {
  if (S_ISREG(mode)) return;
  if (S_ISDIR(mode)) fail(path, "is a folder, not a file");
  const char* kind = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  fail(path,
       std::string("is ") + kind + ", not a regular file: write what it gives to a file first");
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, std::uint64_t most_bytes)
    : path_(path), most_bytes_(most_bytes) {
  // Looked at before it is opened, which may itself do something to a device; and after, since
  // another file may have taken its place.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const bool is_missing = errno == ENOENT || errno == ENOTDIR;
    fail(path, is_missing ? "no such file" : std::string("can't be read: ") + std::strerror(errno));
  }
  check_kind(path, status.st_mode);
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) fail(path, std::string("can't be read: ") + std::strerror(errno));
  try {
    if (::fstat(descriptor_, &status) != 0) fail(path, "can't be read");
    check_kind(path, status.st_mode);
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
  fail(path_, "is larger than " + std::to_string(most_bytes_ / kMega) + " MB");
}

std::size_t InputFile::read(std::span<char> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::read(descriptor_, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path_, std::string("can't be read: ") + std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  read_bytes_ += filled;
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
    text.resize(std::max<std::size_t>(filled + kPiece, expected + 1));
    filled += read(std::span(text).subspan(filled));
  } while (filled == text.size());
  text.resize(filled);
  return text;
}

std::string read_input_file(const std::filesystem::path& path, std::uint64_t most_bytes) {
  return InputFile(path, most_bytes).read_rest();
}

}  // namespace avoidbench
