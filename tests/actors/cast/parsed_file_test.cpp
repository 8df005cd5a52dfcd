#include "castor/actors/cast/parser.hpp"

#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace castor::cast {

namespace {

class ParsedFile : public testing::Test {
protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  castor::test::TemporaryFolder folder_;
};

TEST_F(ParsedFile, IsARealOneByDefault) {
  write("part.cast", "COMPONENT CPP viewer Viewer\n");
  auto main = write("main.cast", "HOST localhost\nINCLUDE part.cast\n");
  auto result = parse_file(main);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->file, main);
  EXPECT_EQ(result.architecture->config_dir, folder_.path());
  EXPECT_EQ(result.architecture->standalone.at(0).where.include_chain().at(0).file, main);
}

TEST_F(ParsedFile, IsNoDirectory) {
  auto result = parse_file(folder_.path());
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_NE(result.diagnostics[0].message.find("it is a directory"), std::string::npos);
}

} // namespace

} // namespace castor::cast
