// planners[].filter: what a planner's commands pass through.
#include "config/sweep_fixture.hpp"
#include "sweep/key_maker.hpp"
#include "sweep/sweep_rows.hpp"
#include "sweep/sweep_spec.hpp"

namespace avoidbench {
namespace {

class Filters : public SweepFiles {
 protected:
  std::vector<PlannerChoice> planners(const std::string& entry) const {
    return read("sweep: a\nplanners: [" + entry + "]\n").planners;
  }
  std::string problem(const std::string& entry) const {
    return problems("sweep: a\nplanners: [" + entry + "]\n");
  }
  TrialSpec trial(const std::string& entry) const {
    TrialSpec spec;
    spec.planner = planners(entry).front();
    return spec;
  }
  std::string key(const std::string& entry) const { return trial_key(trial(entry)); }
};

TEST_F(Filters, AreANameOrWhatAPlannersEntryIs) {
  const PlannerChoice named = planners("{plugin: tunable, filter: careful}").at(0);
  ASSERT_TRUE(named.filter.has_value());
  EXPECT_EQ(named.label, "tunable + careful");
  EXPECT_EQ(named.filter->plugin, "careful");
  EXPECT_EQ(named.filter->parameters.at(0).number, 0.5);
  EXPECT_EQ(named.filter->file_digest.size(), 64U);
  const PlannerChoice given =
      planners(
          "{plugin: tunable, label: mine, filter: {plugin: careful, parameters: {margin_m: "
          "1}}}")
          .at(0);
  EXPECT_EQ(given.label, "mine");
  EXPECT_EQ(given.filter->parameters.at(0).number, 1.0);
  const PlannerChoice renamed =
      planners("{plugin: tunable, filter: {plugin: careful, label: soft}}").at(0);
  EXPECT_EQ(renamed.label, "tunable + soft");
  const std::string file = CONFIG_TEST_PLANNERS "/careful.so";
  EXPECT_EQ(planners("{plugin: tunable, filter: " + file + "}").at(0).filter->file, file);
  EXPECT_EQ(needs_of(named), std::uint32_t{AB_INPUT_STATE} | AB_INPUT_GOALS | AB_INPUT_COMMAND);
}

TEST_F(Filters, EachOfItsValuesFliesWithEachOfThePlanners) {
  const std::vector<PlannerChoice> all = planners(
      "{plugin: tunable, parameters: {horizon_m: [2, 3]}, filter: {plugin: careful, parameters: "
      "{margin_m: [0.1, 0.2]}}}");
  std::vector<std::string> labels;
  for (const PlannerChoice& one : all) labels.push_back(one.label);
  const std::vector<std::string> expected{"tunable[horizon_m=2] + careful[margin_m=0.1]",
                                          "tunable[horizon_m=2] + careful[margin_m=0.2]",
                                          "tunable[horizon_m=3] + careful[margin_m=0.1]",
                                          "tunable[horizon_m=3] + careful[margin_m=0.2]"};
  EXPECT_EQ(labels, expected);
  EXPECT_EQ(planners("{plugin: tunable, label: a, filter: {plugin: careful, parameters: {margin_m: "
                     "[0.1, 0.2]}}}")
                .at(1)
                .label,
            "a + careful[margin_m=0.2]");
}

TEST_F(Filters, ProblemsHaveTheirPlace) {
  EXPECT_EQ(problem("careful"),
            "s.yaml:2:12: planners[0]: careful is a filter and flies only on top of a planner: "
            "write {plugin: PLANNER, filter: careful}");
  EXPECT_EQ(problem("{plugin: tunable, filter: one_camera}"),
            "s.yaml:2:38: planners[0].filter: one_camera is not a filter: it does not declare "
            "AB_INPUT_COMMAND");
  EXPECT_EQ(problem("{plugin: fast, filter: careful}"),
            "s.yaml:2:35: planners[0].filter: filter careful does not take all commands of fast: "
            "trajectory (of a filter, `commands` are the kinds that it takes and gives)");
  EXPECT_EQ(problem("{plugin: tunable, filter: {plugin: careful, parameters: {margin_m: 3}}}"),
            "s.yaml:2:79: planners[0].filter.parameters.margin_m: 3 is outside [0, 2] m");
  EXPECT_EQ(problem("{plugin: tunable, filter: {parameters: {margin_m: 3}}}"),
            "s.yaml:2:38: planners[0].filter: lacks 'plugin', the planner's name or file");
  EXPECT_EQ(problem("{plugin: tunable, filter: {plugin: careful, camera: 0}}"),
            "s.yaml:2:56: planners[0].filter.camera: unknown key (known: plugin, "
            "label, parameters)");
  EXPECT_EQ(problem("{plugin: tunable, filter: {plugin: careful, filter: careful}}"),
            "s.yaml:2:56: planners[0].filter.filter: unknown key (known: plugin, "
            "label, parameters)");
  EXPECT_EQ(problem("{plugin: tunable, filter: [careful]}"),
            "s.yaml:2:38: planners[0].filter: expected a filter's name or {plugin, label, "
            "parameters}, found a list");
  EXPECT_EQ(
      problem("{plugin: tunable, filter: carefull}")
          .substr(0, std::string("s.yaml:2:38: planners[0].filter: no planner 'carefull' (did "
                                 "you mean careful?)")
                         .size()),
      "s.yaml:2:38: planners[0].filter: no planner 'carefull' (did you mean careful?)");
}

TEST_F(Filters, ArePartOfTheKeyWhereThereIsOne) {
  const std::string label = ", label: t";
  const std::string alone = key("{plugin: tunable" + label + "}");
  const std::string with = key("{plugin: tunable" + label + ", filter: careful}");
  EXPECT_NE(with, alone);
  EXPECT_NE(
      key("{plugin: tunable" + label + ", filter: {plugin: careful, parameters: {margin_m: 1}}}"),
      with);
  EXPECT_EQ(
      key("{plugin: tunable" + label + ", filter: {plugin: careful, parameters: {margin_m: 0.5}}}"),
      with);
  // Wherever it lies.
  EXPECT_EQ(key("{plugin: tunable" + label + ", filter: " CONFIG_TEST_PLANNERS "/careful.so}"),
            with);
  TrialSpec other = trial("{plugin: tunable" + label + ", filter: careful}");
  other.planner.filter->file_digest = std::string(64, '0');
  EXPECT_NE(trial_key(other), with);
}

TEST_F(Filters, LeaveNoTraceWhereThereIsNone) {
  EXPECT_EQ(trial_json(trial("tunable")).find("filter"), std::string::npos);
  EXPECT_EQ(flown_digest(trial("tunable").planner), trial("tunable").planner.file_digest);
  const TrialSpec with = trial("{plugin: tunable, filter: careful}");
  EXPECT_NE(trial_json(with).find("\"filter\":{"), std::string::npos);
  EXPECT_EQ(trial_json(with).find(CONFIG_TEST_PLANNERS), std::string::npos) << "no paths";
  EXPECT_NE(flown_digest(with.planner), with.planner.file_digest);
}

}  // namespace
}  // namespace avoidbench
