#include "castor/planning/symbolic/pddl_reader.hpp"
#include "castor/planning/symbolic/planner.hpp"
#include "castor/tests/planning/symbolic/validator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace castor::planning {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Tasks of international planning competitions.
class BenchmarkDomainsTest : public testing::TestWithParam<const char*> {};

TEST_P(BenchmarkDomainsTest, IsSolvedByAValidPlan) {
  const std::filesystem::path problem = std::filesystem::path(CASTOR_PDDL) / GetParam();
  const auto domain = problem.parent_path() / "domain.pddl";
  if (!std::filesystem::exists(problem))
    GTEST_SKIP() << "there is no " << problem;
  const auto read = read_pddl(domain, problem);
  ASSERT_FALSE(has_errors(read.problems)) << render(read.problems);
  PlanningOptions options;
  options.limits.time = std::chrono::seconds(60);
  const auto result = find_plan(read.task, options);
  ASSERT_EQ(result.outcome, PlanningResult::Outcome::plan) << explain(result);
  std::vector<std::string> plan;
  for (const auto& x : result.steps)
    plan.push_back(x.action);
  EXPECT_EQ(test::validate(test::PddlModel(text_of(domain), text_of(problem)), plan, result.cost),
            "");
}

INSTANTIATE_TEST_SUITE_P(Competitions, BenchmarkDomainsTest,
                         testing::Values("blocks/probBLOCKS-9-0.pddl", "gripper/prob05.pddl",
                                         "logistics00/probLOGISTICS-8-0.pddl",
                                         "miconic/s10-0.pddl"));

} // namespace
} // namespace castor::planning
