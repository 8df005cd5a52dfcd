#include "castor/actors/runtime/plugin.hpp"

#include "castor/actors/runtime/bundled_plugins.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dlfcn.h>

#include <cstdlib>
#include <iostream>
#include <set>
#include <string>

namespace castor::test {

namespace {

using testing::IsEmpty;
using testing::Not;

bool is_loaded(const std::string& class_name) {
  return dlopen(bundled_plugin_of(class_name).c_str(), RTLD_LAZY | RTLD_NOLOAD) != nullptr;
}

/// Ends the process, which has loaded libraries, with whether it did as it should.
void finish(bool is_right) {
  std::_Exit(is_right ? 0 : 1);
}

/// Each test in a process of its own, since libraries stay.
class FindClass : public testing::Test {
protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(FindClass, LoadsOnlyTheLibraryOfTheClass) {
  ASSERT_THAT(bundled_plugin_of("Segmentor"), Not(IsEmpty()));
  ASSERT_THAT(bundled_plugin_of("LoopCloser"), Not(IsEmpty()));
  auto find = [] {
    bool is_right = !is_loaded("Segmentor") && find_class("Segmentor").found &&
                    is_loaded("Segmentor") && lacks_bundled_plugins();
    finish(is_right && !is_loaded("LoopCloser"));
  };
  EXPECT_EXIT(find(), testing::ExitedWithCode(0), "");
}

TEST_F(FindClass, LooksThroughAllLibrariesForOneThatNoneIsKnownFor) {
  auto find = [] {
    bool is_right = find_class("Segmentor").found && !find_class("Segmenter").found &&
                    is_loaded("LoopCloser") && !lacks_bundled_plugins();
    finish(is_right && find_class("Segmenter").problem.find("Segmentor") != std::string::npos);
  };
  EXPECT_EXIT(find(), testing::ExitedWithCode(0), "");
}

TEST_F(FindClass, KnowsTheLibraryOfEachClass) {
  auto look = [] {
    std::set<std::string> own;
    for (auto* x : Registry::instance().all())
      own.insert(x->name);
    load_bundled_plugins();
    bool is_right = Registry::instance().all().size() > own.size() + 20;
    for (auto* x : Registry::instance().all())
      if (!own.contains(x->name) && !is_loaded(x->name)) {
        std::cerr << "no library is known for " << x->name << "; was CMake run since?\n";
        is_right = false;
      }
    finish(is_right);
  };
  EXPECT_EXIT(look(), testing::ExitedWithCode(0), "");
}

} // namespace

} // namespace castor::test
