#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "command_options.hpp"
#include "commands.hpp"
#include "page_output.hpp"
#include "run_page.hpp"

namespace avoidbench {
namespace {

constexpr double kEvery_s = 5.0;
constexpr double kCpuShare = 0.05;  ///< that writing may take

struct RunPageOptions {
  std::string file, database, sweep, command;
};

/// Messages of the run on standard input: a line of JSON each.
class Messages {
 public:
  /// Waits so long for more, forever without a time. False: the run has ended.
  bool wait(std::optional<double> time_s) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    const int time_ms = time_s ? static_cast<int>(1000.0 * std::max(*time_s, 0.0)) + 1 : -1;
    if (::poll(&input, 1, time_ms) <= 0) return true;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0) return false;
    text_.append(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      if (end > 0) newest_ = text_.substr(0, end);
      text_.erase(0, end + 1);
    }
    return true;
  }

  /// The newest one; empty where it was taken before.
  std::string take() { return std::exchange(newest_, {}); }
  bool has_any() const { return !newest_.empty(); }

 private:
  std::string text_, newest_;
};

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void write_pages(const RunPageOptions& told) {
  using Clock = std::chrono::steady_clock;
  // Flights come first.
  constexpr int kLessUrgent = 10;
  [[maybe_unused]] const int level = ::nice(kLessUrgent);
  PageOrigin origin = page_origin();
  origin.command = told.command;
  Messages messages;
  double every_s = kEvery_s;
  std::optional<Clock::time_point> began;
  const auto left_s = [&] {
    return began ? every_s - std::chrono::duration<double>(Clock::now() - *began).count() : 0.0;
  };
  while (messages.wait(messages.has_any() ? std::optional(left_s()) : std::nullopt)) {
    if (!messages.has_any() || left_s() > 0.0) continue;
    began = Clock::now();
    const double before_s = cpu_s();
    auto run = nlohmann::ordered_json::parse(messages.take());
    const std::int64_t revision = run.at("revision");
    run.erase("revision");
    run["every_s"] = every_s;
    run["written_s"] = std::time(nullptr);
    try {
      write_run_page(told.file, told.database, told.sweep, revision, origin, std::move(run));
    } catch (const InputError& error) {
      std::cerr << "warning: the page is written no more, the run goes on: " << error.what()
                << '\n';
      throw CLI::RuntimeError(1);
    }
    every_s = std::max(kEvery_s, (cpu_s() - before_s) / kCpuShare);
  }
}

}  // namespace

void add_run_page_command(CLI::App& app) {
  const auto [command, options] =
      add_command(app, "run-page", "Writes the page of a run that goes on", write_pages);
  command.group("");  // started by `run` only
  command.add_option("--command", options.command)->required();
  command.add_option("file", options.file)->required();
  command.add_option("database", options.database)->required();
  command.add_option("sweep", options.sweep)->required();
}

}  // namespace avoidbench
