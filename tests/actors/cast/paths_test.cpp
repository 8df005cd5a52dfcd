#include "castor/actors/cast/paths.hpp"

#include <gtest/gtest.h>

namespace castor::cast {

namespace {

TEST(Paths, HaveDirectories) {
  EXPECT_EQ(directory_of("a.cast"), "");
  EXPECT_EQ(directory_of("x/a.cast"), "x");
  EXPECT_EQ(directory_of("/a.cast"), "/");
}

TEST(Paths, OfIncludesAreRelativeToTheIncludingFile) {
  EXPECT_EQ(include_target("a.cast", "b.cast"), "b.cast");
  EXPECT_EQ(include_target("x/a.cast", "y/b.cast"), "x/y/b.cast");
  EXPECT_EQ(include_target("x/a.cast", "/b.cast"), "/b.cast");
  EXPECT_EQ(include_target("/a.cast", "b.cast"), "/b.cast");
}

TEST(Paths, AreRelativeInTheWorkingDirectoryOnly) {
  EXPECT_EQ(path_for_users("x/a", "/home/me"), "x/a");
  EXPECT_EQ(path_for_users("./x//a/.", "/home/me/"), "x/a");
  EXPECT_EQ(path_for_users("/home/me/x", "/home/me"), "x");
  EXPECT_EQ(path_for_users("/home/me", "/home/me"), ".");
  EXPECT_EQ(path_for_users("/home/me2/x", "/home/me"), "/home/me2/x");
  EXPECT_EQ(path_for_users("/x", "/"), "x");
  EXPECT_EQ(path_for_users("../x", "/home/me"), "../x");
  EXPECT_EQ(directory_for_users("a.cast", "/home/me"), ".");
  EXPECT_EQ(directory_for_users("x/../a.cast", "/home/me"), "x/..");
}

} // namespace

} // namespace castor::cast
