#pragma once

#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tests/support/eventually.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>

/// Components whose behaviour a test writes on the spot, and systems made of them.
namespace castor::test {

using namespace std::chrono_literals;

struct Note {
  std::int64_t number = 0;
  std::string text = {};

  friend bool operator==(const Note&, const Note&) = default;
};
CASTOR_REFLECT(Note, number, text)

struct Remark : Note {
  bool loud = false;
};
CASTOR_REFLECT_DERIVED(Remark, Note, loud)

struct Other {
  double x = 0;
};
CASTOR_REFLECT(Other, x)

/// What a component of type C does in each phase of its life; what is not set does nothing.
template <class C>
struct ScriptFor {
  std::function<void(C&)> configure;
  std::function<void(C&)> start;
  std::function<void(C&)> run;
  std::function<void(C&)> stop;
};

/// Opens up what component authors use and runs the script that stands under the component's name.
template <class Base>
class Scripted : public Base {
public:
  using Script = ScriptFor<Scripted>;

  static std::map<std::string, Script>& scripts() {
    static std::map<std::string, Script> result;
    return result;
  }

  std::function<void(Scripted&, const TaskId&)> on_adopted;
  std::function<void(Scripted&, const TaskId&)> on_rejected;

  using Base::command;
  using Base::component_name;
  using Base::end_component;
  using Base::end_system;
  using Base::every;
  using Base::hold_time;
  using Base::is_running;
  using Base::now;
  using Base::on_push;
  using Base::pull;
  using Base::sleep_for;
  using Base::stream_command;
  using Base::waker;

  // What follows exists in some of the bases only and is compiled where it is used.
  template <class... Ts>
  auto on_change(Ts&&... xs) {
    return Base::on_change(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto read(Ts&&... xs) {
    return Base::template read<T>(std::forward<Ts>(xs)...);
  }
  template <class T>
  auto follow(const EntryPointer<T>& x) {
    return Base::follow(x);
  }
  template <class T, class... Ts>
  auto read_all(Ts&&... xs) {
    return Base::template read_all<T>(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto read_all_in(Ts&&... xs) {
    return Base::template read_all_in<T>(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto read_all_derived(Ts&&... xs) {
    return Base::template read_all_derived<T>(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto read_async(Ts&&... xs) {
    return Base::template read_async<T>(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto add(Ts&&... xs) {
    return Base::add(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto add_async(Ts&&... xs) {
    return Base::add_async(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  void put(Ts&&... xs) {
    Base::put(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto overwrite(Ts&&... xs) {
    return Base::overwrite(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto overwrite_async(Ts&&... xs) {
    return Base::overwrite_async(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto delete_entry(Ts&&... xs) {
    return Base::delete_entry(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto exists(Ts&&... xs) {
    return Base::exists(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto version(Ts&&... xs) {
    return Base::version(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto write(Ts&&... xs) {
    return Base::write(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto lock(Ts&&... xs) {
    return Base::lock(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto try_lock(Ts&&... xs) {
    return Base::try_lock(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto lock_entry(Ts&&... xs) {
    return Base::lock_entry(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto try_lock_entry(Ts&&... xs) {
    return Base::try_lock_entry(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto unlock_entry(Ts&&... xs) {
    return Base::unlock_entry(std::forward<Ts>(xs)...);
  }
  auto is_overwritable(const Address& x) { return Base::is_overwritable(x); }
  auto is_deletable(const Address& x) { return Base::is_deletable(x); }
  auto is_readable(const Address& x) { return Base::is_readable(x); }
  template <class T, class... Ts>
  auto read_where(Ts&&... xs) {
    return Base::template read_where<T>(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto read_where_in(Ts&&... xs) {
    return Base::template read_where_in<T>(std::forward<Ts>(xs)...);
  }
  template <class Request, class Reply, class... Ts>
  auto call(Ts&&... xs) {
    return Base::template call<Request, Reply>(std::forward<Ts>(xs)...);
  }
  template <class Request, class F>
  auto on_call(F f) {
    return Base::template on_call<Request>(std::move(f));
  }
  template <class T>
  auto perform(const std::string& subarchitecture, T what, const ActionOptions& options = {}) {
    return Base::perform(subarchitecture, std::move(what), options);
  }
  template <class T, class F>
  auto on_action(F f, ActionOffer offer = {}) {
    return Base::template on_action<T>(std::move(f), std::move(offer));
  }
  auto call_cancelled() const { return Base::call_cancelled(); }
  template <class... Ts>
  auto wait_for_changes(Ts&&... xs) {
    return Base::wait_for_changes(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto remove_receiver(Ts&&... xs) {
    return Base::remove_receiver(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto receive_changes(Ts&&... xs) {
    return Base::receive_changes(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto here(Ts&&... xs) {
    return Base::here(std::forward<Ts>(xs)...);
  }
  auto new_id() { return Base::new_id(); }
  auto receiver_count() const { return Base::receiver_count(); }
  template <class... Ts>
  auto propose_task(Ts&&... xs) {
    return Base::propose_task(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto retract_task(Ts&&... xs) {
    return Base::retract_task(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto complete_task(Ts&&... xs) {
    return Base::complete_task(std::forward<Ts>(xs)...);
  }
  template <class T, class... Ts>
  auto provide(Ts&&... xs) {
    return Base::template provide<T>(std::forward<Ts>(xs)...);
  }
  template <class T, class Argument, class F>
  auto provide_for(F f) {
    return Base::template provide<T, Argument>(std::move(f));
  }
  template <class T, class... Ts>
  auto on_command(Ts&&... xs) {
    return Base::template on_command<T>(std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  auto push(Ts&&... xs) {
    return Base::push(std::forward<Ts>(xs)...);
  }

private:
  void configure() override { call(&Script::configure); }
  void start() override { call(&Script::start); }
  void run() override { call(&Script::run); }
  void stop() override { call(&Script::stop); }

  void call(std::function<void(Scripted&)> Script::*step) {
    auto i = scripts().find(component_name());
    if (i != scripts().end() && i->second.*step)
      (i->second.*step)(*this);
  }
};

class Managed : public Scripted<ManagedComponent> {
  void task_adopted(const TaskId& id) override {
    if (on_adopted)
      on_adopted(*this, id);
  }
  void task_rejected(const TaskId& id) override {
    if (on_rejected)
      on_rejected(*this, id);
  }
};

using ManagedScript = Scripted<ManagedComponent>;
using UnmanagedScript = Scripted<UnmanagedComponent>;
using StandaloneScript = Scripted<StandaloneComponent>;

/// Forgets all scripts.
void clear_scripts();

/// The architecture that the text describes; fails the test with the findings if there are any.
ArchitectureDescription architecture(const std::string& text);

/// "CPP WM ..." and "CPP TM ..." for a subarchitecture, to be followed by its components.
std::string subarchitecture(const std::string& name);

/// Components that fail stay down.
SystemOptions without_restarts();

/// Runs the system until it ends itself, and stops it; the status it ended with, or -1 if it did
/// not end within two minutes.
int run(System& system);

} // namespace castor::test
