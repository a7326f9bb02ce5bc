#pragma once

#include <string>

namespace avoidbench {

/// From now on, what the programs of planners print is also written to this descriptor, as if the
/// planner were a library: to a worker's own capture, never to a terminal. -1: nowhere.
void pass_prints_on(int fd);

/// What one program prints, as it comes out of a pipe; the end of it is kept.
class ProgramPrints {
 public:
  /// Both ends; throws InputError.
  ProgramPrints();
  ~ProgramPrints();
  ProgramPrints(const ProgramPrints&) = delete;
  ProgramPrints& operator=(const ProgramPrints&) = delete;

  int read_fd() const { return is_open_ ? read_fd_ : -1; }  ///< -1 after the end
  int write_fd() const { return write_fd_; }
  void close_write_end();

  /// Takes what there is, up to some hundred kilobytes. False at the end: nobody can print any
  /// more.
  bool drain();
  /// Its last lines, on one line, not longer than people read; "" if none.
  std::string last_lines() const;

 private:
  int read_fd_ = -1, write_fd_ = -1;
  bool is_open_ = true;
  std::string tail_;
};

}  // namespace avoidbench
