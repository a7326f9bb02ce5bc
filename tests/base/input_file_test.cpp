#include "base/input_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMany = 1'000'000'000;

class InputFileTest : public testing::Test {
 protected:
  InputFileTest() { fs::create_directory(folder_); }
  ~InputFileTest() override { fs::remove_all(folder_); }

  fs::path written(const std::string& text) const {
    std::ofstream(folder_ / "file", std::ios::binary) << text;
    return folder_ / "file";
  }

  /// What InputError says about the file, without its path; "" where it can be read.
  static std::string problem_of(const fs::path& path, std::uint64_t most_bytes = kMany) {
    try {
      read_input_file(path, most_bytes);
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().file, path.string());
      return error.problems().front().message;
    }
    return "";
  }

  const fs::path folder_ = fs::temp_directory_path() / ("input_file_" + std::to_string(::getpid()));
};

TEST_F(InputFileTest, GivesEveryByte) {
  std::string text(200'000, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 37 % 251);
  EXPECT_EQ(read_input_file(written(text), kMany), text);
  EXPECT_EQ(read_input_file(written(""), kMany), "");
  EXPECT_EQ(read_input_file(written("abc"), 3), "abc");
  InputFile file(written("abcdef"), kMany);
  std::string start(4, ' ');
  EXPECT_EQ(file.read(start), 4U);
  EXPECT_EQ(start, "abcd");
  EXPECT_EQ(file.read_rest(), "ef");
  EXPECT_EQ(file.read_rest(), "");
}

TEST_F(InputFileTest, FilesOfTheKernelHaveNoSizeBeforehand) {
  EXPECT_NE(read_input_file("/proc/self/status", kMany).find("Pid:"), std::string::npos);
  EXPECT_NE(problem_of("/proc/self/status", 10), "");
}

TEST_F(InputFileTest, RefusesWhatMayHaveNoEnd) {
  const std::string not_regular = ", not a regular file: write its output to a file first";
  EXPECT_EQ(problem_of("/dev/zero"), "is a device" + not_regular);
  EXPECT_EQ(problem_of("/dev/null"), "is a device" + not_regular);
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(problem_of(pipe), "is a pipe" + not_regular);  // without a writer: must not wait for it
  fs::create_symlink(pipe, folder_ / "link");
  EXPECT_EQ(problem_of(folder_ / "link"), "is a pipe" + not_regular);
  EXPECT_THROW(file_digest(pipe), InputError);
  EXPECT_THROW(file_digest("/dev/zero"), InputError);
  EXPECT_EQ(problem_of(folder_), "is a folder, not a file");
  EXPECT_EQ(problem_of(folder_ / "nothing"), "no such file");
  EXPECT_EQ(problem_of(written("x") / "below"), "no such file");

  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder_ / "socket").string();
  ASSERT_LT(name.size(), sizeof address.sun_path);
  std::memcpy(address.sun_path, name.c_str(), name.size() + 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(problem_of(name), "is a socket" + not_regular);
  ::close(socket);
}

TEST_F(InputFileTest, RefusesWhatIsTooLargeBeforeReadingIt) {
  EXPECT_EQ(problem_of(written(std::string(1'000'001, 'x')), 1'000'000), "is larger than 1 MB");
  const fs::path sparse = written("x");
  ASSERT_EQ(::truncate(sparse.c_str(), off_t{1} << 42), 0);  // 4 TiB of zeros on no disk space
  EXPECT_EQ(problem_of(sparse), "is larger than 1000 MB");
  EXPECT_THROW(file_digest(sparse), InputError);
}

TEST_F(InputFileTest, SaysWhyItCantBeRead) {
  const fs::path file = written("x");
  ASSERT_EQ(::chmod(file.c_str(), 0), 0);
  if (::access(file.c_str(), R_OK) == 0) GTEST_SKIP() << "root reads everything";
  EXPECT_EQ(problem_of(file), "can't be read: Permission denied");
}

/// What read_standard_input() makes of a file that is standard input meanwhile.
std::string standard_input_from(const fs::path& path, std::uint64_t most_bytes) {
  const int file = ::open(path.c_str(), O_RDONLY), before = ::dup(STDIN_FILENO);
  ::dup2(file, STDIN_FILENO);
  ::close(file);
  std::string text;
  try {
    text = read_standard_input(most_bytes);
  } catch (const InputError& error) {
    text = error.what();
  }
  ::dup2(before, STDIN_FILENO);
  ::close(before);
  return text;
}

TEST_F(InputFileTest, StandardInputIsReadToItsEndUpToTheBound) {
  const std::string text(2'000'000, 'a');
  EXPECT_EQ(standard_input_from(written(text), 2'000'000), text);
  EXPECT_EQ(standard_input_from(written(""), 1), "");
  EXPECT_EQ(standard_input_from(written(text + "a"), 2'000'000),
            "standard input: gives more than 2 MB");
  EXPECT_EQ(standard_input_from(fs::temp_directory_path(), kMany),
            "standard input: can't be read: Is a directory");
}

}  // namespace
}  // namespace avoidbench
