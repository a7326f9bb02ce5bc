#include "base/kept_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/digest.hpp"
#include "support/temporary_folder.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A folder with a library, a script, a program and a map, and the database of a run with them.
struct KeptFiles : testing::Test {
  FlownFile written(const std::string& name, const std::string& text) const {
    const fs::path file = folder.path() / name;
    std::ofstream(file) << text;
    return {.file = file.string(), .digest = file_digest(file)};
  }

  test::TemporaryFolder folder;
  fs::path database = folder / "run.db";
};

TEST_F(KeptFiles, AreFoundByTheirDigestsAfterTheOriginalsAreGone) {
  const FlownFile library = written("fast.so", "library");
  FlownFile script = written("fast.py", "script"), program = written("fast", "program");
  script.is_program = program.is_program = true;
  FlownFile map = written("room.obj", "map");
  map.is_planner = false;
  const std::vector<FlownFile> all{library, script, program, map};
  EXPECT_EQ(keep_files(all, database), std::vector<std::string>{});
  for (const FlownFile& file : all) fs::remove(file.file);
  EXPECT_EQ(keep_files(all, database), std::vector<std::string>{});  // what is there stays
  const fs::path planners = folder / "run.planners";
  EXPECT_EQ(kept_planner(database, library.digest), planners / (library.digest + ".so"));
  EXPECT_EQ(kept_planner(database, script.digest), planners / (script.digest + ".py"));
  EXPECT_EQ(kept_planner(database, program.digest), planners / (program.digest + ".run"));
  EXPECT_EQ(content(planners / (program.digest + ".run")), "program");
  const auto rights = fs::status(planners / (program.digest + ".run")).permissions();
  EXPECT_NE(rights & fs::perms::owner_exec, fs::perms::none);
  EXPECT_EQ(kept_map(database, map.digest, "any.obj"), folder / "run.maps" / (map.digest + ".obj"));
  EXPECT_EQ(kept_map(database, map.digest, "any.ply"), std::nullopt);
  EXPECT_EQ(kept_planner(database, map.digest), std::nullopt);
  EXPECT_EQ(kept_planner(database, ""), std::nullopt);
}

TEST_F(KeptFiles, OnlyWhatHasTheDigestIsKeptAndFound) {
  const FlownFile library = written("fast.so", "library");
  std::ofstream(library.file) << "another one";
  EXPECT_EQ(keep_files({library}, database),
            std::vector{library.file + ": changed since the sweep was read"});
  EXPECT_EQ(kept_planner(database, library.digest), std::nullopt);
  // Nothing half written is left.
  EXPECT_TRUE(fs::is_empty(folder / "run.planners"));
  std::ofstream(folder / "run.planners" / (library.digest + ".so")) << "forged";
  EXPECT_EQ(kept_planner(database, library.digest), std::nullopt);
  std::ofstream(library.file) << "library";
  EXPECT_EQ(keep_files({library}, database), std::vector<std::string>{});
  EXPECT_NE(kept_planner(database, library.digest), std::nullopt);
}

TEST_F(KeptFiles, WhatCanNotBeReadIsSaid) {
  const std::vector<std::string> problems =
      keep_files({{.file = (folder / "gone.so").string(), .digest = "00"}}, database);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems.front().find("gone.so"), std::string::npos) << problems.front();
}

TEST_F(KeptFiles, MergeTakesThemAndLeavesForgedOnes) {
  const FlownFile library = written("fast.so", "library");
  keep_files({library}, database);
  std::ofstream(folder / "run.planners" / "1234.so") << "not of this digest";
  const fs::path into = folder / "all" / "all.db";
  fs::create_directories(into.parent_path());
  EXPECT_EQ(merge_kept_files(into, database), std::vector<std::string>{});
  EXPECT_EQ(kept_planner(into, library.digest),
            folder / "all" / "all.planners" / (library.digest + ".so"));
  EXPECT_FALSE(fs::exists(folder / "all" / "all.planners" / "1234.so"));
}

TEST_F(KeptFiles, AreFoundWithOtherDatabasesOfTheFolder) {
  const FlownFile library = written("fast.so", "library");
  keep_files({library}, database);
  EXPECT_EQ(kept_planner(folder / "renamed.db", library.digest),
            folder / "run.planners" / (library.digest + ".so"));
}

}  // namespace
}  // namespace avoidbench
