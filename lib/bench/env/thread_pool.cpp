#include "env/thread_pool.hpp"

#include <chrono>

#include "base/check.hpp"

namespace avoidbench {

ThreadPool::ThreadPool(std::size_t threads) {
  AB_CHECK(threads >= 1);
  // From 1: who calls for_each() is the first.
  for (std::size_t i = 1; i < threads; ++i) {
    helpers_.emplace_back([this](const std::stop_token& stop) { help(stop); });
  }
}

ThreadPool::~ThreadPool() {
  // All are told before the first is waited for.
  for (std::jthread& helper : helpers_) helper.request_stop();
}

bool ThreadPool::take(std::size_t& piece) {
  const std::lock_guard lock(mutex_);
  if (next_ >= count_) return false;
  piece = next_++;
  // Under the same lock: else for_each() could see all taken and nobody busy.
  ++busy_;
  return true;
}

void ThreadPool::do_pieces(const std::function<void()>& poll) {
  // Soon enough for Ctrl-C; each poll takes the interpreter's lock.
  constexpr std::chrono::milliseconds kPollPeriod(100);
  auto polled = std::chrono::steady_clock::now();
  std::size_t piece = 0;
  while (take(piece)) {
    std::exception_ptr failed;
    try {
      (*work_)(piece);
    } catch (...) {
      failed = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      // The lowest piece's, so that what is thrown does not depend on who was faster.
      if (failed && (!failure_.what || piece < failure_.piece)) failure_ = {piece, failed};
      // Nobody is busy between pieces either; the caller is woken at the end alone.
      if (--busy_ == 0 && next_ >= count_) done_.notify_all();
    }
    if (poll && std::chrono::steady_clock::now() - polled >= kPollPeriod) {
      poll();
      polled = std::chrono::steady_clock::now();
    }
  }
}

void ThreadPool::help(const std::stop_token& stop) {
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (!begun_.wait(lock, stop, [this] { return next_ < count_; })) return;
    }
    do_pieces({});
  }
}

void ThreadPool::for_each(std::size_t count, const std::function<void(std::size_t)>& work,
                          const std::function<void()>& poll) {
  {
    const std::lock_guard lock(mutex_);
    AB_CHECK(work_ == nullptr);
    work_ = &work;
    count_ = count;
    next_ = 0;
    failure_ = {};
  }
  begun_.notify_all();
  std::exception_ptr interrupted;
  try {
    do_pieces(poll);
  } catch (...) {
    interrupted = std::current_exception();
  }
  std::unique_lock lock(mutex_);
  // What has not begun is taken back; what runs is waited for, since it uses `work`.
  if (interrupted) next_ = count_;
  done_.wait(lock, [this] { return busy_ == 0; });
  work_ = nullptr;
  count_ = next_ = 0;
  if (interrupted) std::rethrow_exception(interrupted);
  if (failure_.what) std::rethrow_exception(failure_.what);
}

}  // namespace avoidbench
