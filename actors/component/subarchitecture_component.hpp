#pragma once

#include "castor/actors/component/action_handle.hpp"
#include "castor/actors/component/actions.hpp"
#include "castor/actors/component/calls.hpp"
#include "castor/actors/component/component.hpp"
#include "castor/actors/component/entry_pointer.hpp"
#include "castor/actors/component/lock_guard.hpp"
#include "castor/actors/component/operations.hpp"
#include "castor/actors/component/pending.hpp"
#include "castor/actors/component/write_batch.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/entries/lease.hpp"
#include "castor/wm/events/event_flow.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/predicate_builder.hpp"
#include "castor/wm/store/type_query.hpp"

#include <chrono>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace castor {

/// An entry of a known type, as it stood when it was read.
template <ReflectedRecord T>
struct EntryOf {
  Address address;
  Version version = 0;
  /// The component that wrote it.
  std::string writer;
  std::shared_ptr<const T> object;

  const T& operator*() const { return *object; }
  const T* operator->() const { return object.get(); }
};

/// A component of a subarchitecture. It communicates with other ones over working memory only.
///
/// Operations take effect in the working memory that owns the entry, in one step, and return when
/// that has happened. They throw the exceptions of failure.hpp, and ComponentStopped if the
/// component is told to stop meanwhile. An overwrite is refused unless the component has seen the
/// latest version: by reading it or by having written it.
class SubarchitectureComponent : public Component {
protected:
  const std::string& subarchitecture() const;

  /// An id that no other component of the system makes.
  std::string new_id();

  /// Address of an entry of the own subarchitecture.
  Address here(std::string id) const { return {subarchitecture(), std::move(id)}; }

  // -- writing

  /// Adds an entry to the own working memory under a new id. `life` may limit its life:
  ///
  ///     add(Sighting{...}, {.time_to_live = 5s});
  template <ReflectedRecord T>
  Address add(T object, EntryLife life = {}) {
    auto address = here(new_id());
    add(address, std::move(object), life);
    return address;
  }

  template <ReflectedRecord T>
  void add(const Address& address, T object, EntryLife life = {}) {
    write_async(Operation::add, address, Value::of(std::move(object)), life).get();
  }

  /// Returns the new version.
  template <ReflectedRecord T>
  Version overwrite(const Address& address, T object) {
    return overwrite_async(address, std::move(object)).get();
  }

  /// Adds the entry, or overwrites it regardless of its content and writer.
  template <ReflectedRecord T>
  void put(const Address& address, T object) {
    put_value(address, Value::of(std::move(object)));
  }

  void delete_entry(const Address& address) { delete_entry_async(address).get(); }

  /// Makes all writes of the batch or none, in one step: nobody sees a part of them. Returns the
  /// new versions, in the batch's order.
  std::vector<Version> write(const WriteBatch& batch);

  // -- reading

  template <ReflectedRecord T>
  EntryOf<T> read(const Address& address) {
    return typed<T>(read_entry(address));
  }

  /// The entries of type T, the most recently written first; at most `count`, unless that is 0.
  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_all(std::size_t count = 0) {
    return read_all_in<T>(subarchitecture(), count);
  }

  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_all_in(const std::string& subarchitecture_name,
                                      std::size_t count = 0) {
    return typed<T>(read_entries({subarchitecture_name, type_name<T>(), count, false}));
  }

  /// The entries of type T and of all types that derive from it.
  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_all_derived(const std::string& subarchitecture_name,
                                           std::size_t count = 0) {
    return typed<T>(read_entries({subarchitecture_name, type_name<T>(), count, true}));
  }

  /// The entry that a pointer refers to. Throws BadAddressException if the pointer is not set.
  template <ReflectedRecord T>
  EntryOf<T> follow(const EntryPointer<T>& pointer) {
    return read<T>(require_target(pointer.address));
  }

  /// The entries of type T, or of types that derive from it, whose content meets the predicate, the
  /// most recently written first. The working memory that holds them evaluates it.
  ///
  ///     read_where<SceneObject>(field(&SceneObject::confidence) > 0.8)
  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_where(PredicateOf<T> predicate, std::size_t count = 0) {
    return read_where_in<T>(subarchitecture(), std::move(predicate), count);
  }

  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_where_in(const std::string& subarchitecture_name,
                                        PredicateOf<T> predicate, std::size_t count = 0) {
    return typed<T>(
      read_entries({subarchitecture_name, type_name<T>(), count, true, std::move(predicate)}));
  }

