#include "castor/base/named_file.hpp"

#include "castor/base/output_file.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace castor {

namespace {

TEST(NamedFile, IsLookedForInTheWorkingDirectoryAndThenInTheBase) {
  const test::TemporaryFolder folder;
  const std::string name = "a-name-that-no-file-in-the-working-directory-has";
  EXPECT_EQ(file_named(name, folder.path()), name);
  std::ofstream{folder / name} << "x";
  EXPECT_EQ(file_named(name, folder.path()), folder / name);
  EXPECT_EQ(file_named(name, ""), name);
  EXPECT_EQ(file_named("/nowhere", folder.path()), "/nowhere");
}

TEST(OutputFile, ReplacesAFileAndLeavesNothingBeside) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(replace_file(folder / "x", "one"));
  EXPECT_TRUE(replace_file(folder / "x", "two"));
  std::ifstream in{folder / "x"};
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>{in}, {}), "two");
  EXPECT_FALSE(exists(folder / "x.new"));
  EXPECT_FALSE(replace_file(folder / "none" / "x", "three"));
}

} // namespace

} // namespace castor
