#include "conformance/own_process.hpp"

#include <cstring>
#include <type_traits>

#include "base/check.hpp"
#include "process/isolated_run.hpp"

namespace avoidbench {
namespace {

template <class T>
void put(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T taken(std::string_view& bytes) {
  T value;
  AB_CHECK(bytes.size() >= sizeof value, bytes.size());
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

void put_text(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text;
}

std::string taken_text(std::string_view& bytes) {
  const auto size = taken<std::size_t>(bytes);
  AB_CHECK(bytes.size() >= size, bytes.size(), size);
  std::string text(bytes.substr(0, size));
  bytes.remove_prefix(size);
  return text;
}

IsolatedEnd isolated(const std::function<std::string()>& work) {
  return run_isolated([&](IsolatedOutput& output) { AB_CHECK(output.write(work())); },
                      kFlightLimit_s, Prints::shown);
}

}  // namespace

std::string bytes_of(const std::vector<Reply>& replies) {
  std::string bytes;
  // Times are left out: rules compare answers, and no two runs take the same time.
  for (const Reply& reply : replies) {
    put(bytes, reply.status);
    put(bytes, reply.is_plan);
    put(bytes, reply.command);
    put(bytes, reply.points.size());
    for (const ab_point& point : reply.points) put(bytes, point);
    for (const std::string& text : {reply.error, reply.escaped, reply.changed}) {
      put_text(bytes, text);
    }
  }
  return bytes;
}

std::vector<Reply> replies_of(std::string_view bytes) {
  std::vector<Reply> replies;
  while (!bytes.empty()) {
    Reply& reply = replies.emplace_back();
    reply.status = taken<ab_status>(bytes);
    reply.is_plan = taken<bool>(bytes);
    reply.command = taken<ab_command>(bytes);
    const auto count = taken<std::size_t>(bytes);
    for (std::size_t i = 0; i < count; ++i) reply.points.push_back(taken<ab_point>(bytes));
    for (std::string* text : {&reply.error, &reply.escaped, &reply.changed}) {
      *text = taken_text(bytes);
    }
  }
  return replies;
}

bool needs_own_process(const PlannerLibrary& library) {
  return (library.description().needs & AB_USES_GLOBALS) != 0;
}

std::string in_own_process(const PlannerLibrary& library,
                           const std::function<std::string()>& work) {
  if (!needs_own_process(library)) return work();
  const IsolatedEnd end = isolated(work);
  return end.problem.empty() ? end.output : end.problem;
}

std::vector<Reply> replies_in_own_process(const PlannerLibrary& library,
                                          const std::function<std::vector<Reply>()>& work) {
  if (!needs_own_process(library)) return work();
  const IsolatedEnd end = isolated([&] { return bytes_of(work()); });
  // None, not the answers until then: a flight that did not end proves nothing by its beginning.
  return end.problem.empty() ? replies_of(end.output) : std::vector<Reply>{};
}

}  // namespace avoidbench