  /// The same, for a predicate as text: `confidence > 0.8 && label == "box"`. Throws
  /// PredicateException if it is not a predicate over T.
  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_where(std::string_view predicate, std::size_t count = 0) {
    return read_where_in<T>(subarchitecture(), predicate, count);
  }

  template <ReflectedRecord T>
  std::vector<EntryOf<T>> read_where_in(const std::string& subarchitecture_name,
                                        std::string_view predicate, std::size_t count = 0) {
    return typed<T>(read_entries({subarchitecture_name, type_name<T>(), count, true,
                                  parse_predicate(predicate, *descriptor_of<T>())}));
  }

  bool exists(const Address& address);

  /// Current version of the entry; the last one if it was deleted.
  Version version(const Address& address);

  // -- leases

  /// Waits for the lease of the entry, which keeps others from writing, deleting or reading it,
  /// depending on the level, until the guard is destroyed. A component may lock an entry
  /// repeatedly. Throws DoesNotExistOnWM if the entry is deleted meanwhile, DeadlineException, and
  /// DeadlockException if the wait would close a cycle of waits.
  LockGuard lock(const Address& address, LockLevel level,
                 std::optional<std::chrono::nanoseconds> timeout = {}) {
    lock_entry(address, level, timeout);
    return guard(address);
  }

  /// The same without waiting; nothing if another component holds a lease.
  std::optional<LockGuard> try_lock(const Address& address, LockLevel level) {
    if (!try_lock_entry(address, level))
      return std::nullopt;
    return guard(address);
  }

  /// Without a guard: every lock is to be followed by an unlock.
  void lock_entry(const Address& address, LockLevel level,
                  std::optional<std::chrono::nanoseconds> timeout = {});
  bool try_lock_entry(const Address& address, LockLevel level);

  /// Does nothing if the component has not locked the entry. Throws LeaseLostException if the lease
  /// had ended before, DoesNotExistOnWM if the entry was deleted.
  void unlock_entry(const Address& address);

  /// Whether the leases of others permit this operation now.
  bool is_overwritable(const Address& address);
  bool is_deletable(const Address& address);
  bool is_readable(const Address& address);

  // -- calls over working memory

  /// Calls a component of another subarchitecture (or of this one), and waits for its reply.
  /// Request and reply are entries, visible to everybody. Throws CallException if the server fails,
  /// with its error text, or ends; DeadlineException; DeadlockException if the server waits for
  /// this component.
  template <ReflectedRecord Request, ReflectedRecord Reply>
  Reply call(const std::string& subarchitecture_name, Request request, CallOptions options = {}) {
    auto value = calls().call(subarchitecture_name, Value::of(std::move(request)),
                              *descriptor_of<Reply>(), options);
    auto reply = value.template as<Reply>();
    if (!reply)
      wrong_reply(value.type(), *descriptor_of<Reply>());
    return *reply;
  }

  /// Serves calls with requests of that type, including those already waiting: `handler` is called
  /// with each and returns the reply. An exception that it throws reaches the caller as
  /// CallException; this component continues.
  template <ReflectedRecord Request, std::invocable<const Request&> F>
  void on_call(F handler) {
    using Reply = std::invoke_result_t<F, const Request&>;
    calls().serve(*descriptor_of<Request>(), *descriptor_of<Reply>(),
                  [handler = std::move(handler)](const Value& request) {
                    return Value::of(handler(*request.template as<Request>()));
                  });
  }

  /// Inside a handler of `on_call`: whether the caller has ended or waits no longer.
  bool call_cancelled() const { return calls_ && calls_->is_cancelled(); }

  // -- actions over working memory

  /// Asks a component of another subarchitecture (or of this one) for an action, and returns at
  /// once. `what` and an `Action` are entries here, visible to everybody. If this component ends,
  /// the action is cancelled, unless the options say that it continues.
  ///
  ///     auto action = perform("manipulation", PickAndPlace{...});
  ///     if (action.wait(1min).outcome == ActionOutcome::succeeded) ...
  template <ReflectedRecord T>
  [[nodiscard]] ActionHandle perform(const std::string& subarchitecture_name, T what,
                                     const ActionOptions& options = {}) {
    auto address = actions().request(subarchitecture_name, Value::of(std::move(what)), options);
    return {*actions_, std::move(address)};
  }

