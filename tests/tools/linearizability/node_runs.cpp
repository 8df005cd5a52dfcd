#include "castor/tests/tools/linearizability/node_runs.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/node/node.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/tests/support/process.hpp"
#include "castor/tests/support/relay.hpp"

#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <functional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace castor::linearizability {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr std::size_t nodes = 3;
constexpr std::size_t coordinator = 0;

/// Who is silent for some time is given up soon, and tried again soon.
LinkOptions impatient(Milliseconds patience) {
  LinkOptions result;
  result.patience = patience;
  result.heartbeat = 20ms;
  result.silence = 150ms;
  result.connecting = 150ms;
  // Even the small values of entries are kept for the next reader, and only a few of them.
  result.session.shared_content = 1;
  result.session.kept_contents = 2000;
  return result;
}

/// Who lives where: process 0 is the coordinator, the others are nodes.
struct NodesPlan {
  struct Player {
    std::size_t home = 0;
    std::size_t process = 0;
  };

  /// The processes of the subarchitectures' working memories.
  std::vector<std::size_t> subarchitectures;
  std::vector<Player> players;
  std::size_t entries = 1;
  Milliseconds lease{2000};
  Milliseconds deadline{250};
  std::vector<Fault> faults;

  std::size_t home_of(std::size_t entry) const { return entry % subarchitectures.size(); }
  /// When the last fault is over.
  Milliseconds end() const {
    Milliseconds result{0};
    for (auto& x : faults)
      result = std::max(result, x.end());
    return result;
  }
};

NodesPlan plan_for(std::uint64_t seed, std::optional<Milliseconds> longest_fault) {
  std::mt19937_64 random{seed};
  auto pick = [&](std::size_t count) { return random() % count; };
  NodesPlan result;
  for (auto count = 1 + pick(4); count > 0; --count)
    result.subarchitectures.push_back(pick(7) == 0 ? coordinator : 1 + pick(nodes));
  result.entries = 1 + pick(4);
  for (auto count = 4 + pick(7); count > 0; --count) {
    auto home = pick(result.subarchitectures.size());
    result.players.push_back(
      {home, pick(2) == 0 ? result.subarchitectures[home] : pick(1 + nodes)});
  }
  // In some runs leases run out, of whoever is slow or of whoever is out of reach for some time.
  std::array leases{Milliseconds{2 + pick(10)}, Milliseconds{100 + pick(300)}, Milliseconds{2000}};
  result.lease = leases[pick(leases.size())];
  std::array deadlines{100ms, 250ms, 600ms};
  result.deadline = deadlines[pick(deadlines.size())];
  if (longest_fault)
    result.faults = random_faults(random, nodes, *longest_fault);
  return result;
}

std::string host(std::size_t process) {
  return process == coordinator ? "localhost" : "node" + std::to_string(process);
}

ArchitectureDescription architecture(const NodesPlan& plan, const World& world) {
  auto shared = " --world " + world.path();
  std::string text;
  for (std::size_t i = 0; i < plan.subarchitectures.size(); ++i) {
    text += "SUBARCHITECTURE " + subarchitecture_name(i) + " " + host(plan.subarchitectures[i]) +
            "\nCPP WM SubarchitectureWorkingMemory --lease " + std::to_string(plan.lease.count()) +
            "ms\nCPP TM AlwaysPositiveTaskManager\n";
    for (std::size_t player = 0; player < plan.players.size(); ++player)
      if (plan.players[player].home == i)
        text += host(plan.players[player].process) + " CPP UM p" + std::to_string(player + 1) +
                " Player --deadline " + std::to_string(plan.deadline.count()) + "ms" + shared +
                "\n";
  }
  text += "SUBARCHITECTURE end localhost\nCPP WM SubarchitectureWorkingMemory\n"
          "CPP TM AlwaysPositiveTaskManager\nCPP UM closer Closer" +
          shared + "\n";
  return *cast::parse_string(text, "node_run.cast").architecture;
}

std::string describe(const NodesPlan& plan) {
  std::string result = "working memories on";
  for (auto x : plan.subarchitectures)
    result += " " + host(x);
  result += ", players of";
  for (auto& x : plan.players)
    result += " " + subarchitecture_name(x.home) + "@" + host(x.process);
  result += ", " + std::to_string(plan.entries) + " entries, leases of " +
            std::to_string(plan.lease.count()) + " ms, deadlines of " +
            std::to_string(plan.deadline.count()) + " ms";
  for (auto& x : plan.faults)
    result += ", " + to_string(x);
  return result;
}

