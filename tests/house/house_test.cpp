#include "castor/tests/house/include_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

using ::testing::IsEmpty;

namespace {

IncludeGraph product() {
  return include_graph(CASTOR_SOURCE_DIR, product_folders(CASTOR_SOURCE_DIR));
}

/// As CMake knows them: on each line a folder, and those that it may include.
Modules modules_of_build() {
  std::ifstream in{CASTOR_MODULES};
  Modules result;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words{line};
    std::string folder;
    words >> folder;
    auto& uses = result[folder];
    for (std::string x; words >> x;)
      uses.insert(x);
  }
  return result;
}

const std::regex robots_file{"(perception|binding|communication|mapping|planning)/.*"};
const std::regex meeting_point{
  "(perception|binding|communication|mapping|planning)/(.*/)?(types|binding_monitor)\\.hpp"};

/// Robots meet on working memories: of one another their parts know the entry types, and what
/// binding monitors are made of.
void leave_out_meeting_points(IncludeGraph& graph) {
  for (auto& [file, includes] : graph)
    if (std::regex_match(file, robots_file))
      std::erase_if(includes, [](auto& x) { return std::regex_match(x, meeting_point); });
}

} // namespace

TEST(House, FilesIncludeOnlyWhatTheirFolderDependsOn) {
  auto modules = modules_of_build();
  ASSERT_GT(modules.size(), 20u);
  auto graph = product();
  leave_out_meeting_points(graph);
  EXPECT_THAT(forbidden_includes(graph, modules), IsEmpty());
}

TEST(House, EveryFileIsInAFolderThatCMakeKnows) {
  auto modules = modules_of_build();
  for (auto& [file, includes] : product()) {
    auto is_in = [&](auto& module) { return file.starts_with(module.first + "/"); };
    EXPECT_TRUE(std::any_of(modules.begin(), modules.end(), is_in)) << file;
  }
}

TEST(House, FilesDoNotIncludeOneAnotherInACircle) {
  EXPECT_THAT(circles(product()), IsEmpty());
}

} // namespace castor::test
