#include "castor/base/file_access.hpp"

#include "castor/actors/cast/parser.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace castor::cast {

namespace {

class Surroundings : public testing::Test {
protected:
  void SetUp() override {
    auto name = testing::UnitTest::GetInstance()->current_test_info()->name();
    directory_ = std::filesystem::temp_directory_path() / (std::string("castor_cast_") + name);
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }

  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string write(const std::string& name, const std::string& text) {
    auto path = directory_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

  std::filesystem::path directory_;
};

TEST_F(Surroundings, ReadsAWholeFile) {
  std::string text(200'000, 'x');
  auto path = write("a.cast", text);
  EXPECT_EQ(read_file(path, 1'000'000).text, text);
}

TEST_F(Surroundings, StopsOneByteBehindTheLimit) {
  auto path = write("a.cast", std::string(1000, 'x'));
  EXPECT_EQ(read_file(path, 10).text, std::string(11, 'x'));
}

TEST_F(Surroundings, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(read_file((directory_ / "missing").string(), 10).error, "no such file");
  EXPECT_EQ(read_file(directory_.string(), 10).error, "it is a directory");
  EXPECT_EQ(read_file("/dev/zero", 10).error, "it is a character device, not a regular file");
  EXPECT_FALSE(read_file((directory_ / "a" / "b").string(), 10).text);
  EXPECT_FALSE(read_file(std::string(10'000, 'x'), 10).error.empty());
}

TEST_F(Surroundings, ReportsAnUnreadableFile) {
  auto path = write("a.cast", "HOST a");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  if (std::ifstream(path).is_open())
    GTEST_SKIP() << "this user may read everything";
  EXPECT_FALSE(read_file(path, 10).error.empty());
}

TEST_F(Surroundings, KnowsTheProcessEnvironment) {
  ::setenv("CASTOR_CAST_TEST", "value", 1);
  EXPECT_EQ(process_environment("CASTOR_CAST_TEST"), "value");
  ::unsetenv("CASTOR_CAST_TEST");
  EXPECT_EQ(process_environment("CASTOR_CAST_TEST"), std::nullopt);
  EXPECT_EQ(process_environment(""), std::nullopt);
}

TEST_F(Surroundings, ParsesRealFilesByDefault) {
  write("part.cast", "COMPONENT CPP viewer Viewer\n");
  auto main = write("main.cast", "HOST localhost\nINCLUDE part.cast\n");
  auto result = parse_file(main);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->file, main);
  EXPECT_EQ(result.architecture->config_dir, directory_.string());
  EXPECT_EQ(result.architecture->standalone.at(0).where.include_chain().at(0).file, main);
}

TEST_F(Surroundings, RefusesADirectoryForAFile) {
  auto result = parse_file(directory_.string());
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_NE(result.diagnostics[0].message.find("it is a directory"), std::string::npos);
}

} // namespace

} // namespace castor::cast
