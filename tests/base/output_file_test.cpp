#include "base/output_file.hpp"

#include <gtest/gtest.h>

#include "base/input_error.hpp"
#include "base/input_file.hpp"
#include "support/input_error_message.hpp"
#include "support/temporary_folder.hpp"

namespace avoidbench {
namespace {

struct OutputFile : testing::Test {
  std::string refusal(const std::string& name) const {
    return test::message_of([&] { check_output_file(folder / name); });
  }
  test::TemporaryFolder folder;
};

TEST_F(OutputFile, IsNoDatabaseWhateverItsName) {
  folder.write("table.csv", std::string("SQLite format 3\0 and so on", 27));
  EXPECT_NE(refusal("table.csv").find("it is a database"), std::string::npos);
  EXPECT_THROW(open_output(folder / "table.csv"), InputError);
  folder.write("text.db", "SQLite format 2");
  EXPECT_EQ(refusal("text.db"), "");
}

TEST_F(OutputFile, IsNoPartOfADatabase) {
  folder.write("x.db", "SQLite format 3");
  for (const char* part : {"x.db-wal", "x.db-shm", "x.db-journal"}) {
    EXPECT_NE(refusal(part).find("part of the database next to it"), std::string::npos) << part;
    folder.write(part, "rows");
    EXPECT_THROW(open_output(folder / part), InputError) << part;
  }
  EXPECT_EQ(refusal("x.db-walnut"), "");
  EXPECT_EQ(refusal("y.db-wal"), "");  // of no database
}

/// Until it is finished the former file is there; of an unfinished one nothing stays.
TEST_F(OutputFile, IsThereOnceItIsWhole) {
  const std::filesystem::path file = folder.write("w.txt", "before");
  {
    WholeFile whole(file);
    whole.stream() << "half";
    EXPECT_EQ(read_input_file(file, 100), "before");
  }
  EXPECT_EQ(read_input_file(file, 100), "before");
  {
    WholeFile whole(file);
    whole.stream() << "wrong";
    whole.restart();
    whole.stream() << "all";
    whole.check();
    whole.finish();
    EXPECT_EQ(read_input_file(file, 100), "all");
  }
  EXPECT_EQ(read_input_file(file, 100), "all");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  folder.write("y.db", "SQLite format 3");
  EXPECT_THROW(WholeFile(folder / "y.db"), InputError);
}

TEST_F(OutputFile, HasItsFolder) {
  EXPECT_NE(refusal("none/x.csv").find("no folder"), std::string::npos);
  EXPECT_NE(refusal(".").find("it is a folder"), std::string::npos);
  std::ofstream stream = open_output(folder / "x.csv");
  stream << "a,b\n";
  close_output(stream, folder / "x.csv");
  EXPECT_EQ(std::filesystem::file_size(folder / "x.csv"), 4U);
}

}  // namespace
}  // namespace avoidbench