  /// Executes actions whose specific entry is a T, including those already waiting: `handler` is
  /// called with each, one after the other, and returns an ActionResult. It may take long; it looks
  /// at `cancelled()` while it works. No action is executed twice. If `handler` throws, the action
  /// has failed, and this component continues; if this component ends, it has failed, too.
  template <ReflectedRecord T, std::invocable<ActionInProgress&, const T&> F>
  void on_action(F handler, ActionOffer offer = {}) {
    actions().offer(*descriptor_of<T>(), std::move(offer),
                    [handler = std::move(handler)](ActionInProgress& action, const Value& what) {
                      auto object = what.template as<T>();
                      if (!object)
                        return ActionResult::failed("requester and executor declare " +
                                                    what.type_name() + " differently");
                      return handler(action, *object);
                    });
  }

  // -- pipelining: the same operations, without waiting for each

  template <ReflectedRecord T>
  Pending<Version> add_async(const Address& address, T object) {
    return write_async(Operation::add, address, Value::of(std::move(object)));
  }

  template <ReflectedRecord T>
  Pending<Version> overwrite_async(const Address& address, T object) {
    return write_async(Operation::overwrite, address, Value::of(std::move(object)));
  }

  Pending<Version> delete_entry_async(const Address& address) {
    return write_async(Operation::remove, address, {});
  }

  template <ReflectedRecord T>
  Pending<EntryOf<T>> read_async(const Address& address) {
    return read_entry_async(address).map([this](const EntryPtr& entry) { return typed<T>(entry); });
  }

  // -- change events

  /// Calls `callback` for every event that matches `filter`, from now on. May be called at any time
  /// from `start()` on, also from inside a callback.
  ReceiverId on_change(const ChangeFilter& filter, ChangeCallback callback,
                       Priority priority = Priority::medium);

  /// No further calls of that callback, from this moment on. Unknown ids are ignored.
  void remove_receiver(ReceiverId id);

  std::size_t receiver_count() const;

  /// Delivers the events that have arrived; if there are none, waits for one. True once a callback
  /// was called, false after the timeout or if the component was told to stop. An event that
  /// arrived before the call counts.
  bool wait_for_changes(std::optional<std::chrono::nanoseconds> timeout = {});

  /// Switches the delivery of change events off and on; what arrives while it is off is dropped.
  void receive_changes(bool on);

private:
  friend class ActionExecution;
  friend class ActionExecutor;
  friend class ActionRequester;
  friend class CallbackComponent;
  friend class ComponentCalls;
  friend class ComponentShell;

  Pending<Version> write_async(Operation operation, const Address& address, Value value,
                               std::optional<EntryLife> life = {});
  void put_value(const Address& address, const Value& value);
  Operations& operations() const;
  LockGuard guard(const Address& address) const;
  const Address& require_target(const Address& address) const;
  EntryPtr read_entry(const Address& address);
  Pending<EntryPtr> read_entry_async(const Address& address);
  std::vector<EntryPtr> read_entries(TypeQuery query);
  [[noreturn]] void wrong_type(const Entry& entry, const TypeDescriptor& wanted) const;

  template <ReflectedRecord T>
  EntryOf<T> typed(const EntryPtr& entry) const {
    auto object = entry->value.as<T>();
    if (!object)
      wrong_type(*entry, *descriptor_of<T>());
    return {entry->address, entry->version, entry->writer, std::move(object)};
  }

  template <ReflectedRecord T>
  std::vector<EntryOf<T>> typed(const std::vector<EntryPtr>& entries) const {
    std::vector<EntryOf<T>> result;
    result.reserve(entries.size());
    for (auto& entry : entries)
      result.push_back(typed<T>(entry));
    return result;
  }

  /// Throws PredicateException unless the text is a predicate over that type.
  static Predicate parse_predicate(std::string_view text, const TypeDescriptor& type);

  Calls& calls();
  Actions& actions();
  [[noreturn]] void wrong_reply(const TypeDescriptor& got, const TypeDescriptor& wanted) const;

  std::uint64_t ids_made_ = 0;
  /// Each is made with its first use.
  std::unique_ptr<Calls> calls_;
  std::unique_ptr<Actions> actions_;

  Option<EventQueue> queue_{this, "queue", EventQueue::all,
                            "change events that arrive while the component is busy: all are "
                            "delivered, or only the newest"};
  Option<std::uint32_t> queue_limit_{
    this, "queue-limit", standard_queue_limit,
    "how many change events may wait for the component (16 or more); beyond that, those of one "
    "entry are merged into one or two, marked coalesced"};
};

/// A component that runs independently of the task manager: for frequent, cheap processing.
class UnmanagedComponent : public SubarchitectureComponent {};

} // namespace castor