/// A node and the way to it.
class RemoteNode {
public:
  RemoteNode(std::string executable, std::string name, NodeRunOptions options)
    : executable_(std::move(executable)), name_(std::move(name)), options_(std::move(options)) {
    start();
  }

  Endpoint address() const { return {"127.0.0.1", relay_.port()}; }
  test::Relay& relay() { return relay_; }
  bool is_alive() const { return process_ != nullptr; }

  void signal(int number) {
    if (process_)
      process_->send_signal(number);
  }

  void kill() {
    process_->send_signal(SIGKILL);
    process_->wait();
    process_.reset();
  }

  void start() {
    std::vector<std::string> arguments{executable_, "--serve", name_, "--patience",
                                       std::to_string(options_.patience.count()) + "ms"};
    if (!options_.certificates.empty())
      arguments.insert(arguments.end(), {"--tls", options_.certificates.string()});
    process_ = std::make_unique<test::Process>(std::move(arguments));
    if (!process_->wait_for_output("\n"))
      throw std::runtime_error("the node " + name_ + " did not start: " + process_->errors());
    relay_.lead_to(std::uint16_t(std::stoi(process_->output())));
  }

private:
  std::string executable_;
  std::string name_;
  NodeRunOptions options_;
  std::unique_ptr<test::Process> process_;
  test::Relay relay_{0};
};

std::optional<Credentials> credentials(const NodeRunOptions& options, const std::string& name) {
  if (options.certificates.empty())
    return std::nullopt;
  return Credentials::load(options.certificates / name);
}

} // namespace

void serve(const std::string& name, const NodeRunOptions& run_options) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  set_log_level(LogLevel::off);
  NodeOptions options;
  options.name = name;
  options.socket = listen_at({"127.0.0.1", 0});
  options.link = impatient(run_options.patience);
  // It is reached over a relay.
  options.insecure = true;
  options.credentials = credentials(run_options, name);
  std::printf("%d\n", port_of(options.socket));
  Node node{options};
  std::fflush(stdout);
  for (;;)
    pause();
}

class NodeRuns::Implementation {
public:
  Implementation(const std::string& executable, const NodeRunOptions& options) : options_(options) {
    for (std::size_t i = 1; i <= nodes; ++i)
      nodes_.push_back(std::make_unique<RemoteNode>(executable, host(i), options));
  }

  RealRunResult run(std::uint64_t seed, std::optional<Milliseconds> longest_fault) {
    // What is done to components and nodes on purpose is no news.
    set_log_level(LogLevel::off);
    auto plan = plan_for(seed, longest_fault);
    for (auto& x : nodes_)
      if (!x->is_alive())
        x->start();
    WorldSettings settings;
    settings.seed = seed;
    settings.players = plan.players.size();
    settings.pauses = 50;
    // So that operations go on for as long as faults do.
    settings.longest_pause = std::max<std::chrono::nanoseconds>(plan.end() / 15, 200us);
    settings.may_lose = options_.patience < ample_patience;
    for (std::size_t i = 0; i < plan.entries; ++i)
      settings.homes += subarchitecture_name(plan.home_of(i));
    World world{settings};
    RealRunResult result;
    result.description = describe(plan);
    try {
      play(plan, world, result.findings);
    } catch (const SystemError& e) {
      // Without patience, one that is slow to begin may be lost at once.
      if (!settings.may_lose)
        result.findings.push_back(std::string{"the system cannot be made: "} + e.what());
    }
    judge(result, world, plan.lease, ends_of_leases(world));
    check_kills(plan, result);
    return result;
  }

  const std::map<FaultKind, std::size_t>& faults() const { return faults_; }

private:
  void play(const NodesPlan& plan, World& world, std::vector<std::string>& findings) {
    killed_.clear();
    first_fault_ = never;
    SystemOptions options;
    options.open_access = true;
    options.insecure = true;
    options.restarts = false;
    options.link = impatient(options_.patience);
    options.credentials = credentials(options_, "run");
    for (std::size_t i = 1; i <= nodes; ++i)
      options.nodes[host(i)] = nodes_[i - 1]->address();
    System system{architecture(plan, world), options};
    system.start();
    auto until = Clock::now() + 60s;
    if (!await([&] { return world.all_have_entered(); }, until))
      findings.push_back("not all players have begun");
    disturb(plan, world);
    if (!await([&] { return world.all_have_left(); }, until))
      findings.push_back("the players did not come to an end within 60 s:" + who_is_left(world));
    world.let_close();
    if (!await([&] { return world.is_closed(); }, Clock::now() + 60s))
      findings.push_back("nobody could look at how the entries stand in the end");
    system.stop();
  }

