#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/digest.hpp"
#include "plugin/bad_planners.hpp"
#include "plugin/elf_symbols.hpp"
#include "support/input_error_message.hpp"

namespace avoidbench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Loading, TakesAnHonestPlanner) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner("honest"));
  EXPECT_EQ(library.description().name, "honest");
  EXPECT_EQ(library.description().commands, AB_COMMAND_VELOCITY);
  EXPECT_EQ(library.description().file_digest, file_digest(bad_planner("honest")));
  EXPECT_NE(library.table().plan, nullptr);
}

TEST(Loading, TakesAPlannerInC) {
  const PlannerLibrary library = PlannerLibrary::load(C_PLANNER);
  EXPECT_EQ(library.description().name, "c_planner");
  ASSERT_EQ(library.description().parameters.size(), 2U);
  EXPECT_EQ(library.description().parameters[0].name, "speed_mps");
  EXPECT_THAT(library.description().parameters[1].choices, testing::ElementsAre("level", "climb"));
}

TEST(Loading, NamesTheFileAndWhatIsWrong) {
  EXPECT_THAT(
      load_error(bad_planner("wrong_abi")),
      AllOf(HasSubstr("wrong_abi.so: "), HasSubstr("is of ABI 7"), HasSubstr("needs ABI 1")));
  EXPECT_THAT(load_error(bad_planner("newer_symbol")),
              AllOf(HasSubstr("is a planner of ABI 2"), HasSubstr("needs ABI 1")));
  EXPECT_THAT(load_error(bad_planner("refuses")), HasSubstr("refuses ABI 1"));
  EXPECT_THAT(
      load_error(bad_planner("no_symbol")),
      AllOf(HasSubstr("not a planner"), HasSubstr("does not export avoidbench_planner_v1")));
  EXPECT_THAT(load_error(bad_planner("short_struct")), HasSubstr("struct_size 40"));
  EXPECT_THAT(load_error(bad_planner("null_function")), HasSubstr("function plan is null"));
  EXPECT_THAT(load_error(bad_planner("bad_name")),
              AllOf(HasSubstr("its name is 'Bad Name'"), HasSubstr("commands have bits")));
  EXPECT_THAT(load_error(bad_planner("bad_ranges")),
              AllOf(HasSubstr("the preset is outside"), HasSubstr("lowest is above highest"),
                    HasSubstr("'slow' is not one of the choices"),
                    HasSubstr("two parameters are named 'gain'")));
}

TEST(Loading, SaysWhatIsWrongWithProfiles) {
  EXPECT_THAT(
      load_error(bad_planner("bad_profiles")),
      AllOf(HasSubstr("profile 0 has a number for 'speed_mps' that the parameter can't have"),
            HasSubstr("profile 1 has a number for 'rays' that the parameter can't have"),
            HasSubstr("profile 2 has 'speed', which is not a numeric parameter"),
            HasSubstr("profile 3 has 'mode', which is not a numeric parameter"),
            HasSubstr("profile 4 is of 'rays', which is not a choice parameter"),
            HasSubstr("profile 5 is of the word 'slow', which is not a choice of 'mode'"),
            Not(HasSubstr("profile 6")), HasSubstr("profile 7 is the second of its word"),
            HasSubstr("profile 8 is null")));
}

TEST(Loading, RefusesMoreFilesThanItFollows) {
  EXPECT_THAT(load_error(bad_planner("many_files")),
              HasSubstr("it names 1001 files that it depends on; at most 1000 are followed"));
}

/// Told when it is described, so that no trial is flown to find it out.
TEST(Loading, RefusesAPlannerThatSaysItCantFly) {
  try {
    describe_planner(bad_planner("fails_check"), 10.0);
    ADD_FAILURE() << "described";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("fails_check.so"),
                                    HasSubstr("can't fly: weights.bin ends after 12 of 40 bytes")));
  }
}

TEST(Loading, TakesATableOfBeforeProfiles) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner("before_profiles"));
  EXPECT_TRUE(library.description().profiles.empty());
  EXPECT_EQ(library.description().least_fov_x_rad, 0.0);
}

