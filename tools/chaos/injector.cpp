#include "castor/tools/chaos/injector.hpp"

#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/system/fault_port.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/chaos/connection_flood.hpp"
#include "castor/tools/chaos/journal_faults.hpp"
#include "castor/wm/journal/journal.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace castor::faults {

namespace {

/// The number of a process that takes part now.
std::optional<ProcessNumber> number_of(const SystemRoster& roster, const std::string& process) {
  if (process == coordinator)
    return ProcessNumber{0};
  for (std::size_t i = 1; i < roster.processes.size(); ++i)
    if (roster.processes[i].name == process && !roster.processes[i].lost)
      return static_cast<ProcessNumber>(i);
  return std::nullopt;
}

/// All that take part, the coordinator included.
std::vector<std::string> names_of(const SystemRoster& roster) {
  std::vector<std::string> result{std::string{coordinator}};
  for (std::size_t i = 1; i < roster.processes.size(); ++i)
    if (!roster.processes[i].lost)
      result.push_back(roster.processes[i].name);
  return result;
}

std::string not_there(const std::string& name) {
  return "there is no " + name + " in reach";
}

/// Injects the same fault into every link between the one and the other; false if there is none.
bool inject_into_links(System& system, const std::vector<std::string>& group,
                       const std::vector<std::string>& others, const LinkFault& fault) {
  auto roster = system.roster();
  bool found = false;
  for (auto& x : group)
    for (auto& y : others) {
      auto a = number_of(*roster, x);
      auto b = number_of(*roster, y);
      if (!a || !b || a == b)
        continue;
      system.faults().inject(*a, *b, fault);
      found = true;
    }
  return found;
}

} // namespace

Injector::Injector(InjectorParts parts, FaultSchedule schedule)
  : parts_(std::move(parts)), schedule_(std::move(schedule)), thread_([this] { work(); }) {}

Injector::~Injector() {
  stop();
}

void Injector::stop() {
  {
    std::lock_guard guard{mutex_};
    over_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable())
    thread_.join();
  for (auto& [time, f] : std::exchange(later_, {}))
    f();
}

std::vector<FaultRecord> Injector::records() const {
  std::lock_guard guard{mutex_};
  return records_;
}

void Injector::on_change(std::size_t filter) {
  std::lock_guard guard{mutex_};
  if (auto x = schedule_.on_change(filter, now()))
    due_.push_back(*std::move(x));
  changed_.notify_all();
}

void Injector::work() {
  std::unique_lock guard{mutex_};
  while (!over_) {
    auto next = schedule_.next_time().value_or(Timestamp::max());
    if (!later_.empty())
      next = std::min(next, later_.begin()->first);
    if (due_.empty() && next > now()) {
      changed_.wait_for(guard, std::min<Timestamp>(next - now(), std::chrono::seconds{1}));
      continue;
    }
    std::vector<DueFault> faults = std::exchange(due_, {});
    while (auto x = schedule_.next(now()))
      faults.push_back(*std::move(x));
    std::vector<std::function<void()>> calls;
    while (!later_.empty() && later_.begin()->first <= now()) {
      calls.push_back(std::move(later_.begin()->second));
      later_.erase(later_.begin());
    }
    guard.unlock();
    for (auto& f : calls)
      f();
    for (auto& x : faults)
      inject(x.fault);
    guard.lock();
  }
}

FaultRecord Injector::inject(const Fault& fault) {
  FaultRecord record;
  record.at = now();
  if (auto duration = duration_of(fault))
    record.until = record.at + *duration;
  record.kind = kind_of(fault);
  record.target = target_of(fault);
  record.fault = to_string(fault);
  record.state = FaultState::armed;
  std::unique_lock guard{mutex_};
  auto index = records_.size();
  records_.push_back(record);
  missed_.push_back(missed_occasion(fault));
  if (auto crash = std::get_if<Crash>(&fault))
    armed_crashes_.emplace(crash->component.name, index);
  guard.unlock();
  auto outcome = std::visit(
    [&](auto& x) {
      if constexpr (requires { this->apply(x, index + 1); })
        return apply(x, index + 1);
      else
        return apply(x);
    },
    fault);
  guard.lock();
  auto& result = records_[index];
  result.outcome = outcome.text;
  result.violation = outcome.violation;
  if (!outcome.done) {
    result.state = FaultState::not_injected;
    log_runtime(LogLevel::info, "faults", "not injected: " + result.fault + ": " + result.outcome);
  } else if (!missed_[index]) {
    happened(result);
  } else if (result.state == FaultState::armed) {
    log_runtime(LogLevel::info, "faults", "armed: " + result.fault);
  }
  return result;
}

void Injector::happened(FaultRecord& x) {
  x.state = FaultState::happened;
  x.happened = now();
  log_runtime(LogLevel::info, "faults",
              "happened: " + x.fault + (x.outcome.empty() ? "" : ": " + x.outcome));
}

