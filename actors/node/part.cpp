#include "castor/actors/node/part.hpp"

#include "castor/actors/component/callback_component.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/node/incarnation.hpp"
#include "castor/actors/node/threads.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/actors/runtime/keeper.hpp"
#include "castor/actors/runtime/plugin.hpp"
#include "castor/actors/runtime/pooled_shell.hpp"
#include "castor/actors/runtime/shell.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/entries/client.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace castor {

namespace {

/// The working memory that tells of the system's health, which no file names.
const ComponentDescription& health_working_memory() {
  static const auto result = [] {
    ComponentDescription x;
    x.kind = ComponentKind::working_memory;
    x.subarchitecture = health_subarchitecture;
    x.name = working_memory_of(x.subarchitecture);
    x.class_name = WorkingMemoryClass::name;
    return x;
  }();
  return result;
}

/// Calls `f` with every component that the plan gives to a process, in the order of the file. The
/// system's health is kept beside its supervisor.
template <class F>
void for_each_own(const PartPlan& plan, ProcessNumber self, F&& f) {
  for_each_component(plan.architecture, [&](const ComponentDescription& x) {
    if (process_of(plan.placement, x.name) == self)
      f(x);
  });
  if (plan.supervisor && self == 0)
    f(health_working_memory());
}

caf::resumable* as_resumable(const WorkingMemoryActor& x) {
  return dynamic_cast<caf::resumable*>(caf::actor_cast<caf::abstract_actor*>(x));
}

JournalOptions journal_options(const WorkingMemoryClass& wm_class,
                               const std::string& subarchitecture, const PartPlan& plan,
                               std::uint64_t incarnation) {
  auto result = wm_class.journal_of(subarchitecture);
  result.system = plan.system;
  result.returning = incarnation > 1;
  result.report = [](const std::string& what) { log_runtime(LogLevel::error, what); };
  return result;
}

bool has_thread(const ComponentDescription& x) {
  auto* found = find_class(x.class_name).found;
  return !found || found->has_thread;
}

/// In bytes.
std::size_t largest_value(const WorkingMemoryClass& x) {
  return static_cast<std::size_t>(x.largest_entry.get()) << 20;
}

/// The journal that a WM line asks for; null if it asks for none.
std::shared_ptr<OpenedJournal> take_up_journal(const ComponentDescription& x,
                                               const PartSpawn& spawn, const PartPlan& plan,
                                               std::uint64_t incarnation,
                                               std::vector<Diagnostic>& problems) {
  auto options = journal_options(WorkingMemoryClass{x}, x.subarchitecture, plan, incarnation);
  if (options.mode == JournalMode::off)
    return nullptr;
  try {
    auto result = std::make_shared<OpenedJournal>(spawn.journal(options, x.subarchitecture));
    return result->file || !result->failure.empty() ? result : nullptr;
  } catch (const JournalError& e) {
    problems.push_back({Severity::error, x.where, x.line, {}, x.name + ": " + e.what(), {}});
    return nullptr;
  }
}

/// How many bytes a process may take to record what its stand-alone components hand out; 0 if there
/// is nothing to record.
std::uint64_t share_of_pushes(const PartPlan& plan, ProcessNumber self) {
  if (plan.pushes.empty())
    return 0;
  auto& all = plan.architecture.standalone;
  auto own =
    std::ranges::count_if(all, [&](auto& x) { return process_of(plan.placement, x.name) == self; });
  return own == 0 ? 0 : plan.pushes_limit / all.size() * static_cast<std::uint64_t>(own);
}

/// The folder for it is there, if this process needs one.
void make_folder_for_pushes(const PartPlan& plan, ProcessNumber self,
                            std::vector<Diagnostic>& problems) {
  if (share_of_pushes(plan, self) == 0)
    return;
  std::error_code error;
  std::filesystem::create_directories(plan.pushes, error);
  if (error)
    problems.push_back(
      {Severity::error,
       plan.architecture.standalone.front().where,
       {},
       {},
       "cannot make the folder of the recording, " + plan.pushes + ": " + error.message(),
       "record into a folder that can be made on every machine"});
}

} // namespace

PartSpawn::PartSpawn()
  : working_memory([](caf::actor_system& system, WorkingMemoryOptions options) {
      return system.spawn(castor::working_memory, std::move(options));
    }),
    component([](caf::actor_system& system, ShellParts parts) -> caf::actor {
      if (dynamic_cast<CallbackComponent*>(parts.component.get()))
        return system.spawn<PooledShell>(std::move(parts));
      return system.spawn<ComponentShell>(std::move(parts));
    }),
    why_no_threads(castor::why_no_threads) {}

