#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>

#include "base/check.hpp"
#include "plugin/conformance_run.hpp"

// The child writes one message before and one after each rule: fields that end with kFieldEnd,
// closed by kMessageEnd.
namespace avoidbench {
namespace {

constexpr char kFieldEnd = '\x1f';
constexpr char kMessageEnd = '\x1e';

void write_all(int pipe, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = write(pipe, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) _exit(1);
    done += static_cast<std::size_t>(count);
  }
}

void send(int pipe, char what, const ConformanceResult& result) {
  std::string message(1, what);
  for (const std::string& field : {result.name, result.doc, result.finding}) {
    message += kFieldEnd;
    message += field;
  }
  write_all(pipe, message + kMessageEnd);
}

ConformanceResult parsed(std::string_view message) {
  std::vector<std::string> fields(1);
  for (const char c : message) {
    if (c == kFieldEnd) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  AB_CHECK(fields.size() == 4, fields.size());
  return {fields[1], fields[2], fields[3].empty(), fields[3]};
}

/// All that the child writes until it ends or the time is up; `in_time` says which.
std::string read_until(int pipe, double time_limit_s, bool& in_time) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(time_limit_s);
  std::string text;
  while (true) {
    const double left_s = std::chrono::duration<double>(end - Clock::now()).count();
    in_time = left_s > 0.0;
    if (!in_time) return text;
    pollfd waiting{pipe, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(left_s * 1000.0) + 1) <= 0) continue;
    char buffer[4096];
    const ssize_t count = read(pipe, buffer, sizeof buffer);
    if (count == 0) return text;
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
  }
}

std::string ending(int status, bool in_time, double time_limit_s) {
  if (!in_time) {
    return "did not return within " + std::to_string(static_cast<int>(time_limit_s)) + " s";
  }
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "crashed by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
  }
  return "ended the process with code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::vector<ConformanceResult> check_conformance_isolated(const std::filesystem::path& file,
                                                          double time_limit_s) {
  int ends[2];
  AB_CHECK(pipe(ends) == 0, errno);
  const pid_t child = fork();
  AB_CHECK(child >= 0, errno);
  if (child == 0) {
    close(ends[0]);
    run_conformance(
        file, [&](const ConformanceResult& rule) { send(ends[1], 'b', rule); },
        [&](const ConformanceResult& rule) { send(ends[1], 'e', rule); });
    _exit(0);
  }
  close(ends[1]);
  bool in_time = true;
  const std::string text = read_until(ends[0], time_limit_s, in_time);
  if (!in_time) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }

  std::vector<ConformanceResult> results;
  std::optional<ConformanceResult> tried;
  std::string_view rest = text;
  for (std::size_t end = rest.find(kMessageEnd); end != std::string_view::npos;
       end = rest.find(kMessageEnd)) {
    const std::string_view message = rest.substr(0, end);
    rest.remove_prefix(end + 1);
    if (message.front() == 'b') {
      tried = parsed(message);
    } else {
      tried.reset();
      results.push_back(parsed(message));
    }
  }
  if (tried) {
    tried->passed = false;
    tried->finding = ending(status, in_time, time_limit_s);
    results.push_back(*tried);
  }
  return results;
}

}  // namespace avoidbench
