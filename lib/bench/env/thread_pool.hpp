#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace avoidbench {

/// Threads that do numbered pieces of work together; who calls is one of them.
class ThreadPool {
 public:
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Does work(0) … work(count − 1), each once, in no order, and returns when all are done. What a
  /// piece throws does not stop the others; of several exceptions the lowest piece's is thrown.
  /// `poll` is called now and then in the calling thread, between its pieces; where it throws, what
  /// has not begun is left undone and its exception is thrown.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work,
                const std::function<void()>& poll = {});

 private:
  struct Failure {
    std::size_t piece = 0;
    std::exception_ptr what;
  };

  bool take(std::size_t& piece);
  void do_pieces(const std::function<void()>& poll);
  void help(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any begun_;
  std::condition_variable done_;
  // All below are guarded by the mutex.
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0, next_ = 0, busy_ = 0;
  Failure failure_;
  std::vector<std::jthread> helpers_;  // last: they end before what they use
};

}  // namespace avoidbench
