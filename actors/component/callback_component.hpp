#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// A component that only reacts, and has no thread of its own: a rule, a neuron. Thousands of them
/// share a few threads, on which they never wait.
///
///     class Doubler : public CallbackComponent {
///       void start() override {
///         on_change(added<Number>(), [this](const ChangeEvent& event) {
///           read<Number>(event.address).then([this](EntryOf<Number> x) {
///             add(Doubled{2 * x->value});
///           });
///         });
///       }
///     };
///
/// It is configured, started, stopped and restarted like other components, and named in `UM` lines.
/// Its code is its callbacks: for change events, timers (`every`) and results of operations. No two
/// of them run at the same time, but they may run on different threads, so they must not keep data
/// in `thread_local` variables.
///
/// Operations return at once; what they return calls a function with the result (`Pending::then`).
/// If an operation fails, and `then` was not given a function for that, the component fails. The
/// next event or timer is called when all results of the operations of earlier callbacks were
/// called back: a callback and what follows from it are one step, as if it had waited. Meanwhile
/// others may write, as between any two operations. The system counts a component as started once
/// the results of the operations of its `start()` were called back, the registration of filters
/// among them, and as stopped once those of its `stop()` were.
///
/// Callbacks should be short. One that computes for long holds up none but its own component: the
/// runtime starts another thread for the others (ComponentPool). Past `--budget` it is reported, by
/// the name of the callback.
///
/// What waits is deleted here: leases, calls, actions, pulls, commands and sleeping need a thread,
/// as an UnmanagedComponent has one. Waiting in another way throws std::logic_error.
class CallbackComponent : public SubarchitectureComponent {
protected:
  // -- writing

  /// Adds an entry to the own working memory under a new id; the result is its address.
  template <ReflectedRecord T>
  Pending<Address> add(T object, EntryLife life = {}) {
    auto address = here(new_id());
    return add(address, std::move(object), life).map([address](Version) { return address; });
  }

  template <ReflectedRecord T>
  Pending<Version> add(const Address& address, T object, EntryLife life = {}) {
    return write_async(Operation::add, address, Value::of(std::move(object)), life);
  }

  /// Refused unless this component has seen the latest version; the result is the new one. Several
  /// overwrites of one entry may be on their way.
  template <ReflectedRecord T>
  Pending<Version> overwrite(const Address& address, T object) {
    return write_async(Operation::overwrite, address, Value::of(std::move(object)));
  }

  Pending<Version> delete_entry(const Address& address) {
    return write_async(Operation::remove, address, {});
  }

  /// Makes all writes of the batch or none, in one step; the result is the new versions, in the
  /// batch's order.
  Pending<std::vector<Version>> write(const WriteBatch& batch) { return operations().write(batch); }

  // -- reading

  template <ReflectedRecord T>
  Pending<EntryOf<T>> read(const Address& address) {
    return operations().read(address).map([this](const EntryPtr& x) { return typed<T>(x); });
  }

  /// The entries of type T, the most recently written first; at most `count`, unless that is 0.
  template <ReflectedRecord T>
  Pending<std::vector<EntryOf<T>>> read_all(std::size_t count = 0) {
    return read_all_in<T>(subarchitecture(), count);
  }

  template <ReflectedRecord T>
  Pending<std::vector<EntryOf<T>>> read_all_in(const std::string& subarchitecture_name,
                                               std::size_t count = 0) {
    return query<T>({subarchitecture_name, type_name<T>(), count, false});
  }

  /// The entries of type T, or of types that derive from it, whose content meets the predicate, the
  /// most recently written first.
  template <ReflectedRecord T>
  Pending<std::vector<EntryOf<T>>> read_where(PredicateOf<T> predicate, std::size_t count = 0) {
    return read_where_in<T>(subarchitecture(), std::move(predicate), count);
  }

  template <ReflectedRecord T>
  Pending<std::vector<EntryOf<T>>> read_where_in(const std::string& subarchitecture_name,
                                                 PredicateOf<T> predicate, std::size_t count = 0) {
    return query<T>({subarchitecture_name, type_name<T>(), count, true, std::move(predicate)});
  }

  Pending<bool> exists(const Address& address) { return operations().exists(address); }

  /// Current version of the entry; the last one if it was deleted.
  Pending<Version> version(const Address& address) { return operations().version(address); }

  // -- what waits

  template <class... Ts>
  void sleep_for(Ts&&...) = delete;
  template <class... Ts>
  void wait_for_changes(Ts&&...) = delete;
  template <class... Ts>
  void put(Ts&&...) = delete;
  template <class... Ts>
  void lock(Ts&&...) = delete;
  template <class... Ts>
  void try_lock(Ts&&...) = delete;
  template <class... Ts>
  void lock_entry(Ts&&...) = delete;
  template <class... Ts>
  void try_lock_entry(Ts&&...) = delete;
  template <class... Ts>
  void unlock_entry(Ts&&...) = delete;
  template <class... Ts>
  void is_overwritable(Ts&&...) = delete;
  template <class... Ts>
  void is_deletable(Ts&&...) = delete;
  template <class... Ts>
  void is_readable(Ts&&...) = delete;
  template <class... Ts>
  void perform(Ts&&...) = delete;
  template <class... Ts>
  void on_action(Ts&&...) = delete;
  template <class... Ts>
  void command(Ts&&...) = delete;
  template <class... Ts>
  void stream_command(Ts&&...) = delete;
  template <class... Ts>
  void add_async(Ts&&...) = delete;
  template <class... Ts>
  void overwrite_async(Ts&&...) = delete;
  template <class... Ts>
  void delete_entry_async(Ts&&...) = delete;
  template <class... Ts>
  void follow(...) = delete;
  template <class... Ts>
  void read_all_derived(...) = delete;
  template <class... Ts>
  void call(...) = delete;
  template <class... Ts>
  void on_call(...) = delete;
  template <class... Ts>
  void pull(...) = delete;
  template <class... Ts>
  void on_push(...) = delete;
  template <class... Ts>
  void read_async(...) = delete;

private:
  /// Everything that it does is a callback.
  void run() final {}

  template <ReflectedRecord T>
  Pending<std::vector<EntryOf<T>>> query(TypeQuery x) {
    return operations().query(std::move(x)).map([this](const std::vector<EntryPtr>& entries) {
      return typed<T>(entries);
    });
  }
};

} // namespace castor
