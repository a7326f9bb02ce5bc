#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// Where this program lies on the PATH; "" where it does not.
std::string found_program(const std::string& name);

/// A program of others that is fed on its standard input. What it prints is shown.
class FedProgram {
 public:
  /// Throws InputError where it can't be started.
  explicit FedProgram(const std::vector<std::string>& command);
  ~FedProgram();  ///< ends a program that was not finished
  FedProgram(const FedProgram&) = delete;
  FedProgram& operator=(const FedProgram&) = delete;

  /// False where the program takes no more: it has ended.
  bool write(std::span<const std::uint8_t> bytes);
  /// A short message, which is dropped where the program has no room for it now: waits for nothing.
  /// False where it takes no more.
  bool offer(std::string_view message);
  /// Says that there is no more, waits, and returns the exit code; -1 where it was killed.
  int finish();

 private:
  pid_t id_ = -1;
  int input_ = -1;
};

}  // namespace avoidbench
