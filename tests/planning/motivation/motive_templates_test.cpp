#include "castor/planning/motivation/motive_templates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace castor::planning {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string find_motive = "# What people may ask for.\n"
                                "motive find\n"
                                "  on        Find\n"
                                "  goal      (K robby (perceived-position {patient}))  # seen\n"
                                "  words     find {patient}\n"
                                "  because   {speaker} said '{text}'\n"
                                "  about     {patient}\n"
                                "  priority  3\n"
                                "  cost      2.5\n"
                                "  resources base camera\n"
                                "  patience  10min\n";

TEST(MotiveTemplates, AreReadFromAFile) {
  const auto read =
    parse_motives("m", find_motive + "motive explore\n  when idle 30s\n"
                                     "  when (is-dark ?room)\n  goal (seen {room})\n"
                                     "  words look around\n");
  ASSERT_THAT(read.problems, IsEmpty()) << render(read.problems);
  ASSERT_EQ(read.templates.size(), 2U);
  const auto& find = read.templates[0];
  EXPECT_EQ(find.name, "find");
  EXPECT_EQ(find.on, "Find");
  EXPECT_EQ(find.goal, "(K robby (perceived-position {patient}))");
  EXPECT_EQ(find.priority, 3);
  EXPECT_EQ(find.cost, 2.5);
  EXPECT_EQ(find.patience, 10min);
  EXPECT_THAT(find.resources, ElementsAre("base", "camera"));
  EXPECT_THAT(find.names(), ElementsAre("patient", "speaker", "text"));
  EXPECT_EQ(read.templates[1].idle, 30s);
  EXPECT_THAT(read.templates[1].when, ElementsAre("(is-dark ?room)"));
}

TEST(MotiveTemplates, AreFilledWithValues) {
  const auto read = parse_motives("m", find_motive);
  const auto motive = make_motive(
    read.templates.at(0), {{"patient", "book"}, {"speaker", "ann"}, {"text", "find the book"}});
  ASSERT_TRUE(motive);
  EXPECT_EQ(motive->kind, "find");
  EXPECT_EQ(motive->goal.goal, "(K robby (perceived-position book))");
  EXPECT_EQ(motive->words, "find book");
  EXPECT_EQ(motive->because, "ann said 'find the book'");
  EXPECT_EQ(motive->about, "book");
  EXPECT_EQ(motive->patience, 600);
  EXPECT_FALSE(make_motive(read.templates.at(0), {{"patient", "book"}}));
}

TEST(MotiveTemplates, SayWhatIsWrong) {
  struct Mistake {
    std::string text;
    std::string message;
    std::string remedy;
    std::size_t line;
  };
  const std::string good = "motive m\n  when (a ?x)\n  goal (b {x})\n  words do it\n";
  ASSERT_THAT(parse_motives("m", good).problems, IsEmpty());
  const std::vector<Mistake> mistakes{
    {"  goal (b)\n", "'goal' belongs to no motive", "begin with: motive NAME", 1},
    {"motiv m\n", "no motive begins here", "write: motive NAME", 1},
    {"motive\n", "no motive begins here", "write: motive NAME", 1},
    {good + "  prioriti 3\n", "a motive has no part 'prioriti'", "did you mean 'priority'?", 5},
    {good + "  priority high\n", "'high' is no number", "write a number", 5},
    {good + "  patience 3\n", "'3' is no duration", "30s, 10min", 5},
    {good + "  goal (c)\n", "two parts 'goal'", "remove one", 5},
    {good + "  about\n", "nothing stands after 'about'", "write a value", 5},
    {good + "  when soon\n", "neither a fact nor idleness", "when idle 30s", 5},
    {good + "  when (a (b ?x)\n", "parentheses of the fact", "(PREDICATE OBJECT ...)", 5},
    {good + good, "there are two motives 'm'", "rename", 5},
    {good + "  about {y}\n", "uses {y}, which is in none of its facts", "write ?y", 1},
    {"motive m\n  on Find\n  goal (a {it})\n  words do it\n", "{it}, which no request has",
     "patient", 1},
    {"motive m\n  when (a)\n  words do it\n", "has no goal", "add: goal", 1},
    {"motive m\n  goal (a)\n  words do it\n", "nothing occasions the motive", "add: when", 1}};
  for (const auto& x : mistakes) {
    const auto problems = parse_motives("m.motives", x.text).problems;
    ASSERT_FALSE(problems.empty()) << x.text;
    EXPECT_THAT(problems.front().message, HasSubstr(x.message));
    EXPECT_THAT(problems.front().remedy, HasSubstr(x.remedy));
    EXPECT_EQ(problems.front().where.line(), x.line) << x.message;
  }
}

TEST(MotiveFacts, MatchPatterns) {
  const std::vector<std::string> facts{"(on cup table)", "(on ball table)",
                                       "(= (is-in robby) hall)", "(wants ann cup)"};
  EXPECT_EQ(matches({"(on ?x table)"}, facts),
            (std::vector<MotiveValues>{{{"x", "ball"}}, {{"x", "cup"}}}));
  EXPECT_EQ(matches({"(on ?x table)", "(wants ?who ?x)"}, facts),
            (std::vector<MotiveValues>{{{"who", "ann"}, {"x", "cup"}}}));
  EXPECT_EQ(matches({"(= (is-in ?r) ?p)"}, facts),
            (std::vector<MotiveValues>{{{"p", "hall"}, {"r", "robby"}}}));
  EXPECT_THAT(matches({"(on ?x ?x)"}, facts), IsEmpty());
  EXPECT_THAT(matches({"(= ?x hall)"}, facts), IsEmpty()) << "a variable is one object";
  EXPECT_EQ(matches({}, facts).size(), 1U);
}

} // namespace
} // namespace castor::planning
