#include "castor/actors/component/component.hpp"

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/shell.hpp"

#include <stdexcept>
#include <utility>

namespace castor {

namespace {

/// Least significant digit first, as the original writes its ids.
std::string base62(std::uint64_t x) {
  static constexpr char digits[] = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  std::string result;
  do {
    result += digits[x % 62];
    x /= 62;
  } while (x > 0);
  return result;
}

/// Gives a reply's slot back when nobody takes the reply.
class Claim {
public:
  Claim(ComponentShell& shell, std::uint64_t id) : shell_(shell), id_(id) {}
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  ~Claim() {
    if (id_ != 0)
      shell_.abandon(id_);
  }

  std::uint64_t take() { return std::exchange(id_, 0); }

private:
  ComponentShell& shell_;
  std::uint64_t id_;
};

/// For what any thread may ask.
ComponentShell& attached(ComponentShell* shell) {
  if (!shell)
    throw std::logic_error("a component can do nothing before configure(): its constructor only "
                           "declares options");
  return *shell;
}

} // namespace

// -- Component

Component::Component() = default;
Component::~Component() = default;

ComponentShell& Component::shell() const {
  auto& result = attached(shell_);
  if (!result.is_own_thread())
    throw std::logic_error(result.identity().full_name() +
                           " was used by another thread than its own. Let that thread put what it "
                           "has into a queue of yours, and run() take it from there");
  return result;
}

void Component::attach(ComponentShell* shell) {
  shell_ = shell;
  log_name_ = shell->identity().full_name();
  own_log_level_ = debug_ ? LogLevel::trace : log_ ? LogLevel::debug : log_level();
}

const std::string& Component::component_name() const {
  return attached(shell_).identity().name;
}

bool Component::is_running() {
  return shell().is_running();
}

bool Component::sleep_for(std::chrono::nanoseconds duration) {
  return shell().deliver(ComponentShell::Clock::now() + duration);
}

Timestamp Component::now() const {
  return attached(shell_).now();
}

void Component::end_component() {
  throw ComponentStopped{};
}

void Component::end_system(int status, std::string reason) {
  shell().services().end_system(status, log_name_ + ": " + reason);
}

Value Component::pull_value(const std::string& provider, const TypeDescriptorPtr& type) {
  return shell().connections().pull(provider, type);
}

void Component::subscribe_to_pushes(const std::string& provider, const TypeDescriptorPtr& type,
                                    std::function<void(const Value&)> callback) {
  shell().connections().subscribe(provider, type, std::move(callback));
}

void Component::wrong_pull(const std::string& provider, const TypeDescriptor& wanted,
                           const TypeDescriptor& got) {
  throw ConnectionError(provider + " sent a " + to_string(got) + " where " + to_string(wanted) +
                        " was expected");
}

// -- StandaloneComponent

void StandaloneComponent::provide_value(const TypeDescriptorPtr& type,
                                        std::function<Value()> make) {
  shell().connections().provide(type, std::move(make));
}

void StandaloneComponent::push_value(Value x) {
  shell().connections().push(x);
}

// -- SubarchitectureComponent

const std::string& SubarchitectureComponent::subarchitecture() const {
  return shell().identity().subarchitecture;
}

std::string SubarchitectureComponent::new_id() {
  auto& self = shell().identity();
  auto run = shell().services().run.load();
  auto result = fmt::format("{}:{}", base62(ids_made_++), base62(self.number));
  // Those that it made in former lives may still be there, and those of former runs of which there
  // are journals.
  if (self.incarnation > 1 || run != 0)
    result += fmt::format(":{}", base62(self.incarnation));
  return run == 0 ? result : fmt::format("{}:{}", result, base62(run));
}

namespace {

WriteRequest write_request(ComponentShell& s, Operation operation, const Address& address,
                           Value value, std::optional<EntryLife> life) {
  auto seen = operation == Operation::overwrite ? s.last_seen(address) : std::nullopt;
  // What has to be encoded on its way is encoded here: in the own working memory, which hands it
  // on, others would wait for that.
  if (operation != Operation::remove && address.subarchitecture != s.identity().subarchitecture &&
      s.is_in_another_process(address.subarchitecture))
    value.bytes();
  return {operation,
          address,
          std::move(value),
          seen ? std::optional{seen->version} : std::nullopt,
          s.client(),
          s.leases().token(address),
          life,
          seen && seen->expected};
}

/// What a component remembers of a write that was made.
void note_write(ComponentShell& s, Operation operation, const Address& address, Version version) {
  auto& counters = s.counters();
  switch (operation) {
    case Operation::add:
      ++counters.adds;
      s.saw(address, version);
      break;
    case Operation::overwrite:
      ++counters.overwrites;
      s.saw(address, version);
      break;
    case Operation::remove:
      ++counters.deletes;
      s.forget(address);
      s.leases().forget(address);
      break;
  }
}

} // namespace

Pending<Version> SubarchitectureComponent::write_async(Operation operation, const Address& address,
                                                       Value value, std::optional<EntryLife> life) {
  auto& s = shell();
  auto request = write_request(s, operation, address, std::move(value), life);
  auto last_seen = request.last_seen;
  auto expected = request.expected;
  auto id = s.begin(request);
  // The next operation in the pipeline counts on this one; should it fail, so will they.
  if (last_seen)
    s.saw(address, *last_seen + 1, true);
  auto claim = std::make_shared<Claim>(s, id);
  return Pending<Version>{[&s, claim, operation, address, last_seen, expected] {
    auto seen_meanwhile = s.last_seen(address);
    auto outcome = s.finish<Version>(claim->take(), address);
    if (!outcome) {
      if (last_seen && seen_meanwhile && seen_meanwhile->expected &&
          seen_meanwhile->version > *last_seen)
        s.saw(address, *last_seen, expected);
      throw_failure(outcome.failure());
    }
    note_write(s, operation, address, *outcome);
    // Of several overwrites in flight, the latest counts.
    if (operation == Operation::overwrite && seen_meanwhile && seen_meanwhile->version > *outcome)
      s.saw(address, seen_meanwhile->version, seen_meanwhile->expected);
    return *outcome;
  }};
}

void SubarchitectureComponent::put_value(const Address& address, const Value& value) {
  for (;;)
    try {
      write_async(Operation::overwrite, address, value).get();
      return;
    } catch (const DoesNotExistOnWM&) {
      try {
        write_async(Operation::add, address, value).get();
        return;
      } catch (const AlreadyExistsOnWM&) {
        continue; // somebody was faster
      }
    } catch (const ConsistencyException&) {
      try {
        read_entry(address);
      } catch (const DoesNotExistOnWM&) {
        continue; // or has deleted it since
      }
    }
}

std::vector<Version> SubarchitectureComponent::write(const WriteBatch& batch) {
  auto& items = batch.items();
  if (items.empty())
    return {};
  auto& s = shell();
  BatchRequest request{items.front().address.subarchitecture, {}};
  for (auto& x : items)
    request.writes.push_back(write_request(s, x.operation, x.address, x.value, x.life));
  auto versions =
    value_or_throw(s.finish<std::vector<Version>>(s.begin(request), {request.subarchitecture, {}}));
  for (std::size_t i = 0; i < items.size(); ++i)
    note_write(s, items[i].operation, items[i].address, versions[i]);
  return versions;
}

EntryPtr SubarchitectureComponent::read_entry(const Address& address) {
  return read_entry_async(address).get();
}

Pending<EntryPtr> SubarchitectureComponent::read_entry_async(const Address& address) {
  auto& s = shell();
  auto patience = s.patience(s.deadline());
  auto claim = std::make_shared<Claim>(s, s.begin(ReadRequest{address, patience}));
  return Pending<EntryPtr>{[&s, claim, address, patience] {
    WaitEdge wait;
    wait.kind = WaitEdge::Kind::read;
    wait.address = address;
    wait.what = "waits to read " + to_string(address);
    auto outcome = s.finish_wait<EntryPtr>(claim->take(), std::move(wait), patience);
    if (!outcome) {
      if (outcome.failure().kind == FailureKind::does_not_exist)
        s.forget(address);
      throw_failure(outcome.failure());
    }
    ++s.counters().reads;
    s.saw(address, (*outcome)->version);
    return *outcome;
  }};
}

std::vector<EntryPtr> SubarchitectureComponent::read_entries(TypeQuery query) {
  auto& s = shell();
  WaitEdge wait;
  wait.kind = WaitEdge::Kind::read;
  wait.address = {query.subarchitecture, {}};
  wait.what = "waits to read every " + query.type + " of " + query.subarchitecture;
  auto patience = s.patience(s.deadline());
  auto entries = value_or_throw(s.finish_wait<std::vector<EntryPtr>>(
    s.begin(QueryRequest{std::move(query), patience}), std::move(wait), patience));
  s.counters().reads += entries.size();
  for (auto& entry : entries)
    s.saw(entry->address, entry->version);
  return entries;
}

bool SubarchitectureComponent::exists(const Address& address) {
  auto& s = shell();
  return value_or_throw(s.finish<bool>(s.begin(ExistsQuery{address}), address));
}

Version SubarchitectureComponent::version(const Address& address) {
  auto& s = shell();
  return value_or_throw(s.finish<Version>(s.begin(VersionQuery{address}), address));
}

const Address& SubarchitectureComponent::require_target(const Address& address) const {
  if (address.id.empty())
    throw BadAddressException{{FailureKind::bad_address,
                               component_name() + " follows a pointer that leads nowhere",
                               address}};
  return address;
}

Predicate SubarchitectureComponent::parse_predicate(std::string_view text,
                                                    const TypeDescriptor& type) {
  try {
    auto result = Predicate::parse(text);
    result.check(type);
    return result;
  } catch (const std::runtime_error& e) {
    throw PredicateException{{FailureKind::bad_predicate, e.what(), {}}};
  }
}

Calls& SubarchitectureComponent::calls() {
  if (!calls_)
    calls_ = std::make_unique<Calls>(*this, shell());
  return *calls_;
}

void SubarchitectureComponent::wrong_reply(const TypeDescriptor& got,
                                           const TypeDescriptor& wanted) const {
  throw TypeMismatchException{{FailureKind::wrong_type,
                               component_name() + " was replied a " + got.name() + " where a " +
                                 wanted.name() + " was expected",
                               {}}};
}

// leases

void SubarchitectureComponent::lock_entry(const Address& address, LockLevel level,
                                          std::optional<std::chrono::nanoseconds> timeout) {
  auto& s = shell();
  auto patience = s.patience(timeout.value_or(s.deadline()));
  WaitEdge wait;
  wait.kind = WaitEdge::Kind::lock;
  wait.address = address;
  wait.what = "waits to lock " + to_string(address);
  auto lease = value_or_throw(s.finish_wait<Lease>(s.begin(LockRequest{address, level, patience}),
                                                   std::move(wait), patience));
  s.leases().add(address, lease.token);
}

bool SubarchitectureComponent::try_lock_entry(const Address& address, LockLevel level) {
  auto& s = shell();
  auto outcome = s.finish<Lease>(s.begin(LockRequest{address, level, s.patience({})}), address);
  if (!outcome && outcome.failure().kind == FailureKind::leased)
    return false;
  s.leases().add(address, value_or_throw(std::move(outcome)).token);
  return true;
}

void SubarchitectureComponent::unlock_entry(const Address& address) {
  auto& s = shell();
  auto token = s.leases().token(address);
  if (token != 0 && s.leases().release(address, token))
    value_or_throw(s.try_unlock(address, token));
}

LockGuard SubarchitectureComponent::guard(const Address& address) const {
  auto& s = shell();
  return {s, address, s.leases().token(address)};
}

std::optional<LockLevel> SubarchitectureComponent::foreign_lease(const Address& address) {
  auto& s = shell();
  auto status = value_or_throw(s.finish<LockStatus>(s.begin(LockQuery{address}), address));
  return status.holder && !(*status.holder == *s.client()) ? status.level : std::nullopt;
}

bool SubarchitectureComponent::is_overwritable(const Address& address) {
  return !foreign_lease(address);
}

bool SubarchitectureComponent::is_deletable(const Address& address) {
  return foreign_lease(address).value_or(LockLevel::o) == LockLevel::o;
}

bool SubarchitectureComponent::is_readable(const Address& address) {
  return foreign_lease(address).value_or(LockLevel::o) != LockLevel::odr;
}

void SubarchitectureComponent::wrong_type(const Entry& entry, const TypeDescriptor& wanted) const {
  throw TypeMismatchException{{FailureKind::wrong_type,
                               component_name() + " reads " + to_string(entry.address) + " as a " +
                                 wanted.name() + ", but " + entry.writer + " put a " +
                                 entry.type_name() + " there",
                               entry.address}};
}

ReceiverId SubarchitectureComponent::on_change(const ChangeFilter& filter, ChangeCallback callback,
                                               Priority priority) {
  return shell().add_receiver(filter, std::move(callback), priority);
}

void SubarchitectureComponent::remove_receiver(ReceiverId id) {
  shell().remove_receiver(id);
}

std::size_t SubarchitectureComponent::receiver_count() const {
  return shell().receiver_count();
}

bool SubarchitectureComponent::wait_for_changes(std::optional<std::chrono::nanoseconds> timeout) {
  auto& s = shell();
  auto before = s.callbacks();
  auto patience = timeout.value_or(std::chrono::hours{24 * 365});
  s.deliver(ComponentShell::Clock::now() + patience, [&] { return s.callbacks() > before; });
  return s.callbacks() > before && s.is_running();
}

void SubarchitectureComponent::receive_changes(bool on) {
  shell().receive_changes(on);
}

// -- ManagedComponent

TaskId ManagedComponent::propose_task(const std::string& name, TaskOptions options) {
  return propose_task(name, nullptr, std::move(options));
}

TaskId ManagedComponent::propose_task(const std::string& name, std::function<void()> work,
                                      TaskOptions options) {
  auto& self = shell().identity();
  // The tasks of a former life are others.
  auto life = self.incarnation == 1 ? std::string{} : fmt::format(".{}", self.incarnation);
  auto id = fmt::format("task:{}{}:{}", self.name, life, ++tasks_made_);
  tasks_[id] = std::move(work);
  shell().propose({id, name, component_name(), std::move(options)});
  return id;
}

void ManagedComponent::retract_task(const TaskId& id) {
  if (tasks_.erase(id) > 0)
    shell().retract(id);
}

void ManagedComponent::complete_task(const TaskId& id, TaskOutcome outcome) {
  if (tasks_.erase(id) > 0)
    shell().complete(id, outcome);
}

void ManagedComponent::decided(const TaskDecided& x) {
  auto& id = x.id;
  auto i = tasks_.find(id);
  if (i == tasks_.end())
    return; // retracted meanwhile
  switch (x.decision) {
    case TaskDecision::waiting:
      debug("{} has to wait: {}", id, x.reason);
      break;
    case TaskDecision::rejected:
      debug("{} is rejected: {}", id, x.reason);
      tasks_.erase(i);
      task_rejected(id);
      break;
    case TaskDecision::adopted:
      if (auto work = i->second) {
        try {
          work();
        } catch (const std::exception&) {
          complete_task(id, TaskOutcome::failure);
          throw;
        }
        complete_task(id, TaskOutcome::success);
      } else {
        task_adopted(id);
      }
      break;
  }
}

} // namespace castor
