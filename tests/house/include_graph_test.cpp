#include "castor/tests/house/include_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace castor::test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

/// Two modules, one on top of the other.
const Modules modules{{"low", {}}, {"high", {"low"}}};

} // namespace

TEST(ForbiddenIncludes, AreThoseThatLeadUpwards) {
  IncludeGraph graph{{"high/a.cpp", {"high/a.hpp", "low/b.hpp"}}, {"low/b.hpp", {"high/a.hpp"}}};
  EXPECT_THAT(forbidden_includes(graph, modules), ElementsAre("low/b.hpp includes high/a.hpp"));
}

TEST(ForbiddenIncludes, AreThoseOfFoldersThatAreNotNamed) {
  IncludeGraph graph{{"low/b.hpp", {"other/c.hpp"}}, {"other/c.hpp", {"low/b.hpp"}}};
  EXPECT_THAT(forbidden_includes(graph, modules), ElementsAre("low/b.hpp includes other/c.hpp"));
}

TEST(ForbiddenIncludes, CountAFolderWithinARoomAsTheRoom) {
  IncludeGraph graph{{"low/deep/b.hpp", {"low/c.hpp", "high/a.hpp"}}};
  EXPECT_THAT(forbidden_includes(graph, modules),
              ElementsAre("low/deep/b.hpp includes high/a.hpp"));
}

TEST(Circles, AreFoundThroughHeadersAndSources) {
  IncludeGraph graph{{"x/a.hpp", {"x/b.hpp"}},
                     {"x/b.cpp", {"x/b.hpp", "x/c.hpp"}},
                     {"x/c.hpp", {"x/a.hpp"}},
                     {"x/d.hpp", {"x/a.hpp"}}};
  EXPECT_THAT(circles(graph), ElementsAre(ElementsAre("x/a", "x/b", "x/c")));
}

TEST(Circles, AreNotMadeByASourceAndItsHeader) {
  IncludeGraph graph{{"x/a.cpp", {"x/a.hpp", "x/b.hpp"}}, {"x/b.hpp", {}}};
  EXPECT_THAT(circles(graph), IsEmpty());
}

TEST(IncludeGraphOfFolders, HasWhatTheLinesOfAFileInclude) {
  auto root = std::filesystem::path{testing::TempDir()} / "include_graph";
  std::filesystem::create_directories(root / "low");
  std::ofstream{root / "low/b.hpp"} << "#pragma once\n#include \"castor/low/c.hpp\"\n"
                                       "#include <castor/low/d.hpp>\n#include <vector>\n";
  EXPECT_THAT(include_graph(root, {"low"}),
              ElementsAre(testing::Pair("low/b.hpp", ElementsAre("low/c.hpp", "low/d.hpp"))));
}

} // namespace castor::test
