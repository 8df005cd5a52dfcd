#include "castor/planning/symbolic/pddl_reader.hpp"

#include "castor/planning/symbolic/syntax_tree.hpp"
#include "castor/tests/planning/symbolic/domains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::planning {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::string problem_head = "(define (problem p) (:domain cups) ";

std::vector<Diagnostic> problems_of(const std::string& domain, const std::string& problem) {
  return parse_pddl("d.pddl", domain, "p.pddl", problem).problems;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

struct Mistake {
  std::string from;
  std::string to;
  std::string message;
  std::string remedy;
};

TEST(PddlReaderTest, ReadsTypesActionsAndCosts) {
  const auto read = parse_pddl("d", test::cups_domain, "p", test::cups_problem);
  ASSERT_TRUE(read.problems.empty()) << render(read.problems);
  const auto& task = read.task;
  EXPECT_EQ(task.domain, "cups");
  EXPECT_EQ(task.problem, "two-cups");
  EXPECT_TRUE(task.has_costs);
  ASSERT_THAT(task.actions, SizeIs(3));
  EXPECT_EQ(task.actions[0].parameters, 2U);
  EXPECT_THAT(task.initial, SizeIs(9));
  ASSERT_THAT(task.types, SizeIs(5));
  for (const auto& x : task.types) {
    const std::size_t count = x.name == "object" ? 5
                              : x.name == "room" ? 3
                              : x.name == "book" ? 0
                                                 : 2;
    EXPECT_THAT(x.objects, SizeIs(count)) << x.name;
  }
}

TEST(PddlReaderTest, SaysWhatIsWrongInDomains) {
  const std::vector<Mistake> mistakes{
    {"?t - thing ?r - room) (holding", "?t - thingy ?r - room) (holding",
     "there is no type 'thingy'", "did you mean 'thing'?"},
    {"(robot-at ?a) (door", "(robot-att ?a) (door", "there is no predicate 'robot-att'",
     "did you mean 'robot-at'?"},
    {"(door ?a ?b) (not", "(door ?a) (not", "'door' has 2 arguments, not 1", "write (door ?a ?b)"},
    {":action put", ":action take", "there are two actions 'take'", "rename one of the two"},
    {"(robot-at ?b) (not", "(robot-at ?c) (not", "the variable '?c' is not bound", "did you mean"},
    {"room thing - object", "room - object thing - cup",
     "type cycle: ", "remove one of these types"},
    {":negative-preconditions", ":numeric-fluents",
     "the requirement ':numeric-fluents' is not supported", "write the domain with these"},
    {":negative-preconditions", ":negative-precondition", "there is no requirement",
     "did you mean ':negative-preconditions'?"},
    {"(increase (total-cost) 1)))", "(increase (fuel) 1)))", "only the function (total-cost)",
     "predicates"},
    {"(busy)\n", "(busy) (busy)\n", "the predicate 'busy' is declared twice",
     "remove one of the two"},
    {":precondition (and (robot-at ?r) (at", ":condition (and (robot-at ?r) (at",
     "an action has no part ':condition'", "the parts of an action are"}};
  for (const auto& x : mistakes) {
    const auto problems =
      problems_of(replaced(test::cups_domain, x.from, x.to), test::cups_problem);
    ASSERT_FALSE(problems.empty()) << x.message;
    const auto text = render(problems);
    EXPECT_THAT(text, HasSubstr(x.message));
    EXPECT_THAT(text, HasSubstr(x.remedy));
    EXPECT_THAT(text, HasSubstr("d.pddl:"));
    EXPECT_TRUE(has_errors(problems));
  }
}

TEST(PddlReaderTest, SaysAllProblemsInTheOrderOfLines) {
  const auto problems =
    problems_of(test::cups_domain, problem_head + "(:objects hall - rooom)\n(:init (at cup hall)\n"
                                                  "(busy hall))\n(:goal (full)))");
  ASSERT_THAT(problems, SizeIs(4)) << render(problems);
  EXPECT_EQ(problems[0].where.line(), 1U);
  EXPECT_THAT(problems[0].remedy, HasSubstr("'room'"));
  EXPECT_EQ(problems[1].where.line(), 2U);
  EXPECT_THAT(problems[1].message, HasSubstr("there is no object 'cup'"));
  EXPECT_EQ(problems[1].column, 12U);
  EXPECT_EQ(problems[2].where.line(), 3U);
  EXPECT_EQ(problems[3].where.line(), 4U);
}

TEST(PddlReaderTest, FindsWhereAParenthesisIsMissing) {
  const auto problems =
    problems_of(replaced(test::cups_domain, "(not (busy)) (increase (total-cost) 1))))",
                         "(not (busy)) (increase (total-cost) 1))"),
                test::cups_problem);
  EXPECT_THAT(render(problems), HasSubstr("is not closed"));
  const auto earlier = problems_of(
    replaced(test::cups_domain, "(distance ?a ?b))))", "(distance ?a ?b))"), test::cups_problem);
  ASSERT_FALSE(earlier.empty());
  EXPECT_THAT(earlier.front().message, HasSubstr("before the section ':action'"));
}

TEST(PddlReaderTest, RefusesDeepAndLongTexts) {
  const std::string deep(100'000, '(');
  EXPECT_THAT(render(problems_of(deep, deep)), HasSubstr("nested more than"));
  const std::string large(most_pddl_bytes + 1, ' ');
  EXPECT_THAT(render(problems_of(large, large)), HasSubstr("longer than 32 MiB"));
}

TEST(PddlReaderTest, RefusesDerivedPredicatesThatNegateThemselves) {
  const auto problems = problems_of(
    "(define (domain d) (:predicates (a) (b)) (:derived (a) (not (b))) (:derived (b) (a)))",
    "(define (problem p) (:domain d) (:init) (:goal (a)))");
  EXPECT_THAT(render(problems), HasSubstr("depends on its own negation"));
}

TEST(PddlReaderTest, SaysWhichFilesCannotBeRead) {
  const auto read = read_pddl("/no/such/domain.pddl", "/no/such/problem.pddl");
  ASSERT_THAT(read.problems, SizeIs(2));
  EXPECT_THAT(render(read.problems), HasSubstr("/no/such/problem.pddl"));
}

} // namespace
} // namespace castor::planning
