#include "store/run_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "base/input_error.hpp"

namespace avoidbench {
namespace {

constexpr off_t kLockByte = off_t{1} << 62;  // SQLite locks bytes at 2^30

/// 0, or errno.
/// Of the open file description (OFD), not of the process: SQLite opens and closes descriptors of
/// the same file, which would drop a lock of the process.
int try_lock(int descriptor) {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = kLockByte;
  lock.l_len = 1;
  return ::fcntl(descriptor, F_OFD_SETLK, &lock) == 0 ? 0 : errno;
}

bool is_number(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a file of /proc/PID/fdinfo says that the descriptor holds our lock of this inode.
/// "lock: 1: OFDLCK ADVISORY WRITE -1 08:01:1234 4611686018427387904 …": the inode behind the
/// device, then the first byte.
bool holds_lock(const std::filesystem::path& fdinfo, ino_t inode) {
  // By steps: g++ 14 takes the sum of short strings for an access out of bounds.
  std::string number = ":", byte = " ";
  number += std::to_string(inode);
  number += ' ';
  byte += std::to_string(kLockByte);
  byte += ' ';
  std::ifstream file(fdinfo);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("lock:") && line.find("OFDLCK") != std::string::npos &&
        line.find(number) != std::string::npos && line.find(byte) != std::string::npos) {
      return true;
    }
  }
  return false;
}

/// The process of this machine that holds the lock, as far as we may look; "" for none.
std::string holder_of(ino_t inode) {
  std::error_code error;
  // The kernel names no owner of such a lock (F_OFD_GETLK says -1): /proc is searched.
  for (const auto& process : std::filesystem::directory_iterator("/proc", error)) {
    const std::string pid = process.path().filename().string();
    if (!is_number(pid)) continue;
    std::error_code hidden;
    // Without rights to look it counts as not found.
    std::filesystem::directory_iterator descriptors(process.path() / "fdinfo", hidden), end;
    for (; !hidden && descriptors != end; descriptors.increment(hidden)) {
      if (holds_lock(descriptors->path(), inode)) return pid;
    }
  }
  return "";
}

/// When the process began, ISO 8601, UTC; "" where /proc does not say.
std::string began_at(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat"), system("/proc/stat");
  std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t end_of_name = stat.rfind(')');
  if (end_of_name == std::string::npos) return "";
  std::istringstream fields(stat.substr(end_of_name + 1));
  std::string skipped;
  // Field 22 of stat(5) is the start time; the name, field 2, may hold spaces, so that counting
  // begins behind its bracket.
  for (int i = 0; i < 19; ++i) fields >> skipped;  // up to field 21
  long long ticks = 0, boot_s = 0;
  fields >> ticks;
  for (std::string word; system >> word;) {
    if (word == "btime") system >> boot_s;
  }
  const long ticks_per_s = ::sysconf(_SC_CLK_TCK);
  if (!fields || boot_s == 0 || ticks_per_s <= 0) return "";
  const std::time_t began = boot_s + ticks / ticks_per_s;
  std::tm utc{};
  char text[32];
  if (::gmtime_r(&began, &utc) == nullptr) return "";
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Who holds the lock, for the message of who does not get it.
std::string holder_text(int descriptor) {
  struct stat status = {};
  ::fstat(descriptor, &status);
  const std::string pid = holder_of(status.st_ino);
  if (pid.empty()) return "of another user or machine";
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  const std::string began = began_at(pid);
  return "pid " + pid + (began.empty() ? "" : ", since " + began) + ", host " + host;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& file)
    : file_(std::filesystem::absolute(file)),
      descriptor_(::open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY)) {
  if (descriptor_ < 0) refuse_file(file, std::string("can't be opened: ") + std::strerror(errno));
  // One that was just killed may need a moment to be gone.
  // A second in all.
  constexpr int kTries = 20;
  constexpr std::chrono::milliseconds kPause{50};
  int error = try_lock(descriptor_);
  for (int i = 0; i < kTries && (error == EAGAIN || error == EACCES); ++i) {
    std::this_thread::sleep_for(kPause);
    error = try_lock(descriptor_);
  }
  if (error == EAGAIN || error == EACCES) {
    const std::string holder = holder_text(descriptor_);
    ::close(descriptor_);
    refuse_file(file, "another avoidbench run or merge (" + holder +
                          ") is writing to it: wait until it has ended, or write to another file");
  }
  // Another error is a file system without locks. SQLite's own way without them is as good as it
  // gets there.
}

RunLock::~RunLock() { ::close(descriptor_); }

/// By inode and device: the same name may be another file.
bool RunLock::is_in_place() const {
  struct stat now = {}, ours = {};
  return ::fstat(descriptor_, &ours) == 0 && ::stat(file_.c_str(), &now) == 0 &&
         now.st_ino == ours.st_ino && now.st_dev == ours.st_dev;
}

std::filesystem::path RunLock::place_now() const {
  std::error_code error;
  const std::filesystem::path name =
      // The kernel says where the open file is now; " (deleted)" is no file, which the check below
      // finds.
      std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor_), error);
  struct stat now = {}, ours = {};
  const bool is_there = !error && ::fstat(descriptor_, &ours) == 0 &&
                        ::stat(name.c_str(), &now) == 0 && now.st_ino == ours.st_ino &&
                        now.st_dev == ours.st_dev;
  return is_there ? name : std::filesystem::path();
}

}  // namespace avoidbench
