#include "compare/compare.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/input_error.hpp"
#include "support/input_error_message.hpp"
#include "support/sample_rows.hpp"

namespace avoidbench {
namespace {

const std::vector<std::string> kNames{"path_optimality_pct", "min_clearance_m"};

CompareSettings read(const std::string& text) {
  const sample_rows::TemporaryFolder folder;
  const std::filesystem::path file = folder / "t.yaml";
  std::ofstream(file) << text;
  CompareSettings settings;
  read_tolerances(file, kNames, settings);
  return settings;
}

std::string tolerance_error(const std::string& text) {
  return test::message_of([&] { read(text); });
}

TEST(Tolerances, SharesUnitsAndIgnored) {
  const CompareSettings settings = read(
      "default: 10%\nsuccess_rate: 0.02\npath_optimality_pct: 7.5 %\nmin_clearance_m: ignore\n");
  EXPECT_EQ(settings.tolerance.kind, Tolerance::Kind::relative);
  EXPECT_EQ(settings.tolerance.value, 0.1);
  EXPECT_EQ(settings.tolerances.at("success_rate").kind, Tolerance::Kind::absolute);
  EXPECT_EQ(settings.tolerances.at("success_rate").value, 0.02);
  EXPECT_EQ(settings.tolerances.at("path_optimality_pct").value, 0.075);
  EXPECT_EQ(settings.tolerances.at("min_clearance_m").kind, Tolerance::Kind::ignored);
}

TEST(Tolerances, EveryProblemIsToldAtItsPlace) {
  const std::string error = tolerance_error("min_clearance: 5%\npath_optimality_pct: -3\n");
  EXPECT_NE(error.find("t.yaml:1:1: min_clearance: no such metric (did you mean min_clearance_m?)"),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("t.yaml:2:22: path_optimality_pct: expected a share"), std::string::npos)
      << error;
  EXPECT_NE(tolerance_error("- 5%\n").find("expected a mapping"), std::string::npos);
  EXPECT_NE(tolerance_error("success_rate: [1, 2]\n").find("found a list"), std::string::npos);
}

TEST(Tolerances, MinEffect) {
  EXPECT_EQ(min_effect_from("5%").value, 0.05);
  EXPECT_EQ(min_effect_from("0.2").value, 0.2);
  for (const char* bad : {"", "%", "five", "-1%", "nan", "5%%"}) {
    EXPECT_THROW(min_effect_from(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace avoidbench
