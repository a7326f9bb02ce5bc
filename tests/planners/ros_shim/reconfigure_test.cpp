#include <dynamic_reconfigure/server.h>
#include <gtest/gtest.h>
#include <solver/SolverConfig.h>

#include <stdexcept>

#include "simulated_ros.hpp"

namespace ros_shim::test {
namespace {

using Server = dynamic_reconfigure::Server<solver::SolverConfig>;

TEST(DynamicReconfigure, CallsOnceWithDefaultsAndThePrivateParameters) {
  int calls = 0;
  SimulatedRos ros({[&] {
    ros::NodeHandle own("~");
    own.setParam("speed", 2);
    own.setParam("budget_us", 1e9);
    own.setParam("frame", "map");
    Server server;
    server.setCallback([&](solver::SolverConfig& config, std::uint32_t level) {
      ++calls;
      EXPECT_EQ(level, 0xFFFFFFFFU);
      EXPECT_EQ(config.speed, 2.0);
      EXPECT_EQ(config.budget_us, 1e4) << "no more than its max";
      EXPECT_EQ(config.way, solver::Solver_Level);
      EXPECT_EQ(config.frame, "map");
      EXPECT_TRUE(config.enabled);
      config.way = solver::Solver_Straight;
    });
    EXPECT_EQ(own.param("way", -1), 0) << "what the callback changes is stored";
    EXPECT_EQ(own.param("budget_us", 0.0), 1e4);
    ros::spin();
  }});
  ros.run_to(1.0);
  EXPECT_EQ(calls, 1);
}

TEST(DynamicReconfigure, GivesDefaultsAndEndsAndTakesValues) {
  SimulatedRos ros({[&] {
    ros::NodeHandle below("~search");
    int mutex = 0;
    Server server(mutex, below);
    solver::SolverConfig config;
    server.getConfigDefault(config);
    EXPECT_EQ(config.speed, 1.0);
    server.getConfigMin(config);
    EXPECT_EQ(config.speed, 0.1);
    server.getConfigMax(config);
    EXPECT_EQ(config.speed, 3.0);
    config.speed = 2.5;
    server.updateConfig(config);
    EXPECT_EQ(below.param("speed", 0.0), 2.5);
    EXPECT_EQ(config.__level__(solver::SolverConfig::__getDefault__()), 2U)
        << "the level of speed and budget_us";
    server.setCallback(
        [](solver::SolverConfig&, std::uint32_t) { throw std::runtime_error("no"); });
  }});
  ros.run_to(1.0);
  ASSERT_EQ(ros.lines.size(), 1U);
  EXPECT_NE(ros.lines[0].find("Reconfigure callback failed with exception no"), std::string::npos);
}

}  // namespace
}  // namespace ros_shim::test
