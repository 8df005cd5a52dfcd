#include "castor/tools/chaos/chaos_report.hpp"

#include "castor/tools/chaos/chart.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <regex>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

ChaosRun small_run() {
  ChaosRun run;
  run.system = "robot.cast";
  run.command = "castor chaos robot.cast --seed 7 --duration 20s";
  run.seed = 7;
  run.duration = 20s;
  run.plan = "seed 7\nat 2s crash segmentor\n";
  run.faults = {
    {2s, 2010ms, {}, "crash", "segmentor", "crash segmentor", FaultState::happened, ""},
    {5s, 5s, 6s, "stop", "node1", "stop node1 for 1s", FaultState::happened, ""},
    {9s, {}, {}, "kill", "node2", "kill node2", FaultState::not_injected, "it was down already"},
    {9s,
     {},
     {},
     "throw",
     "binder",
     "throw in callback 19 of binder",
     FaultState::never,
     "its component had no such callback"}};
  run.outages = {{"segmentor", 2s, 2100ms, 2150ms, {}, 1s, "crash"},
                 {"tracker", 5s, 5400ms, {}, {}, 1s, "node1 is out of reach"},
                 {"binder", 9s, {}, {}, 9500ms, 1s, "five restarts in 10 s"},
                 {"camera", 19s, {}, {}, {}, 5s, "crash"}};
  run.checks = {{"linearizability", CheckRecord::Verdict::held, "1203 operations on 12 entries"},
                {"leases", CheckRecord::Verdict::violated, "40 leases"},
                {"journal", CheckRecord::Verdict::undecided, "no working memory has one"}};
  run.violations = {
    {"leases", "two holders\nat once", 6s, 7, "castor chaos robot.cast --seed 7 --duration 20s"}};
  run.resources = {{"coordinator", {{0s, 10'000'000, 20, 8}, {20s, 30'000'000, 22, 8}}},
                   {"node1", {{0s, 9'000'000, 15, 6}, {20s, 9'500'000, 15, 6}}}};
  run.facts = {{"events", "5120"}};
  return run;
}

