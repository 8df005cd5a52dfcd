// `castor plan`: its ends, what it prints, and what it says about files that cannot be used.

#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::HasSubstr;

struct Answer {
  int status = 0;
  std::string output;
  std::string errors;
};

const std::string explorer = CASTOR_DOMAINS "/explorer.pddl";

const std::string door_domain = "(define (domain doors)\n"
                                "(:predicates (open ?d) (door ?d) (locked ?d))\n"
                                "(:action push :parameters (?d)\n"
                                ":precondition (and (door ?d) (not (locked ?d)))\n"
                                ":effect (open ?d)))\n";

std::string door_problem(const std::string& facts) {
  return "(define (problem p) (:domain doors) (:objects d)\n(:init (door d) " + facts +
         ")\n(:goal (open d)))\n";
}

/// A counter of so many bits, which counts up one by one.
std::string counter_domain(int bits) {
  std::string result = "(define (domain counter) (:predicates";
  for (int i = 0; i < bits; ++i)
    result += " (b" + std::to_string(i) + ")";
  result += ")";
  for (int i = 0; i < bits; ++i) {
    std::string lower;
    std::string effect;
    for (int k = 0; k < i; ++k) {
      lower += "(b" + std::to_string(k) + ")";
      effect += "(not (b" + std::to_string(k) + "))";
    }
    const auto own = "(b" + std::to_string(i) + ")";
    result += "(:action inc" + std::to_string(i) + " :precondition (and (not " + own + ")" + lower +
              ") :effect (and " + own + effect + "))";
  }
  return result + ")";
}

std::string counter_problem(int bits) {
  std::string result = "(define (problem p) (:domain counter) (:init) (:goal (and";
  for (int i = 0; i < bits; ++i)
    result += " (b" + std::to_string(i) + ")";
  return result + ")))";
}

class PlanCommand : public testing::Test {
protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream{folder_ / name} << text;
    return (folder_ / name).string();
  }

  static Answer plan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {CASTOR_EXECUTABLE, "plan"});
    Process process{arguments};
    const auto status = process.wait();
    return {status, process.output(), process.errors()};
  }

  Answer plan_doors(const std::string& facts) const {
    return plan({write("d.pddl", door_domain), write("p.pddl", door_problem(facts))});
  }

private:
  TemporaryFolder folder_;
};

TEST_F(PlanCommand, PrintsAPlan) {
  const auto answer = plan_doors("");
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("(push d)  ; 1\n"));
  EXPECT_THAT(answer.output, HasSubstr("plan of 1 actions with cost 1"));
}

TEST_F(PlanCommand, PrintsAPlanAsJson) {
  const auto answer =
    plan({write("d.pddl", door_domain), write("p.pddl", door_problem("")), "--json"});
  ASSERT_EQ(answer.status, 0) << answer.errors;
  const auto json = nlohmann::json::parse(answer.output);
  EXPECT_EQ(json["outcome"], "plan");
  ASSERT_EQ(json["steps"].size(), 1U);
  EXPECT_EQ(json["steps"][0]["action"], "push d");
}

TEST_F(PlanCommand, SaysThatThereIsNoPlan) {
  const auto answer = plan_doors("(locked d)");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.output, HasSubstr("there is no plan"));
}

TEST_F(PlanCommand, SaysWhichLimitItReached) {
  const auto domain = write("d.pddl", counter_domain(40));
  const auto problem = write("p.pddl", counter_problem(40));
  const auto late = plan({domain, problem, "--time", "100ms"});
  EXPECT_EQ(late.status, 1);
  EXPECT_THAT(late.output, HasSubstr("no plan was found within the limits"));
  EXPECT_THAT(late.output, HasSubstr("the time is over"));
  const auto large = plan({domain, problem, "--memory", "1"});
  EXPECT_EQ(large.status, 1);
  EXPECT_THAT(large.output, HasSubstr("the memory is used up"));
}

TEST_F(PlanCommand, EndsWhenItIsInterrupted) {
  Process process{{CASTOR_EXECUTABLE, "plan", write("d.pddl", counter_domain(40)),
                   write("p.pddl", counter_problem(40)), "--time", "10min"}};
  // It is interrupted at whatever it is doing: loading, reading, or searching.
  process.send_signal(SIGINT);
  const auto status = process.wait();
  EXPECT_TRUE(status == 1 || status == 128 + SIGINT) << status << process.errors();
  if (status == 1) {
    EXPECT_THAT(process.output(), HasSubstr("it was cancelled"));
  }
}

TEST_F(PlanCommand, SaysWhatIsWrongWithFiles) {
  const auto answer = plan_doors("(opne d)");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.errors, HasSubstr("p.pddl:2"));
  EXPECT_THAT(answer.errors, HasSubstr("did you mean 'open'?"));
  const auto missing = plan({"/no/such.pddl", "/no/problem.pddl"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.errors, HasSubstr("/no/problem.pddl"));
}

TEST_F(PlanCommand, PromisesByAssertionsOfMapl) {
  const auto problem =
    write("p.pddl", "(define (problem p) (:domain explorer) (:agent robby)\n"
                    "(:objects robby - robot ann - human hall - room book - thing)\n"
                    "(:init (= (is-in robby) hall) (= (is-in ann) hall)\n"
                    "(K ann (asserted-position book)))\n"
                    "(:goal (K robby (perceived-position book))))\n");
  const auto answer = plan({explorer, problem});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("(ask-val-asserted-position robby ann book hall)  ; 1\n"
                                       "(object-search-in-room_a robby book)  ; 1\n"));
}

} // namespace

} // namespace castor::test