  static std::string who_is_left(const World& world) {
    std::string result;
    for (Client x = 1; x <= world.settings().players; ++x)
      if (!world.has_left(x))
        result += " p" + std::to_string(x);
    return result;
  }

  /// Lets the faults happen, until they are over.
  void disturb(const NodesPlan& plan, World& world) {
    std::vector<std::pair<Milliseconds, std::function<void()>>> actions;
    for (auto& x : plan.faults) {
      actions.emplace_back(x.at, [&] { begin(x, plan, world); });
      if (x.kind == FaultKind::delay)
        actions.emplace_back(x.turn(), [&] { nodes_[x.node]->relay().freeze_present(); });
      if (lasts(x.kind))
        actions.emplace_back(x.end(), [&] { end(x); });
    }
    std::ranges::stable_sort(actions, {}, [](auto& x) { return x.first; });
    auto since = Clock::now();
    for (auto& [at, action] : actions) {
      std::this_thread::sleep_until(since + at);
      action();
    }
  }

  void begin(const Fault& x, const NodesPlan& plan, World& world) {
    auto& node = *nodes_[x.node];
    auto& relay = node.relay();
    if (!node.is_alive() || world.all_have_left())
      return;
    ++faults_[x.kind];
    first_fault_ = std::min(first_fault_, world.now());
    using Way = test::Relay::Way;
    switch (x.kind) {
      case FaultKind::stop:
        node.signal(SIGSTOP);
        break;
      case FaultKind::kill:
      case FaultKind::replace:
        kill(x, plan, world);
        break;
      case FaultKind::cut:
        relay.cut();
        break;
      case FaultKind::cut_one:
        relay.cut_one(x.choice);
        break;
      case FaultKind::freeze:
      case FaultKind::delay:
        relay.freeze(true);
        break;
      case FaultKind::freeze_one:
        relay.freeze_one(x.choice);
        break;
      case FaultKind::freeze_there:
        relay.freeze(Way::there, true);
        break;
      case FaultKind::freeze_back:
        relay.freeze(Way::back, true);
        break;
      case FaultKind::refuse:
        relay.refuse(true);
        break;
    }
  }

  /// Faults of one node end together.
  void end(const Fault& x) {
    auto& node = *nodes_[x.node];
    if (x.kind == FaultKind::stop)
      node.signal(SIGCONT);
    else if (x.kind == FaultKind::refuse)
      node.relay().refuse(false);
    else
      node.relay().freeze(false);
  }

  void kill(const Fault& x, const NodesPlan& plan, World& world) {
    auto process = x.node + 1;
    for (std::size_t i = 0; i < plan.players.size(); ++i)
      if (plan.players[i].process == process)
        world.leave(Client(i + 1));
    for (std::size_t i = 0; i < plan.subarchitectures.size(); ++i)
      if (plan.subarchitectures[i] == process)
        world.lose(subarchitecture_name(i));
    nodes_[x.node]->kill();
    killed_[process] = world.now();
    if (x.kind == FaultKind::replace)
      nodes_[x.node]->start();
  }

  /// When whoever is out of reach is lost, so are the leases that it holds.
  std::map<Client, Tick> ends_of_leases(const World& world) const {
    auto result = world.ends();
    if (world.settings().may_lose)
      for (Client x = 1; x <= world.settings().players; ++x)
        result[x] = first_fault_;
    return result;
  }

  /// Nobody answers for a working memory that was killed.
  void check_kills(const NodesPlan& plan, RealRunResult& result) const {
    for (auto& x : result.history) {
      auto killed = killed_.find(plan.subarchitectures[plan.home_of(x.entry)]);
      if (killed != killed_.end() && x.kind != OperationKind::lapse && !x.pending() &&
          x.invoked > killed->second)
        result.findings.push_back("answered though its working memory was killed at " +
                                  std::to_string(killed->second) + ": " + to_string(x));
    }
  }

  const NodeRunOptions options_;
  std::vector<std::unique_ptr<RemoteNode>> nodes_;
  std::map<FaultKind, std::size_t> faults_;
  Tick first_fault_ = never;
  /// When the processes were killed that were.
  std::map<std::size_t, Tick> killed_;
};

NodeRuns::NodeRuns(const std::string& executable, const NodeRunOptions& options)
  : implementation_(std::make_unique<Implementation>(executable, options)) {}

NodeRuns::~NodeRuns() = default;

RealRunResult NodeRuns::run(std::uint64_t seed, std::optional<Milliseconds> longest_fault) {
  return implementation_->run(seed, longest_fault);
}

const std::map<FaultKind, std::size_t>& NodeRuns::faults() const {
  return implementation_->faults();
}

} // namespace castor::linearizability
