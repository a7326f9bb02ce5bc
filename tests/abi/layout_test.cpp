#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "abi/layout.hpp"

namespace {

// The static_asserts of layout.hpp are the test of sizes and offsets. This one guards what they
// can't see.
TEST(PlannerHeader, IncludesOnlyStdint) {
  std::ifstream header(AVOIDBENCH_SOURCE_DIR "/lib/sdk/planner_api/avoidbench/planner.h");
  ASSERT_TRUE(header);
  std::string line, includes;
  while (std::getline(header, line)) {
    if (line.rfind("#include", 0) == 0) includes += line;
    EXPECT_EQ(line.find("size_t"), std::string::npos);
    EXPECT_EQ(line.find("bool "), std::string::npos);
  }
  EXPECT_EQ(includes, "#include <stdint.h>");
}

}  // namespace
