#include "castor/actors/component/component.hpp"

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/shell.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"

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

} // namespace

// -- Component

Component::Component() = default;
Component::~Component() = default;

ComponentShell& Component::shell() const {
  if (!shell_)
    throw std::logic_error("a component can do nothing before configure(): its constructor only "
                           "declares options");
  return *shell_;
}

void Component::attach(ComponentShell* shell) {
  shell_ = shell;
  log_name_ = shell->identity().full_name();
  own_log_level_ = debug_ ? LogLevel::trace : log_ ? LogLevel::debug : log_level();
}

const std::string& Component::component_name() const {
  return shell().identity().name;
}

bool Component::is_running() {
  return shell().is_running();
}

bool Component::sleep_for(std::chrono::nanoseconds duration) {
  return shell().deliver(ComponentShell::Clock::now() + duration);
}

Timestamp Component::now() const {
  return std::chrono::duration_cast<Timestamp>(std::chrono::steady_clock::now() -
                                               shell().services().epoch);
}

void Component::end_system(int status, std::string reason) {
  shell().services().end_system(status, log_name_ + ": " + reason);
}

Value Component::pull_value(const std::string& provider, const TypeDescriptorPtr& type) {
  return shell().pull(provider, type);
}

void Component::subscribe_to_pushes(const std::string& provider, const TypeDescriptorPtr& type,
                                    std::function<void(const Value&)> callback) {
  shell().subscribe(provider, type, std::move(callback));
}

void Component::wrong_pull(const std::string& provider, const TypeDescriptor& wanted,
                           const TypeDescriptor& got) {
  throw ConnectionError(provider + " sent a " + to_string(got) + " where " + to_string(wanted) +
                        " was expected");
}

// -- StandaloneComponent

void StandaloneComponent::provide_value(const TypeDescriptorPtr& type,
                                        std::function<Value()> make) {
  shell().provide(type, std::move(make));
}

void StandaloneComponent::push_value(Value x) {
  shell().push(x);
}

// -- SubarchitectureComponent

const std::string& SubarchitectureComponent::subarchitecture() const {
  return shell().identity().subarchitecture;
}

std::string SubarchitectureComponent::new_id() {
  return base62(ids_made_++) + ':' + base62(shell().identity().number);
}

Version SubarchitectureComponent::write(Operation operation, const Address& address, Value value) {
  return write_async(operation, address, std::move(value)).get();
}

Pending<Version> SubarchitectureComponent::write_async(Operation operation, const Address& address,
                                                       Value value) {
  auto& s = shell();
  auto last_seen = s.last_seen(address);
  auto id = s.begin(WriteRequest{operation,
                                 address,
                                 std::move(value),
                                 operation == Operation::overwrite ? last_seen : std::nullopt,
                                 {s.identity().name, s.identity().subarchitecture}});
  // The next operation in the pipeline counts on this one; should it fail, so will they.
  if (operation == Operation::overwrite && last_seen)
    s.saw(address, *last_seen + 1);
  auto claim = std::make_shared<Claim>(s, id);
  return Pending<Version>{[&s, claim, operation, address, last_seen] {
    auto outcome = s.finish<Version>(claim->take(), address);
    if (!outcome) {
      if (operation == Operation::overwrite && last_seen)
        s.saw(address, *last_seen);
      throw_failure(outcome.failure());
    }
    auto& counters = s.counters();
    switch (operation) {
      case Operation::add:
        ++counters.adds;
        s.saw(address, *outcome);
        break;
      case Operation::overwrite:
        ++counters.overwrites;
        break;
      case Operation::remove:
        ++counters.deletes;
        s.forget(address);
        break;
    }
    return *outcome;
  }};
}

EntryPtr SubarchitectureComponent::read_entry(const Address& address) {
  return read_entry_async(address).get();
}

Pending<EntryPtr> SubarchitectureComponent::read_entry_async(const Address& address) {
  auto& s = shell();
  auto claim = std::make_shared<Claim>(s, s.begin(ReadRequest{address}));
  return Pending<EntryPtr>{[&s, claim, address] {
    auto outcome = s.finish<EntryPtr>(claim->take(), address);
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
  Address where{query.subarchitecture, {}};
  auto entries = value_or_throw(s.finish<std::vector<EntryPtr>>(s.begin(query), where));
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
  auto id = "task:" + component_name() + ":" + std::to_string(++tasks_made_);
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