std::vector<Diagnostic> SystemPart::apply(const PartPlan& plan,
                                          std::chrono::steady_clock::time_point arrived) {
  std::vector<Diagnostic> problems;
  std::map<std::string, std::uint64_t> wanted;
  std::vector<const ComponentDescription*> missing;
  std::map<std::string, std::uint64_t> here;
  for (auto& x : residents())
    here[x.name] = x.incarnation;
  const SystemNames names{plan.architecture};
  for_each_own(plan, self_, [&](const ComponentDescription& x) {
    auto life = plan.incarnations.find(x.name);
    auto& incarnation = wanted[x.name] = life == plan.incarnations.end() ? 1 : life->second;
    auto i = here.find(x.name);
    if (i != here.end() && i->second == incarnation)
      return;
    missing.push_back(&x);
    check_class(x, names, problems);
  });
  if (!problems.empty())
    return problems;
  // Before anything is made: what a journal holds may be what is in the way.
  std::map<std::string, std::shared_ptr<OpenedJournal>> journals;
  for (auto* x : missing)
    if (x->kind == ComponentKind::working_memory)
      journals[x->subarchitecture] =
        take_up_journal(*x, spawn_, plan, wanted.at(x->name), problems);
  make_folder_for_pushes(plan, self_, problems);
  check_threads(missing, problems);
  if (!problems.empty())
    return problems;
  begin(plan, arrived);
  end_others(wanted);
  for (auto* x : missing)
    if (x->kind == ComponentKind::working_memory)
      spawn_working_memory(plan, *x, wanted.at(x->name), journals[x->subarchitecture]);
  list_working_memories();
  for (auto* x : missing)
    if (x->kind != ComponentKind::working_memory)
      spawn_component(*x, wanted.at(x->name));
  return problems;
}

void SystemPart::check_threads(const std::vector<const ComponentDescription*>& missing,
                               std::vector<Diagnostic>& problems) const {
  std::size_t count = 0;
  const ComponentDescription* last = nullptr;
  for (auto* x : missing)
    if (x->kind != ComponentKind::working_memory && has_thread(*x)) {
      ++count;
      last = x;
    }
  if (count == 0 || !spawn_.why_no_threads)
    return;
  if (auto problem = spawn_.why_no_threads(count); !problem.empty())
    problems.push_back({Severity::error,
                        last->where,
                        last->line,
                        {},
                        "each component has a thread of its own: " + problem,
                        "derive those that only have callbacks from CallbackComponent"});
}

void SystemPart::list_working_memories() {
  auto& known = services_->working_memories.emplace_back();
  for (auto& [name, x] : working_memories_)
    known.push_back(as_resumable(x.actor));
  std::sort(known.begin(), known.end());
}

void SystemPart::restart(const std::string& component, std::uint64_t incarnation) {
  auto* x = architecture_.component(component);
  if (!x)
    return;
  std::erase_if(running_, [&](auto& y) {
    if (y.record->identity().name != component)
      return false;
    caf::anon_send_exit(y.actor, caf::exit_reason::user_shutdown);
    return true;
  });
  if (auto problem =
        spawn_.why_no_threads && has_thread(*x) ? spawn_.why_no_threads(1) : std::string{};
      !problem.empty()) {
    log_runtime(LogLevel::error, component, problem);
    return;
  }
  spawn_component(*x, incarnation);
  if (!neighbours_)
    return;
  caf::anon_send(running_.back().actor, neighbours_);
  spawn_keeper();
}