void Injector::on_happened(std::uint64_t fault) {
  std::lock_guard guard{mutex_};
  auto& record = records_.at(fault - 1);
  if (record.state == FaultState::armed)
    happened(record);
}

void Injector::on_down(const std::string& component) {
  std::lock_guard guard{mutex_};
  auto [begin, end] = armed_crashes_.equal_range(component);
  for (auto i = begin; i != end; ++i)
    if (auto& record = records_[i->second]; record.state == FaultState::armed)
      happened(record);
  armed_crashes_.erase(begin, end);
}

void Injector::conclude() {
  std::lock_guard guard{mutex_};
  for (std::size_t i = 0; i < records_.size(); ++i) {
    auto& record = records_[i];
    if (record.state != FaultState::armed)
      continue;
    record.state = FaultState::never;
    record.outcome = missed_[i];
    log_runtime(LogLevel::info, "faults",
                "never triggered: " + record.fault + ": " + record.outcome);
  }
}

Timestamp Injector::lasting(const Lasting& x) const {
  return x.value_or(std::chrono::hours{1000});
}

void Injector::when_over(const Lasting& x, std::function<void()> f) {
  std::lock_guard guard{mutex_};
  later_.emplace(now() + lasting(x), std::move(f));
  changed_.notify_all();
}

namespace {

template <class Outcome>
Outcome inject_into_component(System& system, const ComponentTarget& target,
                              const ComponentFault& x) {
  if (!system.faults().inject(target.name, x))
    return {false, not_there("component " + target.name)};
  return {};
}

} // namespace

Injector::Outcome Injector::apply(const Crash& x) {
  return inject_into_component<Outcome>(*parts_.system, x.component, {});
}

Injector::Outcome Injector::apply(const Throw& x, std::uint64_t number) {
  ComponentFault fault{ComponentFault::Kind::failure};
  fault.callback = x.callback;
  fault.ticket.number = number;
  return inject_into_component<Outcome>(*parts_.system, x.component, fault);
}

Injector::Outcome Injector::apply(const Hang& x, std::uint64_t number) {
  ComponentFault fault{ComponentFault::Kind::hang};
  fault.by = lasting(x.duration);
  fault.ticket.number = number;
  return inject_into_component<Outcome>(*parts_.system, x.component, fault);
}

Injector::Outcome Injector::apply(const Block& x, std::uint64_t number) {
  ComponentFault fault{x.phase == Block::Phase::start ? ComponentFault::Kind::blocked_start
                                                      : ComponentFault::Kind::blocked_configure};
  fault.by = lasting(x.duration);
  fault.ticket.number = number;
  return inject_into_component<Outcome>(*parts_.system, x.component, fault);
}

Injector::Outcome Injector::apply(const Slow& x, std::uint64_t number) {
  ComponentFault fault{ComponentFault::Kind::slowness};
  fault.by = x.by;
  fault.duration = lasting(x.duration);
  fault.ticket.number = number;
  return inject_into_component<Outcome>(*parts_.system, x.component, fault);
}

bool Injector::with_process(const std::string& name, const std::function<void(pid_t)>& f) const {
  if (name != coordinator)
    return parts_.with_process && parts_.with_process(name, f);
  f(getpid());
  return true;
}

Injector::Outcome Injector::signal(const std::string& process, int signal) {
  if (!parts_.with_process || !parts_.with_process(process, [signal](pid_t x) { kill(x, signal); }))
    return {false, not_there("process " + process)};
  return {};
}

Injector::Outcome Injector::apply(const Kill& x) {
  return signal(x.process.name, SIGKILL);
}

Injector::Outcome Injector::apply(const Stop& x) {
  auto outcome = signal(x.process.name, SIGSTOP);
  when_over(x.duration, [this, name = x.process.name] { signal(name, SIGCONT); });
  return outcome;
}

Injector::Outcome Injector::apply(const Continue& x) {
  return signal(x.process.name, SIGCONT);
}

Injector::Outcome Injector::apply(const UseUpDescriptors& x) {
  pid_t process = 0;
  Outcome outcome;
  auto begin = [&](pid_t number) {
    try {
      shortages_.begin(number);
      process = number;
    } catch (const std::system_error& e) {
      outcome = {false, e.what()};
    }
  };
  if (!with_process(x.process.name, begin))
    return {false, not_there("process " + x.process.name)};
  if (!outcome.done)
    return outcome;
  when_over(x.duration, [this, name = x.process.name, process] { end_shortage(name, process); });
  return outcome;
}

