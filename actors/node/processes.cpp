#include "castor/actors/node/processes.hpp"

#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/well_known_actors.hpp"
#include "castor/base/log.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;

/// How often a wait is interrupted to see whether it should go on.
constexpr std::chrono::milliseconds poll_interval{50};

/// At the first line that needs the process.
Diagnostic out_of_reach(const ArchitectureDescription& architecture, const Placement& placement,
                        ProcessNumber number, const Processes::State& x) {
  auto at = to_string(Endpoint{x.description.host, x.description.port});
  Diagnostic result;
  result.message = "cannot reach the node " +
                   (x.description.name.empty() ? at : x.description.name + " at " + at) + ": " +
                   x.reason;
  const auto& name = x.description.name;
  result.remedy = "start it there with `castor node" + (name.empty() ? "" : " --name " + name) +
                  "`, or try the system on this machine with "
                  "`castor run --local-nodes`";
  for_each_component(architecture, [&](const ComponentDescription& component) {
    if (placement.process_of(component.name) == number && result.line.empty()) {
      result.where = component.where;
      result.line = component.line;
    }
  });
  return result;
}

} // namespace

Processes::Processes(caf::actor_system& system, const SystemOptions& options, std::string name,
                     std::function<void(const LinkNews&)> on_news)
  : Processes(system, options, std::move(name), std::move(on_news),
              system.has_middleman() ? spawn_link : LinkSpawn{}) {}

Processes::Processes(caf::actor_system& system, const SystemOptions& options, std::string name,
                     std::function<void(const LinkNews&)> on_news, LinkSpawn spawn)
  : system_(system), options_(options), name_(std::move(name)), on_news_(std::move(on_news)),
    spawn_(std::move(spawn)), incarnation_(new_incarnation()),
    messages_(std::make_shared<PartMessages>(system_messages())) {
  processes_.emplace_back();
  processes_.front().news.state = LinkState::up;
  if (spawn_)
    mesh_ = std::make_shared<Mesh>(system_, messages_, ProcessNumber{0});
}

void Processes::set_own_agent(const caf::actor& agent) {
  std::lock_guard guard{mutex_};
  processes_.front().agent = agent;
}

caf::actor Processes::agent(ProcessNumber x) const {
  std::lock_guard guard{mutex_};
  return processes_[x].agent;
}

ProcessNumber Processes::look_for_successor(ProcessNumber lost) {
  auto description = state(lost).description;
  description.lost = false;
  return open_link(description);
}

void Processes::connect(const ArchitectureDescription& architecture, const Placement& placement) {
  auto first = size();
  if (placement.processes.size() <= first)
    return;
  if (!mesh_)
    throw SystemError{{out_of_reach(
      architecture, placement, static_cast<ProcessNumber>(first),
      {placement.processes[first], LinkState::down, "the system was started without a network"})}};
  check_security(architecture, placement, first);
  open(placement);
  try {
    await_connections(architecture, placement, first);
  } catch (const SystemError&) {
    // Their numbers are not used again.
    std::lock_guard guard{mutex_};
    for (auto i = first; i < processes_.size(); ++i) {
      processes_[i].news.state = LinkState::lost;
      processes_[i].description = {};
      caf::anon_send(processes_[i].link, CloseLink{"the system goes on without it"});
    }
    throw;
  }
}

void Processes::open(const Placement& placement) {
  for (auto i = size(); i < placement.processes.size(); ++i)
    open_link(placement.processes[i]);
}

void Processes::check_security(const ArchitectureDescription& architecture,
                               const Placement& placement, std::size_t first) const {
  if (options_.credentials || options_.insecure)
    return;
  std::vector<Diagnostic> problems;
  for (auto i = first; i < placement.processes.size(); ++i) {
    auto& x = placement.processes[i];
    if (is_loopback(x.host))
      continue;
    auto reason = why_unknown(x.host);
    bool is_known = reason.empty();
    if (is_known)
      reason = "connections with other machines have to be encrypted";
    problems.push_back(out_of_reach(architecture, placement, static_cast<ProcessNumber>(i),
                                    {x, LinkState::down, reason}));
    if (is_known)
      problems.back().remedy = "name a certificate with --tls DIR (scripts/make-certs makes some), "
                               "or use --insecure";
  }
  if (!problems.empty())
    throw SystemError{std::move(problems)};
}