/// Every tag that is opened is closed, and in the right order.
testing::AssertionResult is_well_formed(const std::string& page) {
  static const std::regex tag{R"(<(/?)([a-z0-9]+)(?:\s[^<>]*?)?(/?)>)"};
  std::vector<std::string> open;
  for (std::sregex_iterator i{page.begin(), page.end(), tag}, end; i != end; ++i) {
    auto name = (*i)[2].str();
    if (name == "meta" || (*i)[3].length() > 0)
      continue;
    if ((*i)[1].length() == 0) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return testing::AssertionFailure()
             << "</" << name << "> closes " << (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? testing::AssertionSuccess()
                      : testing::AssertionFailure() << open.back() << " is not closed";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST(ChaosReport, ThePageShowsAllThereIs) {
  auto page = to_html(small_run());
  EXPECT_TRUE(is_well_formed(page));
  for (auto part :
       {"robot.cast", "1 violation", "castor chaos robot.cast --seed 7 --duration 20s",
        "two holders\nat once", "crash segmentor", "not injected", "it was down already",
        "never triggered", "2 of 4 faults happened, 1 never triggered, 1 not injected",
        "node1 is out of reach", "1203 operations", "undecided", "at 2s crash segmentor", "5120",
        "2 back, 1 given up, 1 neither", "memory in MB", "file descriptors", "threads"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_EQ(count(page, "<svg"), 1U + 1U + 3U + 8U + 2U);
}

TEST(ChaosReport, ThePageNeedsNothingButItself) {
  auto page = to_html(small_run());
  for (auto part : {"<script", "http:", "https:", "src=", "href=", "url(", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(part)));
}

TEST(ChaosReport, NothingInThePageIsTakenForMarkup) {
  std::string evil = "<b onload='x' a=\"y\">&\x1b[0m";
  auto run = small_run();
  auto plain = to_html(run);
  run.system = run.command = run.plan = evil;
  for (auto& x : run.faults)
    x.target = x.fault = x.outcome = evil;
  for (auto& x : run.outages)
    x.target = x.reason = evil;
  for (auto& x : run.checks)
    x.name = x.grounds = evil;
  for (auto& x : run.violations)
    x.check = x.text = x.replay = evil;
  for (auto& x : run.resources)
    x.process = evil;
  run.facts = {{evil, evil}};
  auto page = to_html(run);
  EXPECT_TRUE(is_well_formed(page));
  EXPECT_THAT(page, Not(HasSubstr("<b ")));
  EXPECT_THAT(page, Not(HasSubstr("\x1b")));
  EXPECT_THAT(page, Not(HasSubstr("onload='")));
  EXPECT_EQ(count(to_text(run), "\x1b"), 0U);
}

TEST(ChaosReport, ARunInWhichNothingHappenedHasAPageToo) {
  ChaosRun run;
  run.system = "robot.cast";
  auto page = to_html(run);
  EXPECT_TRUE(is_well_formed(page));
  EXPECT_THAT(page, HasSubstr("vacuous, nothing went down"));
  EXPECT_THAT(page, Not(HasSubstr("<svg")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_TRUE(nlohmann::json::parse(to_json(run)).at("held").get<bool>());
}

TEST(ChaosReport, JsonSaysTheSame) {
  auto json = nlohmann::json::parse(to_json(small_run()));
  EXPECT_EQ(json.at("seed"), 7);
  EXPECT_EQ(json.at("held"), false);
  EXPECT_EQ(json.at("faults").size(), 4U);
  EXPECT_TRUE(json.at("workload").is_null());
  EXPECT_EQ(json.at("faults")[1].at("until_us"), 6'000'000);
  EXPECT_EQ(json.at("outages")[0].at("recovery_us"), 150'000);
  EXPECT_TRUE(json.at("outages")[3].at("up_us").is_null());
  EXPECT_EQ(json.at("recovery").at("p50_us"), 150'000);
  EXPECT_EQ(json.at("checks")[2].at("verdict"), "undecided");
  EXPECT_EQ(json.at("violations")[0].at("replay"),
            "castor chaos robot.cast --seed 7 --duration 20s");
  EXPECT_EQ(json.at("resources")[0].at("samples")[1].at("memory_bytes"), 30'000'000);
  auto run = small_run();
  run.violations.front().text = "no UTF-8: \xff";
  EXPECT_NO_THROW(nlohmann::json::parse(to_json(run)));
}

TEST(ChaosReport, TheTerminalIsToldInShort) {
  EXPECT_EQ(to_text(small_run()),
            "robot.cast: 1 violation (4 outages: component 4; seed 7, 20 s)\n"
            "  faults: 2 of 4 faults happened, 1 never triggered, 1 not injected\n"
            "  ok         linearizability              1203 operations on 12 entries\n"
            "  VIOLATED   leases                       40 leases\n"
            "  undecided  journal                      no working memory has one\n"
            "  outages: 2 back, 1 given up, 1 neither; half within 150 ms, 99 % within 400 ms, "
            "all within 400 ms\n"
            "  events: 5120\n"
            "\n"
            "leases at 6 s\n"
            "  two holders\n"
            "  at once\n"
            "  seed 7, again: castor chaos robot.cast --seed 7 --duration 20s\n"
            "\n"
            "  2 of 4 pairs of a fault and a target were hit\n"
            "\n"
            "                 crash\n"
            "    segmentor        1\n"
            "\n"
            "              kill\n"
            "    node2     . -1\n"
            "\n"
            "              stop\n"
            "    node1        1\n"
            "\n"
            "              throw\n"
            "    binder     . -1\n");
  EXPECT_GT(count(to_text(small_run(), true), "\x1b[31m"), 0U);
}

TEST(ChaosReport, WhatBecameOfAWorkloadIsSaidFirst) {
  auto run = small_run();
  run.workload.emplace();
  run.workload->file = "robot.workload";
  run.workload->took = 20s;
  run.workload->statements = {{"every 4s say \"Where is <it>?\"",
                               {.due = 4, .done = 3, .said = 3, .answered = 2, .unanswered = 1},
                               "there is no subarchitecture talk"}};
  run.workload->answer_times = {1s, 2s};
  EXPECT_THAT(
    to_text(run),
    HasSubstr("1 not injected\n"
              "  workload: robot.workload: 3 sentences, 2 answered, 0 apologised for (0.1 "
              "answers a second), 1 not answered; 1 not done\n"
              "  answers: half within 1 s, all within 2 s\n"
              "  ok         linearizability"));
  auto json = nlohmann::json::parse(to_json(run)).at("workload");
  EXPECT_EQ(json.at("file"), "robot.workload");
  EXPECT_EQ(json.at("counts").at("answered"), 2);
  EXPECT_EQ(json.at("answer_longest_us"), 2'000'000);
  EXPECT_EQ(json.at("statements")[0].at("counts").at("unanswered"), 1);
  EXPECT_EQ(json.at("statements")[0].at("problem"), "there is no subarchitecture talk");
  auto page = to_html(run);
  EXPECT_TRUE(is_well_formed(page));
  EXPECT_THAT(page, HasSubstr("every 4s say &quot;Where is &lt;it&gt;?&quot;"));
}

TEST(Chart, TicksAreRound) {
  EXPECT_THAT(round_ticks(10, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(round_ticks(7, 4), ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(round_ticks(0.3, 3), ElementsAre(0, 0.1, 0.2, testing::DoubleNear(0.3, 1e-9)));
  EXPECT_THAT(round_ticks(0, 4), ElementsAre(0));
  for (auto most : {0.001, 0.7, 3.0, 42.0, 99.0, 123'456.0, 1e9}) {
    EXPECT_GE(round_ticks(most, 10).size(), 4U) << most;
    EXPECT_LE(round_ticks(most, 10).size(), 12U) << most;
  }
}

TEST(Chart, TheTimelineHasARowForEverythingThatFailed) {
  auto chart = timeline_chart(small_run());
  for (auto name : {"segmentor", "node1", "node2", "tracker", "binder", "camera"})
    EXPECT_EQ(count(chart, std::string{">"} + name + "</text>"), 1U) << name;
  EXPECT_EQ(count(chart, "class=\"fault\""), 2U);
  EXPECT_EQ(count(chart, "class=\"fault undone\""), 2U);
  EXPECT_EQ(count(chart, "class=\"down\""), 2U);
  EXPECT_EQ(count(chart, "class=\"down forever\""), 2U);
  EXPECT_EQ(count(chart, "class=\"works\""), 1U);
  EXPECT_EQ(count(chart, "class=\"limit\""), 1U);
}

TEST(Chart, WhatHappenedAfterTheEndStaysInThePicture) {
  auto run = small_run();
  run.outages.push_back({"late", 19s, 90s, {}, {}, 1s, ""});
  std::smatch found;
  auto chart = timeline_chart(run);
  static const std::regex coordinate{R"re((?:x|x1|x2|cx)="(-?[0-9.]+)")re"};
  for (std::sregex_iterator i{chart.begin(), chart.end(), coordinate}, end; i != end; ++i)
    EXPECT_LE(std::stod((*i)[1]), 960);
}

} // namespace

} // namespace castor::faults
