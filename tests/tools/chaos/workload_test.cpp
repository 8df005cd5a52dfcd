#include "castor/tools/chaos/workload.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/tools/chaos/workload_parser.hpp"
#include "castor/tools/chaos/workload_places.hpp"
#include "castor/tools/chaos/workload_schedule.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* whole_language =
  "# what somebody does\n"
  "at 2s say \"Hello.\"   # a greeting\n"
  "every 4s say \"Where is the ball?\" or \"How   many red things are there?\"\n"
  "every 10s move red sphere to 0.1 -.2 or add blue cube at 5cm 0 size 0.07 turned 12 or "
  "remove mug\n"
  "rate 2/s write Note {\"text\": \"a } b\", \"list\": [1, {}]} to memory or say \"or\"\n"
  "every 1s write Note {\"text\":\"\\\"\"} to memory/note one\n"
  "expect answer within 10s\n"
  "expect rest within 5min\n"
  "expect growth within 120MB\n"
  "same SceneObject, ROI but for time, object_id\n"
  "never overwritten Oven in kitchen where state == \"on # fire\"  # of the cook\n"
  "never Alarm\n"
  "each added Order becomes Order where state == \"it becomes # within 1s\" within 90s # served\n";

Workload workload_of(const std::string& text) {
  auto result = parse_workload(text, "test.workload");
  EXPECT_EQ(render(result.diagnostics), "");
  return result.workload.value_or(Workload{});
}

std::string flaws_of(const std::string& text) {
  auto result = parse_workload(text, "test.workload");
  EXPECT_FALSE(result.ok()) << text;
  return render(result.diagnostics);
}

Workload whole_workload() {
  std::string text = whole_language;
  return workload_of(text.replace(text.find("memory/note one"), 15, "\"memory/note one\""));
}

TEST(Workload, HasASeedOfItsOwnOrThatOfTheFaults) {
  EXPECT_EQ(whole_workload().seed, std::nullopt);
  auto x = workload_of("seed 7\nevery 1s say \"Hello.\"\n");
  EXPECT_EQ(x.seed, 7U);
  EXPECT_EQ(workload_of(to_string(x)), x);
  EXPECT_THAT(flaws_of("seed 7\nseed 8\n"), HasSubstr("this is given twice"));
  EXPECT_THAT(flaws_of("seed x\n"), HasSubstr("the seed is not one whole number"));
}