TEST(Loading, SaysWhatIsWrongWithDemandsOnCameras) {
  EXPECT_THAT(load_error(bad_planner("bad_cameras")),
              AllOf(HasSubstr("its least field of view is not within [0, π)"),
                    HasSubstr("it says which cameras it can fly with, but sees no images")));
  const PlannerDescription planner =
      PlannerLibrary::load(bad_planner("one_wide_camera")).description();
  EXPECT_EQ(planner.needs, AB_INPUT_STATE | AB_INPUT_DEPTH | AB_INPUT_ONE_CAMERA);
  EXPECT_EQ(planner.least_fov_x_rad, 1.5);
  EXPECT_EQ(planner.least_fov_y_rad, 1.0);
}

TEST(Loading, RefusesWhatIsNoLibrary) {
  const auto folder = scratch_folder("no_library");
  std::ofstream(folder / "text.so") << "planner: yes\n";
  std::ofstream(folder / "empty.so").flush();
  std::ifstream whole(bad_planner("honest"), std::ios::binary);
  std::string half(3000, '\0');
  whole.read(half.data(), 3000);
  std::ofstream(folder / "half.so", std::ios::binary) << half;
  EXPECT_THAT(load_error(folder / "text.so"), HasSubstr("text.so: is not a shared library"));
  EXPECT_THAT(load_error(folder / "empty.so"), HasSubstr("is not a shared library"));
  EXPECT_THAT(load_error(folder / "half.so"), HasSubstr("half.so: "));
  EXPECT_THAT(load_error(folder), HasSubstr("is not a file"));
  EXPECT_THAT(load_error(folder / "none.so"), HasSubstr("no such file"));
}

TEST(ElfSymbols, TellProgramsFromLibraries) {
  EXPECT_TRUE(is_elf_program("/proc/self/exe"));
  EXPECT_TRUE(is_elf_program(STATIC_PROGRAM));
  EXPECT_FALSE(is_elf_program(bad_planner("honest")));
  EXPECT_FALSE(is_elf_program("/nowhere"));
}

TEST(ElfSymbols, NameTheFunctionOfAnAddress) {
  const std::string file = bad_planner("talks");
  // Of a function that is not exported, by its own table.
  std::string name;
  std::uint64_t address = 0;
  for (std::uint64_t at = 0; at < 100'000 && name.empty(); at += 4) {
    const std::string found = function_at(file, at);
    if (found.find("crash_deep_inside") == std::string::npos) continue;
    name = found;
    address = at;
  }
  ASSERT_FALSE(name.empty());
  EXPECT_NE(function_at(file, address + 1), name);
  EXPECT_EQ(function_at(file, address + 1).substr(0, name.rfind('+')),
            name.substr(0, name.rfind('+')));
  EXPECT_EQ(function_at(file, ~std::uint64_t{0}), "");
  EXPECT_EQ(function_at("/nowhere.so", address), "");
}

TEST(ElfSymbols, SurviveEveryCutAndManyFlips) {
  std::ifstream in(bad_planner("honest"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::vector<std::string> names = exported_symbols(bad_planner("honest"));
  EXPECT_THAT(names, testing::Contains("avoidbench_planner_v1"));
  EXPECT_THAT(needed_libraries(NEEDS_A_SOLVER), testing::Contains("libclock_solver.so"));
  const auto file = scratch_folder("elf") / "damaged.so";
  for (std::size_t at = 0; at < 64; ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x7f);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_LE(exported_symbols(file).size(), whole.size());
    EXPECT_LE(imported_symbols(file).size(), whole.size());
    EXPECT_LE(needed_libraries(file).size(), whole.size());
    std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() * at / 64);
    EXPECT_THAT(exported_symbols(file), testing::IsSubsetOf(names));
  }
}

/// The path of the environment for as long as it lives.
class PlannerPath {
 public:
  explicit PlannerPath(const std::string& value) {
    setenv("AVOIDBENCH_PLANNER_PATH", value.c_str(), 1);
  }
  ~PlannerPath() { unsetenv("AVOIDBENCH_PLANNER_PATH"); }
};

std::string find_error(const std::string& plugin, const std::filesystem::path& base) {
  return test::message_of([&] { find_planner(plugin, base); });
}

