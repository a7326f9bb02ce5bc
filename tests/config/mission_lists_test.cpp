#include "config/mission_lists.hpp"

#include "base/math.hpp"
#include "config/sweep_fixture.hpp"
#include "sweep/listed_missions.hpp"

namespace avoidbench {
namespace {

const std::string kSweepHead = "sweep: a\nplanners: [tunable]\n";
const std::string kColumns =
    "map,start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m,goal_z_m,yaw_deg\n";

class MissionLists : public SweepFiles {
 protected:
  /// The problems of a sweep that takes its missions from a table.
  std::string of_table(const std::string& table, const std::string& rest = "") const {
    write("missions.csv", table);
    return problems(kSweepHead + "mission: {file: missions.csv}\n" + rest);
  }
};

TEST_F(MissionLists, AListIsReadWithItsDefaults) {
  const SweepSpec sweep = read(kSweepHead +
                               "mission:\n  time_limit_s: 40\n  list:\n"
                               "    - {start: [1, 2, 3], goal: [1, 12, 3]}\n"
                               "    - {start: [4, 5, 6], goal: [7, 8, 9.5], yaw_deg: -90}\n");
  EXPECT_EQ(sweep.trials, 2);
  EXPECT_EQ(sweep.base.mission.time_limit_s, 40.0);
  ASSERT_EQ(sweep.missions.size(), 2U);
  EXPECT_EQ(sweep.missions[0].mission.start_world, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(sweep.missions[0].mission.goal_world, Eigen::Vector3d(1, 12, 3));
  EXPECT_DOUBLE_EQ(sweep.missions[0].mission.start_yaw_rad, 0.5 * math::kPi);  // toward the goal
  EXPECT_DOUBLE_EQ(sweep.missions[1].mission.start_yaw_rad, -0.5 * math::kPi);
  EXPECT_EQ(sweep.missions[1].place.line, 7);
  EXPECT_EQ(sweep.missions[1].place.column, 7);
  EXPECT_TRUE(sweep.base.missions_digest.empty());  // expand() fills it
}

TEST_F(MissionLists, ATableSaysTheSameInAnyOrderOfColumns) {
  write("tables/missions.csv",
        "\xEF\xBB\xBF# made by hand\r\ngoal_z_m, "
        "goal_y_m,goal_x_m,start_z_m,start_y_m,\"start_x_m\"\r\n"
        "\r\n3,12,1,3,2, 1 \r\n\"9.5\",8,7,6,5,4\r\n");
  const SweepSpec sweep = read(kSweepHead + "mission: {file: tables/missions.csv}\n");
  ASSERT_EQ(sweep.missions.size(), 2U);
  EXPECT_EQ(sweep.missions[0].mission.start_world, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(sweep.missions[0].mission.goal_world, Eigen::Vector3d(1, 12, 3));
  EXPECT_EQ(sweep.missions[1].mission.goal_world, Eigen::Vector3d(7, 8, 9.5));
  EXPECT_EQ(sweep.missions[1].place.line, 5);
  EXPECT_EQ(sweep.missions[1].place.file, (folder_ / "tables/missions.csv").string());
}

TEST_F(MissionLists, SeveralGoalsAreReadInOrder) {
  const SweepSpec listed = read(kSweepHead +
                                "mission: {list: [{start: [0, 0, 2], goals: [[0, 9, 3], [8, 7, 6]]}"
                                ", {start: [1, 2, 3], goals: [[1, 12, 3]]}]}\n");
  ASSERT_EQ(listed.missions.size(), 2U);
  const Mission& first = listed.missions[0].mission;
  EXPECT_EQ(goals_of(first),
            (std::vector<Eigen::Vector3d>{Eigen::Vector3d(0, 9, 3), Eigen::Vector3d(8, 7, 6)}));
  EXPECT_DOUBLE_EQ(first.start_yaw_rad, 0.5 * math::kPi);  // toward the first one
  EXPECT_TRUE(listed.missions[1].mission.waypoints_world.empty());
  // The same from a table, in which rows may have fewer goals.
  write("missions.csv",
        "start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m,goal_z_m,goal2_y_m,goal2_x_m,goal2_z_m\n"
        "0,0,2,0,9,3,7,8,6\n1,2,3,1,12,3,,,\n");
  const SweepSpec table = read(kSweepHead + "mission: {file: missions.csv}\n");
  ASSERT_EQ(table.missions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(goals_of(table.missions[i].mission), goals_of(listed.missions[i].mission));
  }
}

TEST_F(MissionLists, TheStartIsOneMoreGoalWhereTheFlightsReturn) {
  const SweepSpec sweep = read(kSweepHead +
                               "mission: {return_to_start: true, list: [{start: [1, 2, 3], goal: "
                               "[1, 12, 3]}]}\n");
  const std::vector<Mission> missions = missions_of(sweep.missions, sweep.base);
  EXPECT_EQ(goals_of(missions.front()),
            (std::vector<Eigen::Vector3d>{Eigen::Vector3d(1, 12, 3), Eigen::Vector3d(1, 2, 3)}));
}

TEST_F(MissionLists, OfOneGoalKeepTheirDigest) {
  Mission mission{.start_world = {1, 2, 3}, .goal_world = {4, 5, 6}, .start_yaw_rad = 0.5};
  const std::string one = missions_digest({mission});
  EXPECT_EQ(one.substr(0, 16), "92a6db732aa00ecd");
  mission.waypoints_world = {{7, 8, 9}};
  const std::string two = missions_digest({mission});
  EXPECT_NE(one, two);
  mission.waypoints_world[0].z() = 9.5;
  EXPECT_NE(missions_digest({mission}), two);
}

TEST_F(MissionLists, PlannersThatSeeOneGoalAreRefusedSeveral) {
  const auto with = [&](const std::string& mission) {
    return problems("sweep: a\nplanners: [tunable, one_camera]\nmission: {" + mission + "}\n");
  };
  const std::string place =
      "s.yaml:2:21: planners[1]: one_camera can't fly these missions: they "
      "have ";
  const std::string end = ", and it does not declare AB_INPUT_GOALS";
  EXPECT_EQ(with("waypoints: 0"), "");
  EXPECT_EQ(with("waypoints: 2"), place + "several goals" + end);
  EXPECT_EQ(with("return_to_start: true"), place + "several goals" + end);
  EXPECT_EQ(with("list: [{start: [1, 2, 3], goals: [[1, 9, 3], [8, 2, 3]]}]"),
            place + "several goals" + end);
  EXPECT_EQ(with("goal_motion: {path: circle}"), place + "a goal that moves" + end);
  // As one value of an axis, too.
  EXPECT_EQ(with("waypoints: [0, 1]"), place + "several goals" + end);
}

TEST_F(MissionLists, RulesThatContradictEachOtherAreRefused) {
  EXPECT_EQ(problems(kSweepHead + "mission: {waypoints: 1, list: [{start: [1, 2, 3], goal: [1, 9, "
                                  "3]}]}\n"),
            "s.yaml:3:22: mission.waypoints: has no effect on listed missions: list their goals");
  EXPECT_EQ(problems(kSweepHead + "mission: {goal_motion: {path: line}, return_to_start: true}\n"),
            "s.yaml:3:55: mission.return_to_start: the last goal is then the start, which can't "
            "move: leave it out, or mission.goal_motion");
  EXPECT_EQ(problems(kSweepHead + "mission: {waypoints: 101}\n"),
            "s.yaml:3:22: mission.waypoints: 101 is outside [0, 100]");
}

TEST_F(MissionLists, TrialsTakeTheFirstOfEachMap) {
  const std::string list =
      "mission: {list: [{map: 1, start: [1, 2, 3], goal: [1, 12, 3]}, {start: [2, 2, 3], goal: "
      "[1, 9, 3]}]}\nmaps: {seeds: 2}\n";
  EXPECT_EQ(read(kSweepHead + list).trials, 2);
  EXPECT_EQ(read(kSweepHead + list, {"trials=1"}).trials, 1);
  EXPECT_EQ(problems(kSweepHead + list + "trials: 3\n"),
            "s.yaml:5:9: trials: 3 is more than the 2 missions that are listed; without it, all "
            "are flown");
  TrialSpec trial = read(kSweepHead + list).base;
  const std::vector<ListedMission> listed = read(kSweepHead + list).missions;
  EXPECT_EQ(missions_of(listed, trial).size(), 2U);
  trial.map_seed = 2;
  ASSERT_EQ(missions_of(listed, trial).size(), 1U);
  EXPECT_EQ(missions_of(listed, trial)[0].start_world.x(), 2.0);
}

TEST_F(MissionLists, MapsAreCalledByTheirFilesOrSeeds) {
  write("office.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("cellar.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  const std::string maps = "maps: {generator: mesh, file: [office.obj, cellar.obj]}\n";
  EXPECT_EQ(of_table(kColumns + "office,1,1,1,2,2,2,\ncellar.obj,1,1,1,3,3,3,90\n", maps), "");
  EXPECT_EQ(of_table(kColumns + "office,1,1,1,2,2,2,\noffices,1,1,1,3,3,3,\n", maps),
            "s.yaml:3:10: mission: no mission is listed for map cellar.obj\n"
            "missions.csv:3:1: the sweep has no map 'offices' (did you mean office?); it has "
            "cellar.obj, office.obj");
  EXPECT_EQ(of_table(kColumns + "3,1,1,1,2,2,2,\n", "maps: {seeds: [3, 4]}\n"),
            "s.yaml:3:10: mission: no mission is listed for map 4");
}

TEST_F(MissionLists, ProblemsOfAListHaveTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"mission: {list: []}", "s.yaml:3:17: mission.list: expected at least one mission"},
      {"mission: {list: [{goal: [1, 2, 3]}]}",
       "s.yaml:3:18: mission.list[0]: lacks 'start': [x, y, z] in metres"},
      {"mission: {list: [{start: [1, 2], goal: [1, 2, 3]}]}",
       "s.yaml:3:26: mission.list[0].start: expected a list of 3 values, found 2"},
      {"mission: {list: [{start: [1, 2, x], goal: [1, 2, 3]}]}",
       "s.yaml:3:33: mission.list[0].start[2]: expected a number, found \"x\""},
      {"mission: {list: [{start: [1, 2, 1e9], goal: [1, 2, 3]}]}",
       "s.yaml:3:33: mission.list[0].start[2]: 1e9 is outside [-100000, 100000]"},
      {"mission: {list: [{start: [1, 2, 3], goal: [1, 2, 3], yaw: 3}]}",
       "s.yaml:3:54: mission.list[0].yaw: unknown key (did you mean yaw_deg?)"},
      {"mission: {list: [{start: [1, 2, 3], goal: [1, 2, 3], yaw_deg: 400}]}",
       "s.yaml:3:63: mission.list[0].yaw_deg: 400 is outside [-360, 360]"},
      {"mission: {list: [{start: [1, 2, 3]}]}",
       "s.yaml:3:18: mission.list[0]: lacks 'goal': [x, y, z] in metres"},
      {"mission: {list: [{start: [1, 2, 3], goal: [1, 2, 3], goals: [[1, 2, 3]]}]}",
       "s.yaml:3:61: mission.list[0].goals: 'goal' is given too"},
      {"mission: {list: [{start: [1, 2, 3], goals: []}]}",
       "s.yaml:3:44: mission.list[0].goals: expected at least one place, [x, y, z] in metres"},
      {"mission: {list: [{start: [1, 2, 3], goals: [[1, 2, 3], [4, 5]]}]}",
       "s.yaml:3:56: mission.list[0].goals[1]: expected a list of 3 values, found 2"},
      {"mission: {list: [7]}",
       "s.yaml:3:18: mission.list[0]: expected a mapping (name: value), found \"7\""},
      {"mission: {file: none.csv}", "s.yaml:3:17: mission.file: none.csv: no such file"},
      {"mission: {list: [{start: [1, 2, 3], goal: [1, 9, 3]}], file: x.csv}",
       "s.yaml:3:62: mission.file: mission.list is given too"},
      {"axes: {mission.list: [1, 2]}",
       "s.yaml:3:8: axes.mission.list: all missions are flown for each setting"},
      {"axes: {missions_digest: [a, b]}",
       "s.yaml:3:8: axes.missions_digest: the program fills it in"},
  };
  for (const auto& [text, problem] : cases) EXPECT_EQ(problems(kSweepHead + text), problem) << text;
}

TEST_F(MissionLists, ProblemsOfATableHaveTheirPlace) {
  const std::pair<std::string, const char*> cases[] = {
      {"", "s.yaml:3:17: mission.file: missions.csv lists no mission"},
      {kColumns, "s.yaml:3:17: mission.file: missions.csv lists no mission"},
      {"start_x_m;start_y_m\n", "missions.csv:1:1: columns must be separated by commas"},
      {kColumns + ",1,2,3,4,5\n", "missions.csv:2:1: 6 fields, but 8 columns"},
      {kColumns + ",1,2,3,4,5,,\n", "missions.csv:2:12: goal_z_m: expected a number, found \"\""},
      {kColumns + "\n,1,2, 3m,4,5,6,\n",
       "missions.csv:3:6: start_z_m: expected a number, found \"3m\""},
      {kColumns + "\"a,1,2,3,4,5,6,\n",
       "missions.csv:2:1: a quote is not closed\n"
       "missions.csv:2:1: 1 field, but 8 columns"},
      {"start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m\n",
       "missions.csv:1:1: lacks the column 'goal_z_m'"},
      {"start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m,goal_z_m,goal2_x_m\n",
       "missions.csv:1:1: lacks the column 'goal2_y_m'\n"
       "missions.csv:1:1: lacks the column 'goal2_z_m'"},
      {"start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m,goal_z_m,goal2_x_m,goal2_y_m,goal2_z_m\n"
       "1,2,3,4,5,6,7,,8\n",
       "missions.csv:2:15: goal2_y_m: expected a number, found \"\""},
      {"start_x,start_x_m,start_x_m,start_y_m,start_z_m,goal_x_m,goal_y_m,goal_z_m\n",
       "missions.csv:1:1: unknown column 'start_x' (did you mean start_x_m?); columns are "
       "start_x_m, start_y_m, start_z_m, goal_x_m, goal_y_m, goal_z_m, yaw_deg, map, and of "
       "further "
       "goals goal2_x_m, goal2_y_m, goal2_z_m\n"
       "missions.csv:1:19: a second column 'start_x_m'"},
  };
  for (const auto& [table, problem] : cases) EXPECT_EQ(of_table(table), problem) << table;
}

TEST_F(MissionLists, AnIncludedTableIsBesideTheFileThatNamesIt) {
  write("base/missions.csv", kColumns + ",1,2,3,4,15,6,\n");
  write("base/base.yaml", "mission: {file: missions.csv}\n");
  EXPECT_EQ(read("include: base/base.yaml\n" + kSweepHead).missions.size(), 1U);
}

}  // namespace
}  // namespace avoidbench