void SystemPart::begin(const PartPlan& plan, std::chrono::steady_clock::time_point arrived) {
  architecture_ = plan.architecture;
  temporary_ = plan.temporary;
  open_access_ = plan.open_access;
  supervisor_ = plan.supervisor;
  auto keeps_journals = false;
  largest_values_.clear();
  for (auto& x : architecture_.subarchitectures) {
    WorkingMemoryClass wm_class{x.working_memory};
    largest_values_[x.name] = largest_value(wm_class);
    keeps_journals = keeps_journals || wm_class.journal != JournalMode::off;
  }
  if (services_->run == 0 && keeps_journals)
    services_->run = new_incarnation() >> 32;
  if (!services_->working_memories.empty())
    return;
  services_->epoch = arrived - plan.age;
  services_->broadcast = plan.broadcast;
  if (!plan.operations.empty())
    services_->operations = std::make_unique<OperationLog>(plan.operations);
  if (auto own = share_of_pushes(plan, self_); own > 0)
    services_->pushes = std::make_unique<PushRecorder>(plan.pushes, own);
  coordinator_ = plan.coordinator;
  task_observer_ = plan.task_observer;
  services_->end_system =
    [to = caf::actor_cast<caf::actor_addr>(coordinator_)](int status, const std::string& reason) {
      if (auto actor = caf::actor_cast<caf::actor>(to))
        caf::anon_send(actor, EndSystem{status, reason});
    };
  if (task_observer_)
    services_->on_task = [to = caf::actor_cast<caf::actor_addr>(task_observer_)](TaskEvent x) {
      if (auto actor = caf::actor_cast<caf::actor>(to))
        caf::anon_send(actor, std::move(x));
    };
}

void SystemPart::end_others(const std::map<std::string, std::uint64_t>& wanted) {
  auto is_wanted = [&](const std::string& name, std::uint64_t incarnation) {
    auto i = wanted.find(name);
    return i != wanted.end() && i->second == incarnation;
  };
  std::erase_if(running_, [&](auto& x) {
    auto& identity = x.record->identity();
    if (is_wanted(identity.name, identity.incarnation))
      return false;
    caf::anon_send_exit(x.actor, caf::exit_reason::user_shutdown);
    return true;
  });
  std::erase_if(working_memories_, [&](auto& x) {
    if (is_wanted(working_memory_of(x.first), x.second.incarnation))
      return false;
    services_->readable_memories.remove(x.first);
    caf::anon_send_exit(x.second.actor, caf::exit_reason::user_shutdown);
    return true;
  });
}

SystemPart::~SystemPart() {
  caf::anon_send_exit(keeper_, caf::exit_reason::user_shutdown);
  for (auto& x : running_)
    caf::anon_send_exit(x.actor, caf::exit_reason::user_shutdown);
  for (auto& [name, x] : working_memories_)
    caf::anon_send_exit(x.actor, caf::exit_reason::user_shutdown);
}

void SystemPart::spawn_working_memory(const PartPlan& plan, const ComponentDescription& x,
                                      std::uint64_t incarnation,
                                      std::shared_ptr<OpenedJournal> journal) {
  WorkingMemoryClass wm_class{x};
  auto& name = x.subarchitecture;
  WorkingMemoryOptions options;
  options.subarchitecture = name;
  options.ignored = {wm_class.ignore->begin(), wm_class.ignore->end()};
  options.epoch = services_->epoch;
  options.clock = services_->clock;
  options.broadcast = plan.broadcast;
  options.without_components = health_subarchitecture;
  options.leases.duration = wm_class.lease.get();
  // Nobody hangs while others run, and renewals would change the order in which they do.
  if (is_one_at_a_time())
    options.leases.duration = std::chrono::hours{24 * 365 * 100};
  options.store.largest_value = largest_value(wm_class);
  options.writers = writers(name);
  options.readers = architecture_.readers(name);
  options.incarnation = incarnation;
  options.journal = journal_options(wm_class, name, plan, incarnation);
  options.opened_journal = std::move(journal);
  // What a journal may lose in a crash is told to nobody before it is safe there.
  if (options.journal.mode == JournalMode::off) {
    options.store.entries = std::make_shared<EntryTable>();
    services_->readable_memories.set(name, {options.store.entries, options.readers});
  }
  auto actor = spawn_.working_memory(system_, std::move(options));
  working_memories_[name] = {actor, incarnation};
  // It may meet the unit of the component that ran it last until its own end.
  caf::actor_cast<caf::abstract_actor*>(actor)->attach_functor([services = services_] {});
}

void SystemPart::spawn_component(const ComponentDescription& x, std::uint64_t incarnation) {
  ShellParts parts;
  parts.component = find_class(x.class_name).found->make();
  for (auto& setting : x.options)
    parts.component->options().set(setting.name(), setting.value);
  parts.record = std::make_shared<ComponentRecord>(ComponentIdentity{
    x.name, x.subarchitecture, x.class_name, static_cast<std::uint32_t>(x.number), incarnation});
  parts.services = services_;
  if (x.where.line() > 0)
    parts.where = to_string(x.where);
  parts.unit = services_->units.emplace_back(std::make_unique<CallerRuns>(system_)).get();
  parts.unit->set_working_memories(&services_->working_memories.back());
  auto record = parts.record;
  running_.push_back({spawn_.component(system_, std::move(parts)), std::move(record),
                      x.kind == ComponentKind::task_manager});
}