void Injector::end_shortage(const std::string& name, pid_t process) {
  bool ended = false;
  with_process(name, [&](pid_t present) {
    ended = present == process;
    if (ended)
      shortages_.end(process);
  });
  if (!ended)
    shortages_.forget(process);
  if (name == coordinator)
    for (auto& child : names_of(*parts_.system->roster()))
      if (child != coordinator)
        with_process(child, [this](pid_t x) { shortages_.raise_inherited(x); });
}

Injector::Outcome Injector::apply(const Flood& x) {
  auto roster = parts_.system->roster();
  auto number = number_of(*roster, x.process.name);
  if (!number || *number == 0)
    return {false, not_there("process " + x.process.name)};
  auto& process = roster->processes[*number];
  auto flood = std::make_shared<ConnectionFlood>(Endpoint{process.host, process.port}, x.rate);
  when_over(x.duration, [flood, name = x.process.name] {
    auto counts = flood->stop();
    log_runtime(LogLevel::info, "faults",
                "flood " + name + " is over: " + std::to_string(counts.connected) +
                  " connections, and " + std::to_string(counts.failed) + " that could not be made");
  });
  return {};
}

Injector::Outcome Injector::apply(const Partition& x, std::uint64_t number) {
  auto others = x.from;
  if (others.empty()) {
    others = names_of(*parts_.system->roster());
    std::erase_if(others, [&](auto& name) {
      return std::find(x.group.begin(), x.group.end(), name) != x.group.end();
    });
  }
  if (!inject_into_links(*parts_.system, x.group, others,
                         {LinkFault::Kind::silence, lasting(x.duration), {}, 0, {number}}))
    return {false, "there is no link between them"};
  return {};
}

Injector::Outcome Injector::apply(const Delay& x, std::uint64_t number) {
  if (!inject_into_links(*parts_.system, {x.link.first}, {x.link.second},
                         {LinkFault::Kind::delay, lasting(x.duration), x.by, 0, {number}}))
    return {false, "there is no such link"};
  return {};
}

Injector::Outcome Injector::apply(const Drop& x, std::uint64_t number) {
  LinkFault fault{LinkFault::Kind::loss, lasting(x.duration)};
  fault.part = x.part.thousandths * 10;
  fault.ticket.number = number;
  if (!inject_into_links(*parts_.system, {x.link.first}, {x.link.second}, fault))
    return {false, "there is no such link"};
  return {};
}

namespace {

/// What the transport does not let happen.
constexpr const char* only_simulated =
  "links are streams, in which nothing comes twice or out of order: this can be simulated only";

} // namespace

Injector::Outcome Injector::apply(const Duplicate&) {
  return {false, only_simulated};
}

Injector::Outcome Injector::apply(const Reorder&) {
  return {false, only_simulated};
}

Injector::Outcome Injector::inject_into_journal(const MemoryTarget& memory, const JournalFault& x) {
  if (!parts_.system->faults().inject(memory.subarchitecture, x))
    return {false, not_there("working memory of " + memory.subarchitecture)};
  return {};
}

Injector::Outcome Injector::apply(const FailJournal& x, std::uint64_t number) {
  return inject_into_journal(x.memory,
                             {JournalFault::Kind::failure, lasting(x.duration), {}, {number}});
}

Injector::Outcome Injector::apply(const SlowJournal& x, std::uint64_t number) {
  return inject_into_journal(x.memory,
                             {JournalFault::Kind::slowness, lasting(x.duration), x.by, {number}});
}

Injector::Outcome Injector::apply(const RemoveJournal& x) {
  auto journal = parts_.journals.find(x.memory.subarchitecture);
  if (journal == parts_.journals.end())
    return {false, not_there("journal of " + x.memory.subarchitecture)};
  try {
    return {true, "its files are now " + remove_journal(journal->second).string()};
  } catch (const std::runtime_error& e) {
    return {false, e.what()};
  }
}

Injector::Outcome Injector::apply(const ClaimJournal& x) {
  auto journal = parts_.journals.find(x.memory.subarchitecture);
  if (journal == parts_.journals.end())
    return {false, not_there("journal of " + x.memory.subarchitecture)};
  try {
    auto claim = claim_journal(journal->second, x.memory.subarchitecture);
    switch (claim.kind) {
      case JournalClaim::Kind::refused:
        return {true, "it was refused: " + claim.reason};
      case JournalClaim::Kind::free:
        return {false, "nobody writes " + journal->second.string() + " just now"};
      case JournalClaim::Kind::taken:
        break;
    }
    auto what = "another system was given the journal " + journal->second.string() +
                ", which this one was writing";
    return {true, what, what};
  } catch (const JournalError& e) {
    return {false, e.what()};
  }
}

Injector::Outcome Injector::apply(const JumpClock& x) {
  if (!parts_.system->faults().jump_clock(x.memory.subarchitecture, x.by))
    return {false, not_there("working memory of " + x.memory.subarchitecture)};
  return {};
}

} // namespace castor::faults
