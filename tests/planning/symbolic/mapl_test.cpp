#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace castor::planning::mapl {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Outcome = PlanningResult::Outcome;

std::string domain_named(const std::string& name) {
  std::ostringstream out;
  out << std::ifstream(CASTOR_DOMAINS "/" + name + ".pddl").rdbuf();
  return out.str();
}

/// A house of three rooms; the robot is in the hall, and Ann in the study.
std::string explorer_problem(const std::string& facts, const std::string& goal) {
  return "(define (problem p) (:domain explorer) (:agent robby)\n"
         "(:objects robby - robot ann - human hall study kitchen - room book - thing lab - "
         "area-name)\n"
         "(:init (= (is-in robby) hall) (= (is-in ann) study)\n"
         "(connected hall study) (connected study hall) (connected hall kitchen) (connected "
         "kitchen hall)\n" +
         facts + ")\n(:goal " + goal + "))";
}

PlanningResult planned(const std::string& domain, const std::string& problem) {
  const auto read = parse_pddl("d.pddl", domain, "p.pddl", problem);
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  if (has_errors(read.problems))
    return {};
  return find_plan(read.task, {});
}

std::vector<std::string> actions_of(const PlanningResult& result) {
  std::vector<std::string> actions;
  for (const auto& x : result.steps)
    actions.push_back(x.action);
  return actions;
}

std::vector<std::string> explored(const std::string& facts, const std::string& goal) {
  return actions_of(planned(domain_named("explorer"), explorer_problem(facts, goal)));
}

TEST(Mapl, PromisesWhatItCannotPlanYet) {
  EXPECT_THAT(explored("(K ann (asserted-position book))", "(K robby (perceived-position book))"),
              ElementsAre("move robby study hall", "ask-val-asserted-position robby ann book study",
                          "object-search-in-room_a robby book"));
}

TEST(Mapl, PlansWithoutPromisesOnceTheirConditionIsKnown) {
  EXPECT_THAT(
    explored("(= (asserted-position book) kitchen)", "(K robby (perceived-position book))"),
    ElementsAre("move robby kitchen hall", "object-search-in-room robby book kitchen"));
}

TEST(Mapl, PromisesToTellWhatItWillSee) {
  const auto plan =
    explored("(= (asserted-position book) kitchen)", "(K ann (perceived-position book))");
  EXPECT_THAT(plan,
              ElementsAre("move robby kitchen hall", "object-search-in-room robby book kitchen",
                          "inform_a robby ann book"));
  EXPECT_THAT(
    explored("(= (perceived-position book) kitchen)", "(K ann (perceived-position book))"),
    ElementsAre("move robby study hall", "inform robby ann book study kitchen"));
}

TEST(Mapl, AsksForAnyStateVariable) {
  EXPECT_THAT(explored("(K ann (area-of lab))", "(has-reached robby lab)"),
              ElementsAre("move robby study hall", "ask-val-area-of robby ann lab study",
                          "move-to-area_a robby lab"));
}

TEST(Mapl, KnowsNothingThatNobodyKnows) {
  const auto result =
    planned(domain_named("explorer"), explorer_problem("", "(K robby (perceived-position book))"));
  EXPECT_EQ(result.outcome, Outcome::unsolvable);
}

TEST(Mapl, DoesNotSearchWhereItIsImpossible) {
  const std::string goal = "(K robby (perceived-position book))";
  const std::string said = "(= (asserted-position book) kitchen)";
  const auto outcome = [&](const std::string& facts) {
    return planned(domain_named("explorer"), explorer_problem(facts, goal)).outcome;
  };
  EXPECT_EQ(outcome(said + "(not (in-domain (perceived-position book) kitchen))"),
            Outcome::unsolvable);
  EXPECT_EQ(outcome(said + "(in-domain (perceived-position book) hall)"), Outcome::unsolvable);
  EXPECT_EQ(outcome(said + "(in-domain (perceived-position book) kitchen)"), Outcome::plan);
}