std::vector<SystemPart::Resident> SystemPart::residents() const {
  std::vector<Resident> result;
  for (auto& [name, x] : working_memories_)
    result.push_back({working_memory_of(name), x.incarnation,
                      caf::actor_cast<caf::strong_actor_ptr>(x.actor), nullptr});
  for (auto& x : running_)
    result.push_back({x.record->identity().name, x.record->identity().incarnation,
                      caf::actor_cast<caf::strong_actor_ptr>(x.actor), x.record});
  return result;
}

std::map<std::string, WorkingMemoryActor> SystemPart::working_memories() const {
  std::map<std::string, WorkingMemoryActor> result;
  for (auto& [name, x] : working_memories_)
    result[name] = x.actor;
  return result;
}

std::map<std::string, caf::strong_actor_ptr> SystemPart::actors() const {
  std::map<std::string, caf::strong_actor_ptr> result;
  for (auto& x : residents())
    result[x.name] = x.actor;
  return result;
}

std::map<std::string, caf::strong_actor_ptr>
SystemPart::subarchitectures(const std::map<std::string, caf::strong_actor_ptr>& actors) const {
  std::map<std::string, caf::strong_actor_ptr> result;
  for (auto& x : architecture_.subarchitectures)
    if (auto i = actors.find(x.working_memory.name); i != actors.end())
      result[x.name] = i->second;
  if (auto i = actors.find(health_working_memory().name); i != actors.end())
    result[health_subarchitecture] = i->second;
  return result;
}

std::set<std::string>
SystemPart::absent(const std::map<std::string, caf::strong_actor_ptr>& working_memories) const {
  std::set<std::string> result;
  for (auto& x : architecture_.subarchitectures)
    if (working_memories.count(x.name) == 0)
      result.insert(x.name);
  return result;
}

std::set<std::string> SystemPart::writers(const std::string& subarchitecture) const {
  std::set<std::string> result;
  if (open_access_)
    result.insert("*");
  for (auto& rule : architecture_.access_rules)
    if (rule.writer != operators && (rule.owner == subarchitecture || rule.owner == "*"))
      result.insert(rule.writer);
  if (architecture_.may_write(operators, subarchitecture))
    result.emplace(operators);
  else if (result.erase("*") > 0)
    // All subarchitectures, but not operators.
    for (auto& x : architecture_.subarchitectures)
      result.insert(x.name);
  return result;
}

void SystemPart::join(const std::map<std::string, caf::strong_actor_ptr>& actors) {
  auto neighbours = std::make_shared<Neighbours>();
  for (auto& [name, actor] : subarchitectures(actors))
    neighbours->working_memories[name] = caf::actor_cast<WorkingMemoryActor>(actor);
  for (auto& x : architecture_.subarchitectures)
    if (auto i = actors.find(x.task_manager.name); i != actors.end())
      neighbours->task_managers[x.name] = caf::actor_cast<caf::actor>(i->second);
  for (auto& x : architecture_.standalone) {
    neighbours->known_providers.emplace(x.name, !temporary_.contains(x.name));
    if (auto i = actors.find(x.name); i != actors.end())
      neighbours->providers[x.name] = caf::actor_cast<caf::actor>(i->second);
  }
  neighbours_ = std::move(neighbours);
  for (auto& x : running_)
    caf::anon_send(x.actor, neighbours_);
  spawn_keeper();
}

void SystemPart::spawn_keeper() {
  caf::anon_send_exit(std::exchange(keeper_, nullptr), caf::exit_reason::user_shutdown);
  KeeperParts parts;
  for (auto& x : running_)
    parts.components.push_back(x.record);
  if (!is_one_at_a_time())
    parts.working_memories = neighbours_->working_memories;
  parts.on_overrun = [to = supervisor_](const Overrun& x) {
    auto& identity = x.component->identity();
    caf::anon_send(to, ComponentHangs{identity.name, identity.incarnation});
  };
  keeper_ = system_.spawn(keeper, std::move(parts));
}

std::vector<ComponentStatus> SystemPart::components() const {
  std::vector<ComponentStatus> result;
  auto now = ComponentRecord::Clock::now();
  for (auto& x : running_) {
    result.push_back(status_of(*x.record, now));
    result.back().is_task_manager = x.is_task_manager;
  }
  return result;
}

} // namespace castor
