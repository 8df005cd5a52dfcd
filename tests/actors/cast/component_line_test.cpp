#include "castor/actors/cast/component_line.hpp"

#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::cast {

namespace {

using test::parse;
using test::reports;
using test::system_with;

testing::AssertionResult fails(const std::string& line, std::string_view message,
                               std::string_view remedy) {
  return reports(parse(system_with(line)), Severity::error, 5, message, remedy);
}

TEST(ComponentLine, MayBeginWithAHost) {
  auto result = parse(system_with("robot2 CPP MG a A"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("a")->host, "robot2");
}

TEST(ComponentLine, TakesAnyClassName) {
  auto result = parse(system_with("CPP MG a Name@Library\nCPP UM b ns::Class"));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.architecture->component("a")->class_name, "Name@Library");
  EXPECT_EQ(result.architecture->component("b")->class_name, "ns::Class");
}

TEST(ComponentLine, NeedsALanguage) {
  EXPECT_TRUE(fails("C++ MG a A", "'C++' is not a language", "write CPP"));
  EXPECT_TRUE(fails("cpp MG a A", "'cpp' is not a language", "write CPP"));
  EXPECT_TRUE(fails("robot2 C++ MG a A", "'C++' is not a language", "write CPP"));
  EXPECT_TRUE(fails("Java MG a A", "'Java' is not a language", "write JAVA"));
  EXPECT_TRUE(fails("MG a A", "the language is missing", "CPP MG a A"));
  EXPECT_TRUE(fails("robot2 robot3 MG a A", "'robot3' is not a language, nor is 'robot2'",
                    "write CPP MG name Class"));
  EXPECT_TRUE(fails("lonely", "the line is incomplete", "write CPP MG name Class"));
}

TEST(ComponentLine, NeedsAKind) {
  EXPECT_TRUE(fails("CPP", "kind of component is missing", "write CPP MG name Class"));
  EXPECT_TRUE(fails("CPP # MG a A", "kind of component is missing", ""));
  EXPECT_TRUE(fails("CPP XX a A", "'XX' is not a kind", "write WM, TM, MG"));
  EXPECT_TRUE(fails("CPP mg a A", "'mg' is not a kind", "write MG"));
}

TEST(ComponentLine, NeedsANameAndAClass) {
  EXPECT_TRUE(fails("CPP MG", "name and class are missing", "write CPP MG name Class"));
  EXPECT_TRUE(fails("CPP MG # a", "name and class are missing", ""));
  EXPECT_TRUE(fails("CPP MG --log", "name and class are missing", ""));
  EXPECT_TRUE(fails("CPP MG a", "class is missing", "write CPP MG a Class"));
  EXPECT_TRUE(fails("CPP UM a --log", "class is missing", "write CPP UM a Class"));
  EXPECT_TRUE(fails("CPP WM", "class is missing", "write CPP WM SubarchitectureWorkingMemory"));
  EXPECT_TRUE(fails("CPP TM # x", "class is missing", "write CPP TM AlwaysPositiveTaskManager"));
  EXPECT_TRUE(fails("COMPONENT", "the line is incomplete", "write COMPONENT CPP name Class"));
  EXPECT_TRUE(fails("COMPONENT CPP", "name and class are missing", "write COMPONENT CPP"));
  EXPECT_TRUE(fails("COMPONENT CPP a", "class is missing", "write COMPONENT CPP a Class"));
  EXPECT_TRUE(fails("COMPONENT C++ a A", "'C++' is not a language", "write CPP"));
}

TEST(ComponentLine, RefusesAnEmptyHost) {
  auto result = parse(system_with("$E CPP MG a A"), {{}, {{"E", ""}}});
  EXPECT_TRUE(reports(result, Severity::error, 5, "the host is empty"));
}

TEST(ComponentLine, TakesTheStandardJavaClassesForTheirNamesakes) {
  auto result = parse("HOST localhost\nSUBARCHITECTURE s\n"
                      "JAVA WM cast.architecture.SubarchitectureWorkingMemory --log\n"
                      "JAVA TM cast.architecture.AlwaysPositiveTaskManager\n");
  ASSERT_TRUE(test::is_clean(result));
  const auto& s = result.architecture->subarchitectures.at(0);
  EXPECT_EQ(s.working_memory.class_name, "SubarchitectureWorkingMemory");
  EXPECT_EQ(s.working_memory.language, Language::cpp);
  EXPECT_EQ(s.working_memory.option("log")->value, "true");
  EXPECT_EQ(s.task_manager.class_name, "AlwaysPositiveTaskManager");
  EXPECT_EQ(s.task_manager.language, Language::cpp);
}

TEST(ComponentLine, RefusesOtherLanguages) {
  EXPECT_TRUE(fails("JAVA MG a pack.Vision --x 1",
                    "Java component 'pack.Vision': this runtime has "
                    "C++ components only",
                    "write CPP MG a Vision"));
  EXPECT_TRUE(fails("PYTHON UM a pack.mod", "Python component 'pack.mod'", "write CPP UM a mod"));
  EXPECT_TRUE(fails("COMPONENT JAVA a B", "Java component 'B'", "write COMPONENT CPP a B"));
  EXPECT_TRUE(fails("JAVA WM pack.OwnMemory", "Java component", "write CPP WM Subarchitecture"));
  EXPECT_TRUE(fails("JAVA TM cast.architecture.SubarchitectureWorkingMemory", "Java component",
                    "write CPP TM AlwaysPositiveTaskManager"));
  EXPECT_TRUE(fails("JAVA MG a cast.architecture.SubarchitectureWorkingMemory", "Java", ""));
  EXPECT_TRUE(fails("PYTHON WM cast.architecture.SubarchitectureWorkingMemory", "Python", ""));
}

} // namespace

} // namespace castor::cast
