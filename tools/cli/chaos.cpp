#include "castor/actors/node/check.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/chaos/chaos_report.hpp"
#include "castor/tools/chaos/coverage.hpp"
#include "castor/tools/chaos/random_plan.hpp"
#include "castor/tools/cli/chaos_trial.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/duration_option.hpp"
#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/read_architecture.hpp"
#include "castor/tools/cli/read_plan.hpp"
#include "castor/tools/cli/read_workload.hpp"
#include "castor/tools/cli/seeds_option.hpp"
#include "castor/tools/cli/signals.hpp"
#include "castor/tools/cli/writable.hpp"
#include "castor/tools/simulation/seeds.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::cli {

namespace {

struct ChaosArguments {
  ArchitectureArguments architecture;
  std::string plan;
  std::string workload;
  std::optional<std::uint64_t> seed;
  std::string duration = "1min";
  std::filesystem::path report;
  int spread = 0;
  std::vector<std::string> same;
  std::vector<std::string> but_for;
  std::string settle = "2s";
  std::string bound = "10s";
  std::optional<double> rate;
  std::string seeds;
  bool find_limit = false;
  bool json = false;
};

/// `castor chaos`: prepares what all trials have in common, and makes one after the other.
class Chaos {
public:
  Chaos(const ChaosArguments& arguments, std::vector<std::string> plugins) : arguments_(arguments) {
    setup_.plugins = std::move(plugins);
    setup_.compared = {{arguments.same.begin(), arguments.same.end()},
                       {arguments.but_for.begin(), arguments.but_for.end()}};
    setup_.duration = duration(arguments.duration).value();
    setup_.settle = duration(arguments.settle).value();
    setup_.bound = duration(arguments.bound).value();
  }

  int run() {
    if (arguments_.json)
      json_.emplace();
    auto architecture = read_architecture(arguments_.architecture);
    if (!architecture)
      return bad_input;
    if (arguments_.spread > 0)
      spread(*architecture, arguments_.spread);
    setup_.architecture = *std::move(architecture);
    setup_.targets = targets_in(setup_.architecture);
    faults::FaultPlan given;
    if (has_plan()) {
      auto plan = read_plan(arguments_.plan, setup_.targets);
      if (!plan)
        return bad_input;
      given = *std::move(plan);
    }
    if (!take_workload())
      return bad_input;
    auto first_seed =
      arguments_.seeds.empty()
        ? arguments_.seed.value_or(given.seed.value_or(new_incarnation() % 1'000'000))
        : simulation::parse_seeds(arguments_.seeds).from;
    progress_.emplace("chaos");
    if (!setup_.compared.types.empty() || !has_plan()) {
      log_runtime(LogLevel::info, "first without faults, to see what it does and how it ends then");
      faultless_ = run_without_faults(setup_, first_seed, signals_, *progress_);
      if (signals_.count() > 0)
        return a_component_failed;
    }
    if (arguments_.find_limit)
      return find_limit();
    if (!arguments_.seeds.empty())
      return run_seeds(given);
    int status = success;
    run_once(given, first_seed, arguments_.report, [&](const faults::ChaosRun& result) {
      status = status_of(result);
      auto file = arguments_.report.empty()
                    ? std::string{}
                    : "\nwrote " + (arguments_.report / "chaos.html").string() + '\n';
      print(result, '\n' + faults::to_text(result, isatty(STDOUT_FILENO) != 0) + file);
    });
    return status;
  }

private:
  bool has_plan() const { return !arguments_.plan.empty(); }

  /// What is done with a run that is known whole.
  using Show = std::function<void(const faults::ChaosRun&)>;

