// Incremental development: the same file with parts of it left out. Nothing breaks, only what these
// parts would have triggered is missing.
#include "castor/binding/types.hpp"
#include "castor/communication/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/tests/playmate/playmate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

constexpr const char* question = "What colour is the ball? Is the triangle in front of the ball?";

template <class T>
std::vector<T> all(TestSystem& system, const std::string& subarchitecture) {
  std::vector<T> result;
  for (auto& entry : system.system().entries(subarchitecture))
    if (auto x = entry->value.as<T>())
      result.push_back(*x);
  return result;
}

std::set<std::string> answers(TestSystem& system) {
  std::set<std::string> result;
  for (auto& x : all<communication::SpokenOutputItem>(system, "communication"))
    result.insert(x.text);
  return result;
}

std::set<std::string> sources(TestSystem& system) {
  std::set<std::string> result;
  for (auto& x : all<binding::BindingUnion>(system, "binding"))
    result.insert(x.sources.begin(), x.sources.end());
  return result;
}

std::string without_subarchitecture(const std::string& name) {
  auto text = without_lines(playmate_cast(), "SUBARCHITECTURE " + name, "SUBARCHITECTURE ");
  return without_lines(text, "ACCESS " + name, "");
}

TEST(LeftOut, NothingIsMissingIfNothingIs) {
  TestSystem system{playmate_cast(), playmate_options({{"say", question}, {"tracker", "yes"}})};
  system.wait_until("both questions are answered", [&] {
    return answers(system) == std::set<std::string>{"It is red.", "Yes."};
  });
  EXPECT_EQ(sources(system), (std::set<std::string>{"spatial", "vision"}));
  system.expect_nobody_else_down();
}

TEST(LeftOut, WithoutTheTrackerThingsAreFoundAndBoundAllTheSame) {
  TestSystem system{playmate_cast(), playmate_options({{"say", question}, {"tracker", "no"}})};
  system.wait_until("both questions are answered", [&] {
    return answers(system) == std::set<std::string>{"It is red.", "Yes."};
  });
  // The tracker takes over what the segmentor has found; now nobody does.
  for (auto& x : all<vision::SceneObject>(system, "vision"))
    EXPECT_EQ(x.managing_process, "segmentor");
  system.expect_nobody_else_down();
}

TEST(LeftOut, WithoutTheSpatialSubarchitectureNothingIsLeftOfAnything) {
  TestSystem system{without_subarchitecture("spatial"), playmate_options({{"say", question}})};
  system.wait_until("both questions are answered", [&] {
    return answers(system) == std::set<std::string>{"It is red.", "No."};
  });
  EXPECT_EQ(sources(system), std::set<std::string>{"vision"});
  system.expect_nobody_else_down();
}

TEST(LeftOut, WithoutCommunicationTheRobotSeesAndBindsInSilence) {
  TestSystem system{without_subarchitecture("communication"), playmate_options({})};
  system.wait_until("six things are bound", [&] {
    auto unions = all<binding::BindingUnion>(system, "binding");
    return std::ranges::count_if(unions, [](auto& x) {
             return std::ranges::any_of(
               x.features, [](auto& y) { return y.kind == binding::FeatureKind::shape; });
           }) == 6;
  });
  system.wait_until("all places are bound to what is seen there", [&] {
    auto unions = all<binding::BindingUnion>(system, "binding");
    return std::ranges::count_if(unions, [](auto& x) {
             return x.sources == std::vector<std::string>{"spatial", "vision"} ||
                    x.sources == std::vector<std::string>{"vision", "spatial"};
           }) == 6;
  });
  EXPECT_EQ(sources(system), (std::set<std::string>{"spatial", "vision"}));
  system.expect_nobody_else_down();
}

TEST(LeftOut, WithoutBindingWhatIsSaidIsUnderstoodAllTheSame) {
  auto text = without_subarchitecture("binding");
  for (auto* name : {"vision", "spatial", "communication"})
    text = without_lines(text, std::string{"ACCESS "} + name, "");
  TestSystem system{text, playmate_options({{"say", question}})};
  system.expect_entry("SpatialScene in spatial");
  system.wait_until("two answers, that nothing is known", [&] {
    return all<communication::SpokenOutputItem>(system, "communication").size() == 2;
  });
  EXPECT_EQ(answers(system),
            (std::set<std::string>{"I do not see a ball.", "I do not see a triangle."}));
  system.expect_nobody_else_down();
}

} // namespace

} // namespace castor::test