ProcessNumber Processes::open_link(const ProcessDescription& description) {
  LinkParts parts;
  {
    std::lock_guard guard{mutex_};
    parts.peer = static_cast<ProcessNumber>(processes_.size());
    auto& x = processes_.emplace_back();
    x.description = description;
    x.news.peer = parts.peer;
  }
  auto number = parts.peer;
  parts.mesh = mesh_;
  parts.peer_name = description.name;
  parts.dial = Endpoint{description.host, description.port};
  parts.self.node = options_.credentials ? options_.credentials->names().front()
                                         : "castor-" + std::to_string(getpid());
  parts.self.system = name_;
  parts.self.incarnation = incarnation_;
  secure(parts, options_.credentials, options_.insecure);
  parts.options = options_.link;
  parts.on_news = [this](const LinkNews& news) { on_link_news(news); };
  auto link = spawn_(std::move(parts));
  std::lock_guard guard{mutex_};
  processes_[number].link = link;
  processes_[number].agent =
    caf::actor_cast<caf::actor>(mesh_->well_known(number, part_agent_number));
  return number;
}

void Processes::on_link_news(const LinkNews& news) {
  {
    std::lock_guard guard{mutex_};
    if (news.peer >= processes_.size())
      return;
    auto& x = processes_[news.peer];
    x.news = news;
    if (!news.name.empty())
      x.description.name = news.name;
    if (x.joined && !silent_) {
      if (news.state == LinkState::up)
        log_runtime(LogLevel::info, "node " + news.name + " is in reach again");
      else
        log_runtime(LogLevel::warning,
                    "node " + news.name +
                      (news.state == LinkState::lost ? " is lost: " : " is out of reach: ") +
                      news.reason);
    }
    x.joined = x.joined || news.state == LinkState::up;
    if (news.state == LinkState::up)
      x.last_up = Clock::now();
    changed_.notify_all();
  }
  on_news_(news);
}

void Processes::await_connections(const ArchitectureDescription& architecture,
                                  const Placement& placement, std::size_t first) {
  auto until = Clock::now() + options_.connect_patience;
  std::unique_lock guard{mutex_};
  auto begin = processes_.begin() + static_cast<std::ptrdiff_t>(first);
  auto settled = [&] {
    return std::all_of(begin, processes_.end(),
                       [](auto& x) { return x.news.state != LinkState::down; });
  };
  while (!settled() && Clock::now() < until && !interrupted())
    changed_.wait_for(guard, poll_interval);
  std::vector<Diagnostic> problems;
  for (auto i = first; i < processes_.size(); ++i) {
    auto& x = processes_[i];
    if (x.news.state != LinkState::up)
      problems.push_back(out_of_reach(architecture, placement, static_cast<ProcessNumber>(i),
                                      {x.description, x.news.state, x.news.reason}));
  }
  if (!problems.empty())
    throw SystemError{std::move(problems)};
}

std::size_t Processes::size() const {
  std::lock_guard guard{mutex_};
  return processes_.size();
}

Processes::State Processes::state(ProcessNumber x) const {
  std::lock_guard guard{mutex_};
  auto& process = processes_[x];
  return {process.description, process.news.state, process.news.reason};
}

Clock::time_point Processes::last_up(ProcessNumber x) const {
  std::lock_guard guard{mutex_};
  return processes_[x].last_up;
}

std::vector<ProcessDescription> Processes::descriptions() const {
  std::lock_guard guard{mutex_};
  std::vector<ProcessDescription> result;
  for (auto& x : processes_) {
    result.push_back(x.description);
    result.back().lost = x.news.state == LinkState::lost;
  }
  return result;
}

void Processes::suppress_notifications() {
  std::lock_guard guard{mutex_};
  silent_ = true;
}

void Processes::close(const std::string& reason) {
  std::vector<caf::actor> links;
  std::unique_lock guard{mutex_};
  for (auto& x : processes_) {
    if (x.link)
      caf::anon_send(x.link, CloseLink{reason});
    links.push_back(x.link);
  }
  guard.unlock();
  if (mesh_)
    mesh_->close();
  await_ends(system_, links);
}

} // namespace castor
