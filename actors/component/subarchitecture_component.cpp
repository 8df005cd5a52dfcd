#include "castor/actors/component/subarchitecture_component.hpp"

#include "castor/actors/component/component_runtime.hpp"

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

} // namespace

const std::string& SubarchitectureComponent::subarchitecture() const {
  return runtime().identity().subarchitecture;
}

Operations& SubarchitectureComponent::operations() const {
  return runtime().operations();
}

std::string SubarchitectureComponent::new_id() {
  auto& self = runtime().identity();
  auto run = runtime().run();
  auto result = fmt::format("{}:{}", base62(ids_made_++), base62(self.number));
  // Those that it made in former lives may still be there, and those of former runs of which there
  // are journals.
  if (self.incarnation > 1 || run != 0)
    result += fmt::format(":{}", base62(self.incarnation));
  return run == 0 ? result : fmt::format("{}:{}", result, base62(run));
}

// -- writing

Pending<Version> SubarchitectureComponent::write_async(Operation operation, const Address& address,
                                                       Value value, std::optional<EntryLife> life) {
  return operations().write(operation, address, std::move(value), life);
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
  return operations().write(batch).get();
}

// -- reading

EntryPtr SubarchitectureComponent::read_entry(const Address& address) {
  return operations().read_now(address);
}

Pending<EntryPtr> SubarchitectureComponent::read_entry_async(const Address& address) {
  return operations().read(address);
}

std::vector<EntryPtr> SubarchitectureComponent::read_entries(TypeQuery query) {
  return operations().query(std::move(query)).get();
}

bool SubarchitectureComponent::exists(const Address& address) {
  return operations().exists(address).get();
}

Version SubarchitectureComponent::version(const Address& address) {
  return operations().version(address).get();
}

const Address& SubarchitectureComponent::require_target(const Address& address) const {
  if (address.id.empty())
    throw BadAddressException{
      {FailureKind::bad_address, component_name() + " follows a pointer that is not set", address}};
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

void SubarchitectureComponent::wrong_type(const Entry& entry, const TypeDescriptor& wanted) const {
  throw TypeMismatchException{{FailureKind::wrong_type,
                               component_name() + " reads " + to_string(entry.address) + " as a " +
                                 wanted.name() + ", but " + entry.writer + " put a " +
                                 entry.type_name() + " there",
                               entry.address}};
}

// -- calls

Calls& SubarchitectureComponent::calls() {
  if (!calls_)
    calls_ = runtime().make_calls(*this);
  return *calls_;
}

Actions& SubarchitectureComponent::actions() {
  if (!actions_)
    actions_ = runtime().make_actions(*this);
  return *actions_;
}

void SubarchitectureComponent::wrong_reply(const TypeDescriptor& got,
                                           const TypeDescriptor& wanted) const {
  throw TypeMismatchException{{FailureKind::wrong_type,
                               component_name() + " got a " + got.name() + " as reply where a " +
                                 wanted.name() + " was expected",
                               {}}};
}

// -- leases

void SubarchitectureComponent::lock_entry(const Address& address, LockLevel level,
                                          std::optional<std::chrono::nanoseconds> timeout) {
  operations().lock(address, level, timeout);
}

bool SubarchitectureComponent::try_lock_entry(const Address& address, LockLevel level) {
  return operations().try_lock(address, level);
}

void SubarchitectureComponent::unlock_entry(const Address& address) {
  operations().unlock(address);
}

LockGuard SubarchitectureComponent::guard(const Address& address) const {
  return {operations(), address, operations().lease(address)};
}

bool SubarchitectureComponent::is_overwritable(const Address& address) {
  return !operations().level_of_others(address);
}

bool SubarchitectureComponent::is_deletable(const Address& address) {
  return operations().level_of_others(address).value_or(LockLevel::o) == LockLevel::o;
}

bool SubarchitectureComponent::is_readable(const Address& address) {
  return operations().level_of_others(address).value_or(LockLevel::o) != LockLevel::odr;
}

// -- change events

ReceiverId SubarchitectureComponent::on_change(const ChangeFilter& filter, ChangeCallback callback,
                                               Priority priority) {
  return operations().add_receiver(filter, std::move(callback), priority);
}

void SubarchitectureComponent::remove_receiver(ReceiverId id) {
  operations().remove_receiver(id);
}

std::size_t SubarchitectureComponent::receiver_count() const {
  return operations().receiver_count();
}

bool SubarchitectureComponent::wait_for_changes(std::optional<std::chrono::nanoseconds> timeout) {
  auto& r = runtime();
  auto before = r.callbacks();
  r.deliver(timeout, [&] { return r.callbacks() > before; });
  return r.callbacks() > before && r.is_running();
}

void SubarchitectureComponent::receive_changes(bool on) {
  operations().receive_changes(on);
}

} // namespace castor
