#include "castor/actors/cast/parser.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

/// Parses one of the whole systems beside this file.
ParseResult parse_system(const std::string& name) {
  ParseOptions options;
  options.working_directory = CASTOR_CAST_SYSTEMS;
  options.environment = [](const std::string& variable) -> std::optional<std::string> {
    return variable == "TEST_LOG_OUTPUT" ? std::optional<std::string>("true") : std::nullopt;
  };
  return parse_file(std::string(CASTOR_CAST_SYSTEMS) + "/" + name, options);
}

TEST(Systems, CountAcrossFiveSubarchitectures) {
  auto result = parse_system("count-across.cast");
  ASSERT_TRUE(test::is_clean(result));
  const auto& architecture = *result.architecture;
  ASSERT_EQ(architecture.subarchitectures.size(), 5U);
  std::size_t writers = 0;
  for (const auto& subarchitecture : architecture.subarchitectures)
    for (const auto& component : subarchitecture.components)
      writers += component.option("test")->value == "write-100" ? 1 : 0;
  EXPECT_EQ(writers, 10U);
  EXPECT_EQ(architecture.component("counter")->option("log")->value, "true");
  EXPECT_EQ(architecture.component("writer10")->option("exit")->value, "false");
  EXPECT_EQ(architecture.component("writer10")->number, 20U);
}

TEST(Systems, OverwriteAndReplaceAcrossSubarchitectures) {
  auto result = parse_system("overwrite-across.cast");
  ASSERT_TRUE(test::is_clean(result));
  EXPECT_EQ(result.architecture->component("generator")->option("subarch")->value, "test2");
  EXPECT_EQ(result.architecture->component("replacer")->subarchitecture, "test2");
}

TEST(Systems, LockAcrossSubarchitectures) {
  auto result = parse_system("lock-across.cast");
  ASSERT_TRUE(test::is_clean(result));
  EXPECT_EQ(result.architecture->component("overwriter-4")->subarchitecture, "test2");
  EXPECT_EQ(result.architecture->component("test1_wm")->option("log")->value, "true");
}

TEST(Systems, AreComposedOfIncludedParts) {
  auto result = parse_system("comedy.cast");
  ASSERT_TRUE(test::is_clean(result));
  const auto& architecture = *result.architecture;
  EXPECT_EQ(architecture.config_dir, ".");
  EXPECT_EQ(architecture.subarchitectures.size(), 2U);
  EXPECT_EQ(architecture.component("joker")->option("punchline")->value,
            "to get to the other side");
  EXPECT_EQ(architecture.component("joker")->option("material")->value, "parts/jokes.txt");
  EXPECT_EQ(architecture.component("listener")->kind, ComponentKind::unmanaged);
  EXPECT_EQ(architecture.component("listener")->where.include_chain().size(), 1U);
  EXPECT_EQ(architecture.component("stage_wm")->class_name, "SubarchitectureWorkingMemory");
}

TEST(Systems, MayHaveNamedAndStandaloneComponents) {
  auto result = parse_system("standalone.cast");
  ASSERT_TRUE(test::is_clean(result));
  ASSERT_EQ(result.architecture->standalone.size(), 3U);
  EXPECT_EQ(result.architecture->component("named.1")->class_name, "First@Examples");
  EXPECT_EQ(result.architecture->component("named.1")->option("log")->value, "true");
}

/// Each `#EXPAND a==b` line of the file states what its own left side comes to.
TEST(Systems, ExpandVariablesAsTheyStateThemselves) {
  auto result = parse_system("expansions.cast");
  EXPECT_EQ(test::count(result, Severity::error), 0U) << render(result.diagnostics);
  EXPECT_GT(result.expansions.size(), 30U);
  for (const auto& line : result.expansions) {
    auto text = line.substr(std::string("#EXPAND ").size());
    auto middle = text.find("==");
    ASSERT_NE(middle, std::string::npos) << line;
    EXPECT_EQ(text.substr(0, middle), text.substr(middle + 2)) << line;
  }
}

TEST(Systems, WithoutEnvironmentSayWhichVariableIsMissing) {
  auto options = test::options_for({});
  options.load = read_file;
  auto result = parse_file(std::string(CASTOR_CAST_SYSTEMS) + "/lock-across.cast", options);
  EXPECT_FALSE(result.ok());
  EXPECT_NE(render(result.diagnostics).find("'$TEST_LOG_OUTPUT' is not set"), std::string::npos);
}

} // namespace

} // namespace castor::cast
