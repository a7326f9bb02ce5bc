#include "metrics/flyable.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace avoidbench {
namespace {

/// Of a map that is the right way up nothing else is proposed, least of all the axis that it has.
TEST(UnflyableHint, ProposesAnotherAxisOnly) {
  const test::TemporaryFolder folder;
  MeshSpec mesh;
  // A floor of 20 m × 20 m, z up, with a low wall.
  mesh.file = folder.write("floor.obj",
                           "v 0 0 0\nv 20 0 0\nv 20 20 0\nv 0 20 0\nf 1 2 3\nf 1 3 4\n"
                           "v 10 0 6\nv 10 1 6\nv 10 1 0\nf 5 6 7\n");
  TrialSpec trial;
  trial.map = mesh;
  EXPECT_GE(placed_missions(trial, 5), 3);
  const std::string hint = unflyable_hint(trial, 5);
  EXPECT_NE(hint.find("the map spans 20.0 × 20.0 × "), std::string::npos) << hint;
  EXPECT_NE(hint.find("with up_axis: z"), std::string::npos) << hint;
  EXPECT_EQ(hint.find("axis points up"), std::string::npos) << hint;
}

}  // namespace
}  // namespace avoidbench