  /// @param given the user's plan, if there is one
  void run_once(const faults::FaultPlan& given, std::uint64_t seed,
                const std::filesystem::path& report, const Show& show) {
    faults::ChaosRun result;
    result.system = arguments_.architecture.file;
    result.command = command(seed, report);
    result.seed = seed;
    result.duration = setup_.duration;
    result.targets = setup_.targets;
    for (auto& x : faultless_.violations)
      result.violations.push_back({x.check, x.text, {}, seed, result.command});
    auto plan = has_plan()
                  ? given
                  : faults::random_plan(setup_.targets, seed, setup_.duration, random_options());
    run_with_faults(setup_, plan, faultless_.state, signals_, *progress_, result, [&] {
      write_report(result, report);
      show(result);
    });
  }

  faults::RandomPlanOptions random_options() const {
    faults::RandomPlanOptions result;
    result.activity = faultless_.activity;
    if (arguments_.rate) {
      result.interval = interval_of(*arguments_.rate);
      result.within_restart_limits = false;
    }
    return result;
  }

  static Timestamp interval_of(double faults_per_minute) {
    return std::chrono::duration_cast<Timestamp>(
      std::chrono::duration<double>{60 / faults_per_minute});
  }

  static int status_of(const faults::ChaosRun& x) {
    return !x.held() ? a_component_failed : x.vacuous().empty() ? success : vacuous_run;
  }

  /// One run after the other, each with the faults of its seed.
  int run_seeds(const faults::FaultPlan& given) {
    auto seeds = simulation::parse_seeds(arguments_.seeds);
    faults::Coverage coverage{setup_.targets};
    std::map<int, std::size_t> counts;
    for (auto seed = seeds.from; seed <= seeds.to && signals_.count() == 0; ++seed) {
      // Other actions are drawn, from which another state follows.
      if (!setup_.compared.types.empty() && setup_.workload_seed(seed) != faultless_.workload_seed)
        faultless_ = run_without_faults(setup_, seed, signals_, *progress_);
      auto report = arguments_.report.empty() ? std::filesystem::path{}
                                              : arguments_.report / std::to_string(seed);
      run_once(given, seed, report, [&](const faults::ChaosRun& result) {
        coverage.add(result.faults);
        ++counts[status_of(result)];
        print(result, faults::to_line(result, isatty(STDOUT_FILENO) != 0) + '\n');
      });
    }
    progress_.reset();
    if (!arguments_.json)
      fmt::print("\n{} held, {} violated, {} vacuous; {}", counts[success],
                 counts[a_component_failed], counts[vacuous_run], faults::to_text(coverage));
    for (auto status : {a_component_failed, vacuous_run})
      if (counts[status] > 0)
        return status;
    return success;
  }

  // -- the limit of supervision

  /// Whether the supervisors bear so many failures a minute.
  bool survives(double failures_per_minute) {
    auto options = random_options();
    options.interval = interval_of(failures_per_minute);
    options.within_restart_limits = false;
    options.failures_only = true;
    faults::ChaosRun run;
    run.seed = arguments_.seed.value_or(1);
    run.duration = setup_.duration;
    run_with_faults(setup_, faults::random_plan(setup_.targets, run.seed, setup_.duration, options),
                    faultless_.state, signals_, *progress_, run, [] {});
    auto given_up =
      std::ranges::find_if(run.outages, [](auto& x) { return !x.up && x.escalated.has_value(); });
    auto survival = std::ranges::find(run.violations, "survival", &faults::Violation::check);
    auto result = given_up == run.outages.end() && survival == run.violations.end();
    auto why = result ? std::string{"survived"}
               : survival != run.violations.end()
                 ? survival->text
                 : given_up->target + " was given up: " + given_up->reason;
    auto failures = run.outages.size();
    const ProgressPause pause;
    if (arguments_.json)
      json_->print({{"failures_per_minute", failures_per_minute},
                    {"outages", failures},
                    {"survived", result},
                    {"reason", result ? "" : why}});
    else
      fmt::print("{:6.1f} failures a minute, {:3} outages: {}\n", failures_per_minute, failures,
                 why);
    std::fflush(stdout);
    return result;
  }

