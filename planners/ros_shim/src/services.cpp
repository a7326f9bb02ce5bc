#include <algorithm>
#include <stdexcept>

#include "core.hpp"

// Services that ros_shim/runtime.h declares: a call waits in the queue of the node that offers the
// service, and its caller until that node has answered.
namespace ros_shim {
namespace {

Service* find_service(Core& core, const std::string& name) {
  for (const std::unique_ptr<Service>& service : core.services) {
    if (service->answer && service->name == name) return service.get();
  }
  return nullptr;
}

/// Without its caller, who may be unwound while he waits, nobody answers.
struct CallerWaits {
  explicit CallerWaits(ServiceCall& call) : call_(call) {}
  ~CallerWaits() { call_.caller = nullptr; }
  CallerWaits(const CallerWaits&) = delete;
  CallerWaits& operator=(const CallerWaits&) = delete;
  ServiceCall& call_;
};

}  // namespace

int offer_service(const std::string& name, const char* request_type, Answer answer) {
  Core& core = ros_shim::core();
  if (find_service(core, name) != nullptr) {
    throw std::logic_error("service " + name + " is offered twice, the second time by " +
                           core.current->full_name);
  }
  auto service = std::make_unique<Service>();
  service->name = name;
  service->request_type = request_type;
  service->node = core.current;
  service->answer = std::make_shared<Answer>(std::move(answer));
  core.services.push_back(std::move(service));
  return static_cast<int>(core.services.size()) - 1;
}

void withdraw_service(int service) {
  // Servers of static storage outlive the simulation.
  if (is_over()) return;
  core().services[static_cast<std::size_t>(service)]->answer.reset();
}

bool has_service(const std::string& name) { return find_service(core(), name) != nullptr; }

bool wait_for_service(const std::string& name, std::int64_t wait_ns) {
  constexpr std::int64_t kPause_ns = 20000000;  // as roscpp looks
  Core& core = ros_shim::core();
  const std::int64_t end_ns = wait_ns < 0 ? kNever : core.now_ns + wait_ns;
  while (is_running() && !has_service(name)) {
    if (core.now_ns >= end_ns || !core.current->fibre) return false;
    wait_a_turn(core, std::min(end_ns, core.now_ns + kPause_ns));
  }
  return is_running();
}

bool call_service(const std::string& name, const char* request_type, void* request,
                  void* response) {
  Core& core = ros_shim::core();
  Service* const service = find_service(core, name);
  if (service == nullptr) return false;
  if (service->request_type != request_type) {
    throw std::logic_error("service " + name + " takes " + service->request_type + ", and " +
                           core.current->full_name + " calls it with " + request_type);
  }
  // Held: the service may withdraw itself.
  const std::shared_ptr<Answer> answer = service->answer;
  Node& caller = *core.current;
  // A node that called itself would wait for ever.
  if (!caller.fibre || service->node == &caller) return (*answer)(request, response);
  const auto call = std::make_shared<ServiceCall>();
  call->answer = answer;
  call->request = request;
  call->response = response;
  call->caller = &caller;
  const CallerWaits waits(*call);
  Waiting waiting;
  waiting.order = core.next_order++;
  waiting.call = call;
  service->node->queue.push_back(std::move(waiting));
  while (is_running() && !call->is_answered) wait_a_turn(core, kNever);
  return call->is_answered && call->is_good;
}

void answer_call(Core& core, ServiceCall& call) {
  if (call.caller == nullptr) return;
  call.is_good = (*call.answer)(call.request, call.response);
  call.is_answered = true;
  if (call.caller != nullptr) call.caller->wake_ns = core.now_ns;
}

}  // namespace ros_shim
