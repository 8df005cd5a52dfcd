#include "castor/tools/simulation/campaign.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <thread>

/// What mutants are made of; with more to say, `castor simulate`.
int main(int argc, char** argv) {
  using namespace castor::simulation;
  CLI::App app{"Simulates whole systems, as `castor simulate` does."};
  std::string seeds = "1..10000";
  bool expect_violation = false;
  app.add_option("--seeds", seeds, "which, FROM..TO")->capture_default_str();
  app.add_flag("--expect-violation", expect_violation, "fail if all is well");
  CLI11_PARSE(app, argc, argv);
  CampaignOptions options;
  options.seeds = parse_seeds(seeds);
  options.threads = std::max(1u, std::thread::hardware_concurrency());
  auto report = run_campaign({}, options);
  for (auto& x : report.violations)
    fmt::print("seed {}:\n{}\n", x.seed, x.text);
  fmt::print("{} systems, {:.0f}/s\n", report.done, report.systems_per_second());
  return report.held() != expect_violation ? 0 : 1;
}
