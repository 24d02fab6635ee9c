// Tables of a run's folder, as an audit reads them.
#include <test/support/error_of.hpp>

#include <seiche/output/text_table.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

namespace seiche::test {
namespace TEST_FILE {

TEST(TextTables, HoldQuotedCellsOverSeveralLines) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("seiche_table_{}.csv", getpid());
  std::ofstream(file) << "member,H,message\n1,0.5,\"a, \"\"b\"\"\nand c\"\n2,,d\n";
  const TextTable table(file);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "message"), "a, \"b\"\nand c");
  EXPECT_EQ(table.number(0, "H"), 0.5);
  EXPECT_TRUE(std::isnan(table.number(1, "H"))) << "nothing was written";
  EXPECT_THAT(error_of([&] { table.number(0, "message"); }),
              testing::HasSubstr("in row 1 under message is not a number"));
  EXPECT_THAT(error_of([&] { table.text(0, "t"); }), testing::HasSubstr("has no column t"));
  for (const auto& [text, complaint] :
       {std::pair("a,b\n1\n", "row 1 has 1 cells under 2 names"), {"a\n\"1\n", "ends inside quotes"}}) {
    std::ofstream(file) << text;
    EXPECT_THAT(error_of([&] { TextTable{file}; }), testing::HasSubstr(complaint));
  }
  std::filesystem::remove(file);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