  /// Bisects between a rate that is survived and one that is not.
  int find_limit() {
    constexpr double lowest = 1;
    constexpr double highest = 3840;
    constexpr double close_enough = 1.2;
    double survived = 0;
    double too_much = 0;
    for (double rate = arguments_.rate.value_or(15); signals_.count() == 0;) {
      (survives(rate) ? survived : too_much) = rate;
      if (too_much == 0 ? survived >= highest : too_much <= lowest)
        break;
      if (survived > 0 && too_much > 0 && too_much < close_enough * survived)
        break;
      rate = too_much == 0   ? 2 * survived
             : survived == 0 ? too_much / 2
                             : std::sqrt(survived * too_much);
    }
    progress_.reset();
    if (signals_.count() > 0)
      return a_component_failed;
    if (!arguments_.json)
      fmt::print("\n{}: {}\n", arguments_.architecture.file,
                 too_much == 0 ? fmt::format("{:.1f} failures a minute are survived", survived)
                 : survived == 0
                   ? fmt::format("{:.1f} failures a minute are too many", too_much)
                   : fmt::format("{:.1f} failures a minute are survived, {:.1f} are too many",
                                 survived, too_much));
    return success;
  }

  /// Where the plan of a run with a report is kept, with nothing left to draw.
  static std::filesystem::path kept_plan(const std::filesystem::path& report) {
    return report / "chaos.plan";
  }

  /// The user's, or the one beside the system's file; false if it cannot be done.
  bool take_workload() {
    auto file = workload_beside(arguments_.workload, setup_.architecture.file);
    if (file.empty())
      return true;
    // Loads the libraries that know the entry types that it names.
    auto problems = check_architecture(setup_.architecture);
    cli::print(problems);
    if (!problems.empty())
      return false;
    setup_.workload = read_workload(file, setup_.architecture);
    if (!setup_.workload)
      return false;
    log_runtime(LogLevel::info, "workload: " + file);
    if (auto& same = setup_.workload->workload.same) {
      setup_.compared.types.insert(same->types.begin(), same->types.end());
      setup_.compared.ignored.insert(same->but_for.begin(), same->but_for.end());
    }
    return true;
  }

  /// What makes the same faults once more.
  std::string command(std::uint64_t seed, const std::filesystem::path& report) const {
    std::string result = "castor";
    for (auto& x : setup_.plugins)
      result += " --plugin " + x;
    result += " chaos " + arguments_.architecture.file;
    if (has_plan())
      result += " --plan " + arguments_.plan;
    else if (!report.empty())
      result += " --plan " + kept_plan(report).string();
    else if (arguments_.rate)
      result += fmt::format(" --rate {}", *arguments_.rate);
    if (setup_.workload)
      result += " --workload " + setup_.workload->workload.file;
    else if (!arguments_.workload.empty())
      result += " --workload " + arguments_.workload;
    result += fmt::format(" --seed {} --duration {}", seed, arguments_.duration);
    if (arguments_.spread > 0)
      result += fmt::format(" --spread {}", arguments_.spread);
    for (auto& x : arguments_.architecture.variables)
      result += " --set " + x;
    for (auto& x : arguments_.same)
      result += " --same " + x;
    for (auto& x : arguments_.but_for)
      result += " --but-for " + x;
    for (auto& [option, value, otherwise] :
         {std::tuple{"settle", arguments_.settle, ChaosArguments{}.settle},
          std::tuple{"bound", arguments_.bound, ChaosArguments{}.bound}})
      if (value != otherwise)
        result += fmt::format(" --{} {}", option, value);
    return result;
  }

  static void write_report(const faults::ChaosRun& run, const std::filesystem::path& report) {
    if (report.empty())
      return;
    make_folder(report);
    create(report / "chaos.html") << faults::to_html(run);
    create(report / "chaos.json") << faults::to_json(run);
    create(kept_plan(report)) << run.plan;
  }