TEST(Mapl, KnowsWhatSensorsAndAssertionsAre) {
  const auto read =
    parse_pddl("d", domain_named("explorer"), "p", explorer_problem("", "(= (is-in robby) hall)"));
  ASSERT_FALSE(has_errors(read.problems)) << render(read.problems);
  std::vector<std::string> sensors;
  std::vector<std::string> assertions;
  for (const auto& x : read.task.actions)
    if (x.kind == ActionKind::sensor)
      sensors.push_back(x.name);
    else if (x.kind == ActionKind::assertion)
      assertions.push_back(x.name);
  EXPECT_THAT(sensors, ElementsAre("object-search-in-room"));
  EXPECT_THAT(assertions, ElementsAre("move-to-area_a", "object-search-in-room_a", "inform_a"));
}

std::string small_domain(const std::string& actions) {
  return "(define (domain small)\n"
         "(:requirements :mapl :typing :negative-preconditions)\n"
         "(:types agent place thing - object)\n"
         "(:state-variables (pos ?t - thing) - place)\n"
         "(:constants a b c - place)\n"
         "(:predicates (done))\n" +
         actions + ")";
}

std::string small_problem(const std::string& facts, const std::string& goal) {
  return "(define (problem p) (:domain small) (:agent me)\n"
         "(:objects me you - agent cup - thing)\n(:init " +
         facts + ")\n(:goal " + goal + "))";
}

const std::string put = "(:action put :agent (?a - agent) :parameters (?t - thing ?p - place)\n"
                        ":effect (pos ?t : ?p))\n";

TEST(Mapl, TakesAValueThatIsNotKnownForNeitherEqualNorDifferent) {
  const auto domain = small_domain("(:action leave :agent (?a - agent) :parameters (?t - thing)\n"
                                   ":precondition (not (= (pos ?t) a)) :effect (done))");
  EXPECT_EQ(planned(domain, small_problem("", "(done)")).outcome, Outcome::unsolvable);
  EXPECT_EQ(planned(domain, small_problem("(= (pos cup) a)", "(done)")).outcome,
            Outcome::unsolvable);
  EXPECT_EQ(planned(domain, small_problem("(pos cup : b)", "(done)")).outcome, Outcome::plan);
  EXPECT_EQ(planned(domain, small_problem("(= (pos cup) b)", "(not (= (pos cup) a))")).outcome,
            Outcome::plan);
}

TEST(Mapl, GivesAVariableOneValue) {
  const auto domain = small_domain(put);
  EXPECT_THAT(actions_of(planned(domain, small_problem("(= (pos cup) a)",
                                                       "(and (= (pos cup) b) (K me (pos cup)))"))),
              ElementsAre("put me cup b"));
  EXPECT_EQ(
    planned(domain, small_problem("(= (pos cup) a)", "(and (= (pos cup) b) (= (pos cup) c))"))
      .outcome,
    Outcome::unsolvable);
}

TEST(Mapl, MakesOthersUncertainOfWhatChanges) {
  const auto domain = small_domain(put);
  const auto goal = "(and (= (pos cup) b) (K you (pos cup)))";
  // You know it again only if you have put it there.
  EXPECT_THAT(actions_of(planned(domain, small_problem("(= (pos cup) a) (K you (pos cup))", goal))),
              ElementsAre("put you cup b"));
}

TEST(Mapl, PutsThingsLeftOfOthers) {
  const auto plan =
    actions_of(planned(domain_named("playmate"),
                       "(define (problem p) (:domain playmate) (:agent arm)\n"
                       "(:objects arm - agent ball box - thing w0 w1 w2 - waypoint)\n"
                       "(:init (= (pos ball) w0) (= (pos box) w1)) (:goal (left-of ball box)))"));
  EXPECT_THAT(plan, ElementsAre("reposition-left arm w2 box", "move arm ball w2"));
}