TEST(Lookup, GoesThroughThePathInOrder) {
  const auto first = scratch_folder("first"), second = scratch_folder("second");
  std::filesystem::copy_file(bad_planner("honest"), second / "honest.so");
  const PlannerPath path(first.string() + "::" + second.string());
  const auto folders = planner_search_path();
  ASSERT_GE(folders.size(), 3U);
  EXPECT_EQ(folders[0], first);
  EXPECT_EQ(folders[1], second);
  EXPECT_EQ(folders[2], std::filesystem::path(AVOIDBENCH_BINARY_DIR) / "planners");
  EXPECT_EQ(find_planner("honest", "."), second / "honest.so");
  std::filesystem::copy_file(bad_planner("honest"), first / "honest.so");
  EXPECT_EQ(find_planner("honest", "."), first / "honest.so");
}

TEST(Lookup, SaysWhereItLookedAndWhatIsThere) {
  const PlannerPath path(BAD_PLANNERS);
  EXPECT_THAT(find_error("honets", "."),
              AllOf(HasSubstr("no planner 'honets' (did you mean honest?)"),
                    HasSubstr(BAD_PLANNERS), HasSubstr("null_function")));
  EXPECT_THAT(find_error("honest.so", "."), HasSubstr("write ./honest.so"));
  EXPECT_THAT(find_error("", "."), HasSubstr("empty"));
}

TEST(Lookup, TakesPathsRelativeToTheSweepFile) {
  const std::filesystem::path folder = BAD_PLANNERS;
  EXPECT_EQ(find_planner("./honest.so", folder), folder / "honest.so");
  EXPECT_EQ(find_planner("../bad/honest.so", folder), folder / "honest.so");
  EXPECT_EQ(find_planner((folder / "honest.so").string(), "/"), folder / "honest.so");
  EXPECT_THAT(find_error("./honets.so", folder), HasSubstr("did you mean honest?"));
  EXPECT_THAT(find_error("./nowhere/x.so", folder), HasSubstr("there is no folder"));
}

TEST(Lookup, ListsWhatLoadsAndNamesTheRest) {
  const auto folder = scratch_folder("list");
  std::filesystem::copy_file(bad_planner("honest"), folder / "honest.so");
  std::filesystem::copy_file(bad_planner("fails_inside"), folder / "fails_inside.so");
  std::filesystem::copy_file(bad_planner("no_symbol"), folder / "no_symbol.so");
  const PlannerPath path(folder.string());
  std::vector<std::string> problems, names;
  for (const auto& planner : list_planners(problems)) names.push_back(planner.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"fails_inside", "honest"}));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_THAT(problems[0], HasSubstr("no_symbol.so"));
}

PlannerDescription described() {
  PlannerDescription planner;
  planner.name = "p";
  planner.parameters = {{"speed_mps", "m/s", "Speed.", AB_NUMBER, 0.5, 20.0, 3.0, {}, ""},
                        {"ray_count", "", "Rays.", AB_INTEGER, 1.0, 100.0, 10.0, {}, ""},
                        {"mode", "", "Mode.", AB_CHOICE, 0.0, 0.0, 0.0, {"safe", "fast"}, "safe"},
                        {"model_file", "", "Model.", AB_TEXT, 0.0, 0.0, 0.0, {}, "a.onnx"}};
  return planner;
}

TEST(Parameters, TakePresetsWhereNothingIsGiven) {
  const auto values =
      resolve_parameters(described(), {{"ray_count", {20.0, ""}}, {"mode", {0.0, "fast"}}});
  ASSERT_EQ(values.size(), 4U);
  EXPECT_EQ(values[0].number, 3.0);
  EXPECT_EQ(values[1].number, 20.0);
  EXPECT_EQ(values[2].text, "fast");
  EXPECT_EQ(values[3].text, "a.onnx");
}

TEST(Parameters, AllSlipsAreFoundAtOnce) {
  const auto problems = check_parameters(described(), {{"speed", {3.0, ""}},
                                                       {"speed_mps", {25.0, ""}},
                                                       {"ray_count", {2.5, ""}},
                                                       {"mode", {0.0, "fsat"}}});
  EXPECT_THAT(problems,
              testing::UnorderedElementsAre(
                  AllOf(StartsWith("speed: "), HasSubstr("did you mean speed_mps?")),
                  HasSubstr("25 is outside [0.5, 20] m/s"), HasSubstr("2.5 is not a whole number"),
                  HasSubstr("'fsat' is not one of safe, fast (did you mean fast?)")));
}

}  // namespace
}  // namespace avoidbench
