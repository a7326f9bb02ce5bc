#include "plugin/cpu_meter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "conformance/conformance_flight.hpp"
#include "plugin/bad_planners.hpp"
#include "plugin/planner_instance.hpp"

namespace avoidbench {
namespace {

PlannerInstance threads_planner(const std::string& how) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner("threads"));
  PlannerInstance planner(library, conformance_setup(),
                          resolve_parameters(library.description(), {{"how", {0.0, how}}}));
  EXPECT_EQ(planner.reset({}), "");
  return planner;
}

/// CPU time that so many calls are charged.
double used_s(PlannerInstance& planner, int calls) {
  PlannerView view;
  view.position_world = view.velocity_world = view.rates_body = Eigen::Vector3d::Zero();
  view.q_world_body.setIdentity();
  double total_s = 0.0;
  for (int i = 0; i < calls; ++i) {
    const PlanResult result = planner.plan(view);
    EXPECT_EQ(result.status, PlanStatus::command) << result.reason;
    total_s += result.cpu_time_s;
  }
  return total_s;
}

TEST(CpuMeter, CountsTheCallingThread) {
  PlannerInstance planner = threads_planner("calling");
  const double calls_s = used_s(planner, 2);
  EXPECT_GE(calls_s, 0.12);
  EXPECT_LT(calls_s, 0.13);
}

TEST(CpuMeter, CountsThreadsThatCallsStartAndEnd) {
  PlannerInstance planner = threads_planner("three");
  const double calls_s = used_s(planner, 2);
  EXPECT_GE(calls_s, 0.36);
  EXPECT_LT(calls_s, 0.42);
}

TEST(CpuMeter, CountsAThreadThatGoesOnBehindTheCalls) {
  PlannerInstance planner = threads_planner("behind");
  const double calls_s = used_s(planner, 4);  // two times 60 ms
  EXPECT_GE(calls_s, 0.11);                   // what the kernel has not added up yet is missing
  EXPECT_LT(calls_s, 0.15);
}

TEST(CpuMeter, ChargesNobodyForTheHostsAndOtherPlannersThreads) {
  const auto spin = [](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
    }
  };
  threads_belong_to(kHostThreads);
  const std::jthread host(spin);
  PlannerInstance busy = threads_planner("spin");
  PlannerInstance planner = threads_planner("calling");
  const double calls_s = used_s(planner, 1);
  EXPECT_GE(calls_s, 0.06);
  EXPECT_LT(calls_s, 0.065);
  // The other one is charged for its thread from its reset on.
  EXPECT_EQ(busy.reset({}), "");
  double busy_s = 0.0;
  for (int i = 0; i < 1000 && busy_s < 0.02; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    busy_s += used_s(busy, 1);
  }
  EXPECT_GE(busy_s, 0.02);
}

/// Until the calling thread has used so much more.
void compute(double cpu_s) {
  const auto now_s = [] {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  for (const double end_s = now_s() + cpu_s; now_s() < end_s;) {
  }
}

/// What the host's thread used until its end stays the host's, and no more than that.
TEST(CpuMeter, GoesOnChargingAfterAThreadOfTheHostEnded) {
  threads_belong_to(kHostThreads);
  CpuMeter meter(new_thread_owner());
  std::jthread host([](const std::stop_token& stop) {
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  meter.begin_call();  // from now on the thread is known
  meter.end_call();
  meter.settle();
  host.request_stop();
  host.join();
  meter.begin_call();
  std::thread([] { compute(0.1); }).join();
  const double call_s = meter.end_call();
  EXPECT_GE(call_s, 0.08);
  EXPECT_LT(call_s, 0.15);
}

TEST(CpuMeter, CostsLittle) {
  constexpr int kCalls = 20'000;
  PlannerInstance planner = threads_planner("calling");
  CpuMeter meter(new_thread_owner());
  meter.begin_call();
  meter.settle();
  double total_s = 0.0;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < kCalls; ++i) {
    meter.begin_call();
    total_s += meter.end_call();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  RecordProperty("microseconds_a_call", std::to_string(1e6 * took.count() / kCalls));
  EXPECT_LT(total_s / kCalls, 5e-6);  // charged for doing nothing
}

}  // namespace
}  // namespace avoidbench