TEST(Workload, SaysWhatIsDoneAndWhen) {
  auto x = whole_workload();
  ASSERT_EQ(x.statements.size(), 5U);
  EXPECT_EQ(x.statements[0].trigger, Trigger{At{2s}});
  EXPECT_EQ(x.statements[0].where.line(), 2U);
  EXPECT_THAT(x.statements[0].actions, ElementsAre(Action{Say{"Hello."}}));
  EXPECT_EQ(x.statements[1].trigger, Trigger{Every{4s}});
  EXPECT_THAT(x.statements[1].actions, ElementsAre(Action{Say{"Where is the ball?"}},
                                                   Action{Say{"How many red things are there?"}}));
  EXPECT_THAT(x.statements[2].actions,
              ElementsAre(Action{MoveThing{"red sphere", "0.1", "-.2"}},
                          Action{AddThing{"blue cube", "5cm 0 size 0.07 turned 12"}},
                          Action{RemoveThing{"mug"}}));
  EXPECT_EQ(x.statements[3].trigger, Trigger{AtRandom{{2000}}});
  EXPECT_THAT(
    x.statements[3].actions,
    ElementsAre(Action{WriteEntry{"Note", R"({"text":"a } b","list":[1,{}]})", "memory", {}}},
                Action{Say{"or"}}));
  EXPECT_THAT(x.statements[4].actions,
              ElementsAre(Action{WriteEntry{"Note", R"({"text":"\""})", "memory", "note one"}}));
  EXPECT_EQ(x.answer_within, 10s);
  EXPECT_EQ(x.rest_within, 5min);
  EXPECT_EQ(x.growth_within, 120'000'000U);
  ASSERT_TRUE(x.same);
  EXPECT_THAT(x.same->types, ElementsAre("SceneObject", "ROI"));
  EXPECT_THAT(x.same->but_for, ElementsAre("time", "object_id"));
  ASSERT_EQ(x.never.size(), 2U);
  EXPECT_EQ(x.never[0].filter,
            parse_change_filter("overwritten Oven in kitchen where state == \"on # fire\""));
  EXPECT_EQ(x.never[1].filter, parse_change_filter("Alarm"));
  ASSERT_EQ(x.each.size(), 1U);
  EXPECT_EQ(x.each[0].begin, parse_change_filter("added Order"));
  EXPECT_EQ(x.each[0].end, parse_change_filter("Order where state == \"it becomes # within 1s\""));
  EXPECT_EQ(x.each[0].within, 90s);
}

TEST(Workload, IsPrintedAsItIsRead) {
  auto x = whole_workload();
  EXPECT_EQ(workload_of(to_string(x)), x);
  EXPECT_THAT(to_string(x), HasSubstr("every 4s say \"Where is the ball?\" or say \"How many red "
                                      "things are there?\"\n"));
  EXPECT_EQ(workload_of("at 1s move \"#ff8000  box\" to 0 0"),
            workload_of("at 1s move \"#ff8000 box\" to 0 0"));
}

TEST(Workload, WhatIsNoStatementIsRefusedWithItsPlaceAndARemedy) {
  EXPECT_THAT(flaws_of("\nafter added A: say \"Hello.\"\n"),
              AllOf(HasSubstr("test.workload:2: error:"),
                    HasSubstr("'after' is not the beginning of a statement"),
                    HasSubstr("write at TIME, every TIME or rate NUMBER/s")));
  EXPECT_THAT(flaws_of("evry 1s say \"a\""), HasSubstr("did you mean 'every'?"));
  EXPECT_THAT(flaws_of("every 1s"), HasSubstr("the action is missing"));
  EXPECT_THAT(flaws_of("every 1s sing \"a\""), HasSubstr("'sing' is not an action"));
  EXPECT_THAT(flaws_of("every 1s say Hello"), HasSubstr("does not stand in quotes"));
  EXPECT_THAT(flaws_of("every 1s say \" \""), HasSubstr("the sentence is empty"));
  EXPECT_THAT(flaws_of("every 1s say \"a"), HasSubstr("a quote has no end"));
  EXPECT_THAT(flaws_of("every 1s say \"a\" twice"),
              HasSubstr("do not know what to do with 'twice'"));
  EXPECT_THAT(flaws_of("every 1s say \"a\" or"), HasSubstr("the action is missing"));
  EXPECT_THAT(flaws_of("at 1s write Note {\"a\": } to m"), HasSubstr("is no JSON"));
  EXPECT_THAT(flaws_of("at 1s write Note [1] to m"), HasSubstr("is not the value of an entry"));
  EXPECT_THAT(flaws_of("at 1s write Note {} in m"),
              HasSubstr("there is 'in' where 'to' has to stand"));
  EXPECT_THAT(flaws_of("at 1s write Note {} to m/"), HasSubstr("neither a subarchitecture nor"));
  EXPECT_THAT(flaws_of("at 1s write Note " + std::string(65, '[') + " to m"),
              HasSubstr("more than 64"));
  EXPECT_THAT(flaws_of("at 1s move red ball 0 0"), HasSubstr("'to' is missing at the end"));
  EXPECT_THAT(flaws_of("at 1s move red ball to 0 1e3"), HasSubstr("'1e3' is not a length"));
  EXPECT_THAT(flaws_of("at 1s move red ball to 0 0 over 1s"), HasSubstr("is moved instantly"));
  EXPECT_THAT(flaws_of("at 1s add red ball"), HasSubstr("'at' is missing"));
  EXPECT_THAT(flaws_of("at 1s remove"), HasSubstr("which thing is missing"));
  EXPECT_THAT(flaws_of("expect answer within 0s"), HasSubstr("not a time above zero"));
  EXPECT_THAT(flaws_of("expect rest within"), HasSubstr("how soon that is expected is missing"));
  for (auto* size : {"0MB", "-1MB", "12", "12GB", "1e3MB", "1234567MB", "\"12MB\""})
    EXPECT_THAT(flaws_of("expect growth within " + std::string{size}),
                HasSubstr("no size above zero"))
      << size;
  EXPECT_THAT(flaws_of("expect growth within"), HasSubstr("how much more memory"));
  EXPECT_THAT(flaws_of("expect growth within 1MB\nexpect growth within 2MB"),
              HasSubstr("given twice"));
  EXPECT_THAT(flaws_of("expect joy within 1s"), HasSubstr("expect rest within 10min"));
  EXPECT_THAT(flaws_of("expect rest within 1s\nexpect rest within 2s"),
              AllOf(HasSubstr("test.workload:2"), HasSubstr("given twice")));
  EXPECT_THAT(flaws_of("expect answer within 1s\nexpect answer within 2s"),
              AllOf(HasSubstr("test.workload:2"), HasSubstr("given twice")));
  EXPECT_THAT(flaws_of("never  # anything"), HasSubstr("the change filter is missing"));
  EXPECT_THAT(flaws_of("never Oven where level >"), HasSubstr("test.workload:1: error:"));
  EXPECT_THAT(flaws_of("each Order becomes Meal"),
              AllOf(HasSubstr("what each entry is to become, and how soon"),
                    HasSubstr("write each FILTER becomes FILTER within TIME")));
  EXPECT_THAT(flaws_of("each Order becomes within 3s"), HasSubstr("error:"));
  EXPECT_THAT(flaws_of("each  becomes Meal within 3s"), HasSubstr("the change filter is missing"));
  EXPECT_THAT(flaws_of("each Order becomes Meal within 0s"),
              HasSubstr("'0s' is not a time above zero"));
  EXPECT_THAT(flaws_of("same A for b"), HasSubstr("do not know what to do with 'for'"));
}

// -- against a system

WorkloadPlaces places_in(const std::string& text) {
  auto result = cast::parse_string(text, "test.cast");
  EXPECT_EQ(render(result.diagnostics), "");
  return places_of(result.architecture.value());
}

constexpr const char* talking_system =
  "HOST localhost\n"
  "COMPONENT CPP camera Camera --source scene:scenes/a.scene --base configs\n"
  "SUBARCHITECTURE talk\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n"
  "CPP UM parser UtteranceParser\n"
  "SUBARCHITECTURE closed\nCPP WM SubarchitectureWorkingMemory\n"
  "CPP TM AlwaysPositiveTaskManager\nCPP UM b B\n"
  "ACCESS operator WRITES talk\n";

std::string misfits_of(const std::string& workload, const std::string& system = talking_system) {
  auto places = places_in(system);
  std::optional<SceneText> scene;
  if (!places.cameras.empty())
    scene.emplace("red sphere at 0 0\n");
  return render(check_workload(
    workload_of(workload), places, scene,
    [](const WriteEntry& x) { return x.type == "Note" ? "" : "there is no type " + x.type; },
    [](const std::string& type) { return type == "Note"; }));
}

TEST(Workload, OneThatFitsTheSystemHasNoFlaws) {
  auto places = places_in(talking_system);
  EXPECT_EQ(places.listening, "talk");
  ASSERT_EQ(places.cameras.size(), 1U);
  EXPECT_EQ(places.cameras[0].component, "camera");
  EXPECT_EQ(places.cameras[0].file, "scenes/a.scene");
  EXPECT_EQ(places.cameras[0].base, "configs");
  EXPECT_EQ(misfits_of("at 1s say \"a\" or write Note {} to talk or move Red Sphere to 0 1 or "
                       "add mug at 0 0\n"
                       "at 2s remove mug\nexpect answer within 1s\nsame Note\n"),
            "");
}

TEST(Workload, WhatTheSystemDoesNotHaveIsFound) {
  EXPECT_THAT(misfits_of("\nat 1s write Note {} to tlak"),
              AllOf(HasSubstr("test.workload:2: error: there is no subarchitecture 'tlak'"),
                    HasSubstr("did you mean 'talk'?")));
  EXPECT_THAT(misfits_of("at 1s write Note {} to closed"),
              AllOf(HasSubstr("operators may not write to 'closed'"),
                    HasSubstr("ACCESS operator WRITES closed")));
  EXPECT_THAT(misfits_of("at 1s write Nota {} to talk"), HasSubstr("there is no type Nota"));
  EXPECT_THAT(misfits_of("at 1s move red sphre to 0 0"), HasSubstr("did you mean 'red sphere'?"));
  EXPECT_THAT(misfits_of("expect answer within 1s"), HasSubstr("no sentence is said"));
  EXPECT_THAT(misfits_of("\nsame Nota"),
              AllOf(HasSubstr("test.workload:2"), HasSubstr("no entry type 'Nota'")));
  EXPECT_THAT(misfits_of("\nnever Nota where a > 1"),
              AllOf(HasSubstr("test.workload:2"), HasSubstr("no entry type 'Nota'")));
  EXPECT_THAT(misfits_of("each Note becomes Nota within 1s"), HasSubstr("no entry type 'Nota'"));
  EXPECT_THAT(misfits_of("never Note in tlak"),
              AllOf(HasSubstr("no subarchitecture 'tlak'"), HasSubstr("did you mean 'talk'?")));
  constexpr const char* silent = "HOST localhost\nSUBARCHITECTURE a\n"
                                 "CPP WM SubarchitectureWorkingMemory\n"
                                 "CPP TM AlwaysPositiveTaskManager\nCPP UM b B\n";
  EXPECT_THAT(misfits_of("at 1s say \"a\"", silent),
              HasSubstr("no subarchitecture has an UtteranceParser"));
  EXPECT_THAT(misfits_of("at 1s add mug at 0 0", silent), HasSubstr("no camera sees a scene"));
}

// -- over time

TEST(Workload, TheSameSeedMakesTheSameActions) {
  auto x = workload_of("every 1s say \"a\" or \"b\" or \"c\"\nrate 1/s move m to 0 0\n"
                       "at 1s say \"last\"\nat 60s say \"late\"\n");
  auto schedule = schedule_of(x, 7, 60s);
  EXPECT_EQ(schedule_of(x, 7, 60s), schedule);
  EXPECT_NE(schedule_of(x, 8, 60s), schedule);
  EXPECT_TRUE(std::ranges::is_sorted(schedule, {}, &DueAction::at));
  EXPECT_LT(schedule.back().at, 60s);
  EXPECT_EQ(std::ranges::count(schedule, 0U, &DueAction::statement), 59);
  EXPECT_EQ(std::ranges::count(schedule, 2U, &DueAction::statement), 1);
  EXPECT_EQ(std::ranges::count(schedule, 3U, &DueAction::statement), 0);
  std::set<std::string> said;
  for (auto& action : schedule)
    if (action.statement == 0)
      said.insert(std::get<Say>(action.action).sentence);
  EXPECT_THAT(said, ElementsAre("a", "b", "c"));
}

TEST(Workload, OneMoreStatementChangesNothingAboutTheOthers) {
  const std::string first = "rate 1/s say \"a\" or \"b\"\n";
  auto alone = schedule_of(workload_of(first), 7, 60s);
  auto both = schedule_of(workload_of(first + "rate 5/s say \"c\"\n"), 7, 60s);
  std::erase_if(both, [](auto& x) { return x.statement == 1; });
  EXPECT_EQ(both, alone);
}

// -- whatever is written

RC_GTEST_PROP(AnyWorkloadText, IsAWorkloadOrRefused, ()) {
  auto piece = rc::gen::oneOf(
    rc::gen::element<std::string>(
      "\n", " ", "at 1s ", "every 2s ", "rate 1/s ", "say ", "\"a b\" ", "write ", "Note ",
      "{\"a\":[1]} ", "{", "}", "to ", "m/id ", "move ", "red ball ", "0.1 ", "-2cm ", "add ",
      "at ", "size ", "remove ", "or ", "expect answer within 2s", "same A, B ", "but for x",
      "never ", "each ", "becomes ", "within 1s", "where a > 1 ", ",", "\"", "\\", "#"),
    rc::gen::arbitrary<std::string>());
  std::string text;
  for (const auto& each : *rc::gen::container<std::vector<std::string>>(piece))
    text += each;
  auto result = parse_workload(text, "test.workload");
  RC_ASSERT(result.ok() == result.diagnostics.empty());
  if (result.ok())
    RC_ASSERT(workload_of(to_string(*result.workload)) == *result.workload);
}

} // namespace

} // namespace castor::faults