struct Mistake {
  std::string from;
  std::string to;
  std::string message;
  std::string remedy;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(Mapl, SaysWhatIsWrongInDomains) {
  const auto domain = domain_named("explorer");
  const std::vector<Mistake> mistakes{
    {":mapl ", "", "the section ':state-variables' belongs to MAPL", "add :mapl"},
    {"agent room area-name thing - object\n          robot human - agent",
     "room area-name thing robot human - object", "needs the type 'agent'",
     "declare it in (:types agent"},
    {"(= (is-in ?r) ?from) (connected", "(= (is-inn ?r) ?from) (connected", "there is no", "is-in"},
    {"(K ?r (area-of ?n))", "(K ?r (area-off ?n))", "there is no state variable 'area-off'",
     "did you mean 'area-of'?"},
    {"(K ?r (area-of ?n))", "(K ?r (area-of ?n ?n))", "has 1 arguments, not 2",
     "write (area-of ?n)"},
    {"(K ?r (area-of ?n))", "(K ?r)", "'K' has 2 parts, not 1", "write (K AGENT"},
    {"(= (is-in ?r) ?from) (connected", "(is-in ?r ?from) (connected",
     "the value of the state variable 'is-in' is missing", "write (= (is-in ?a) VALUE)"},
    {"?h - human ??var)", "?h - human ??var - object)", "something follows '??var'",
     "at the end of :parameters"},
    {"(assign (is-in ?r) ?to)", "(not (= (is-in ?r) ?to))",
     "an effect cannot say which value a state variable has not", "assign another value"},
    {"(asserted-position ?t - thing) - room", "(asserted-position ?t - thing) room",
     "stands among state variables", "- TYPE"},
    {"(is-in ?a - agent) - room", "(is-in ?a - agent) - room (is-in ?a - agent) - room",
     "the state variable 'is-in' is declared twice", "remove one"},
    {":sense (= (perceived-position ?t) ?in)", ":effect (has-reached ?r ?t)",
     "a sensor needs an agent, and what it senses", ":sense"}};
  for (const auto& x : mistakes) {
    const auto read = parse_pddl("d.pddl", replaced(domain, x.from, x.to), "p.pddl",
                                 explorer_problem("", "(= (is-in robby) hall)"));
    const auto text = render(read.problems);
    EXPECT_TRUE(has_errors(read.problems)) << x.message;
    EXPECT_THAT(text, HasSubstr(x.message));
    EXPECT_THAT(text, HasSubstr(x.remedy));
    EXPECT_THAT(text, HasSubstr("d.pddl:"));
  }
}

TEST(Mapl, SaysWhatIsWrongInProblems) {
  const auto problems_of = [](const std::string& problem) {
    return parse_pddl("d.pddl", small_domain(put), "p.pddl", problem).problems;
  };
  const auto twice = problems_of(small_problem("(= (pos cup) a)\n(= (pos cup) b)", "(done)"));
  ASSERT_FALSE(twice.empty());
  EXPECT_EQ(twice.front().where.line(), 4U);
  EXPECT_THAT(twice.front().message, HasSubstr("(pos cup) has two values, 'a' and 'b'"));
  EXPECT_THAT(render(problems_of(replaced(small_problem("", "(done)"), "(:agent me)", ""))),
              HasSubstr("which agent plans"));
  EXPECT_THAT(render(problems_of(small_problem("(= (pos cup) hall)", "(done)"))),
              HasSubstr("there is no object 'hall'"));
  const auto derived = parse_pddl(
    "d.pddl",
    small_domain("(:derived (done) (= (pos cup) a)) (:action x_A :agent (?a - agent) :replan "
                 "(done) :effect (K ?a (pos cup)))"),
    "p.pddl", small_problem("", "(done)"));
  EXPECT_THAT(render(derived.problems), HasSubstr("uses a derived predicate"));
}

} // namespace
} // namespace castor::planning::mapl
