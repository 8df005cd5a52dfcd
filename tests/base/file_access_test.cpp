#include "castor/base/file_access.hpp"

#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace castor {

namespace {

class FileAccess : public testing::Test {
protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  test::TemporaryFolder folder_;
};

TEST_F(FileAccess, ReadsAWholeFile) {
  std::string text(200'000, 'x');
  auto path = write("a.cast", text);
  EXPECT_EQ(read_file(path, 1'000'000).text, text);
}

TEST_F(FileAccess, StopsOneByteBehindTheLimit) {
  auto path = write("a.cast", std::string(1000, 'x'));
  EXPECT_EQ(read_file(path, 10).text, std::string(11, 'x'));
}

TEST_F(FileAccess, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(read_file(folder_ / "missing", 10).error, "no such file");
  EXPECT_EQ(read_file(folder_.path(), 10).error, "it is a directory");
  EXPECT_EQ(read_file("/dev/zero", 10).error, "it is a character device, not a regular file");
  EXPECT_FALSE(read_file(folder_ / "a/b", 10).text);
  EXPECT_FALSE(read_file(std::string(10'000, 'x'), 10).error.empty());
}

TEST_F(FileAccess, ReportsAnUnreadableFile) {
  auto path = write("a.cast", "HOST a");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  if (std::ifstream(path).is_open())
    GTEST_SKIP() << "this user may read everything";
  EXPECT_FALSE(read_file(path, 10).error.empty());
}

TEST_F(FileAccess, KnowsTheProcessEnvironment) {
  ::setenv("CASTOR_CAST_TEST", "value", 1);
  EXPECT_EQ(process_environment("CASTOR_CAST_TEST"), "value");
  ::unsetenv("CASTOR_CAST_TEST");
  EXPECT_EQ(process_environment("CASTOR_CAST_TEST"), std::nullopt);
  EXPECT_EQ(process_environment(""), std::nullopt);
}

} // namespace

} // namespace castor