  /// @param text what is said of it without --json
  void print(const faults::ChaosRun& run, const std::string& text) {
    const ProgressPause pause;
    if (arguments_.json)
      json_->print(nlohmann::ordered_json::parse(faults::to_json(run)));
    else
      fmt::print("{}", text);
    std::fflush(stdout);
  }

  Signals signals_;
  /// What components print is not among it.
  std::optional<JsonOutput> json_;
  const ChaosArguments& arguments_;
  ChaosSetup setup_;
  /// The last run without faults; empty if none was made.
  FaultlessRun faultless_;
  std::optional<Progress> progress_;
};

} // namespace

void add_chaos(CLI::App& app, Action& chosen, const std::vector<std::string>& plugins) {
  auto* command =
    app.add_subcommand("chaos", "run a system with injected faults and verify that it recovers");
  auto arguments = std::make_shared<ChaosArguments>();
  add_architecture_arguments(*command, arguments->architecture);
  command
    ->add_option("--plan", arguments->plan,
                 "fault plan (docs/fault-plans.md); by default a random mix of all faults that the "
                 "system should survive")
    ->type_name("FILE");
  command
    ->add_option("--workload", arguments->workload,
                 "sentences and actions during the run (docs/fault-plans.md); by default the "
                 ".workload file beside FILE, if there is one; none: nothing")
    ->type_name("FILE");
  command
    ->add_option("--seed", arguments->seed,
                 "seed for what the plan leaves open; the same seed gives the same faults")
    ->type_name("N");
  auto seeds =
    command
      ->add_option("--seeds", arguments->seeds,
                   "one run for each of these seeds, and a table of what all of them hit")
      ->type_name("FROM..TO")
      ->check(check_seeds)
      ->excludes("--seed");
  command
    ->add_option("--rate", arguments->rate,
                 "faults per minute, whatever the restart limits are; by default 30, or fewer if "
                 "the restart limits require it")
    ->type_name("N")
    ->check(CLI::Range(0.1, 6000.0))
    ->excludes("--plan");
  command
    ->add_flag("--find-limit", arguments->find_limit,
               "find the highest rate of failures per minute that supervision survives, by "
               "bisection; each trial lasts --duration")
    ->excludes("--plan")
    ->excludes(seeds);
  command
    ->add_option("--duration", arguments->duration, "how long faults are injected; by default 1min")
    ->type_name("DURATION")
    ->check(check_duration);
  command->add_option("--report", arguments->report, "write chaos.html and chaos.json here")
    ->type_name("DIR")
    ->check(check_output_folder);
  command
    ->add_option("--spread", arguments->spread,
                 "distribute the system over N nodes, whatever hosts the file names")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  command
    ->add_option("--same", arguments->same,
                 "entry types whose final entries must be the same as in a run without faults, "
                 "which is made first")
    ->type_name("TYPE")
    ->delimiter(',');
  command
    ->add_option("--but-for", arguments->but_for,
                 "fields to ignore in that comparison, such as times and ids")
    ->type_name("FIELD")
    ->delimiter(',');
  command
    ->add_option("--settle", arguments->settle,
                 "the run has settled when nothing has changed for this long; by default 2s")
    ->type_name("DURATION")
    ->check(check_duration);
  command
    ->add_option("--bound", arguments->bound,
                 "whatever goes down must be back, or given up, within this time; by default 10s")
    ->type_name("DURATION")
    ->check(check_duration);
  add_json_flag(*command, arguments->json);
  command->footer(
    "All nodes that the file names are started on this machine.\n"
    "Exit status: 0 if everything held, 1 if something did not, 2 if the run could not be made,\n"
    "4 if it shows nothing, because nothing went down or hardly anything was going on.\n"
    "Example: castor chaos configs/vision-three-nodes.cast --duration 30s --report out");
  command->callback([&chosen, &plugins, arguments] {
    chosen = [&plugins, arguments] { return Chaos{*arguments, plugins}.run(); };
  });
}

} // namespace castor::cli
