#include "castor/actors/supervision/child_options.hpp"

#include "castor/tests/actors/node/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

ChildOptions options(const std::string& text) {
  auto described = architecture("COMPONENT CPP camera C " + text + '\n');
  return ChildOptions{*described.component("camera")};
}

TEST(ChildOptions, AreWhatTheLineSays) {
  auto x = options("--restart transient --shutdown 250ms");
  EXPECT_EQ(x.restart, RestartType::transient);
  EXPECT_EQ(x.shutdown, 250ms);
}

TEST(ChildOptions, HaveDefaults) {
  auto x = options("");
  EXPECT_EQ(x.restart, RestartType::permanent);
  EXPECT_FALSE(x.shutdown);
}

} // namespace

} // namespace castor::test
