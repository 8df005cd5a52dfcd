#pragma once

#include "castor/actors/component/commands.hpp"
#include "castor/actors/component/connections.hpp"
#include "castor/actors/component/option.hpp"
#include "castor/actors/component/push_flow.hpp"
#include "castor/actors/component/restart_type.hpp"
#include "castor/actors/component/stop_patience.hpp"
#include "castor/actors/component/timer_id.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/clock/activity.hpp"
#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/failure.hpp"
#include "castor/wm/values/value.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace castor {

class ComponentRuntime;
class ComponentShell;

/// Thrown by the operation that a component waits in when it is told to stop. It has no base class,
/// so that a `catch (const std::exception&)` in a component does not swallow it; let it pass.
struct ComponentStopped {};

/// What happens to change events that arrive while the component is busy.
enum class EventQueue : std::uint8_t {
  /// They are delivered one after another.
  all,
  /// Only the newest is delivered, the others are dropped.
  newest,
};
CASTOR_REFLECT_ENUM(EventQueue, all, newest)
CASTOR_REFLECT_ENUM(RestartType, permanent, transient, temporary)

/// A unit of processing with a thread of its own.
///
/// Derive from ManagedComponent or UnmanagedComponent for a component of a subarchitecture, from
/// StandaloneComponent for one outside (a camera, a motor), and register the class with
/// CASTOR_COMPONENT. The runtime calls configure, start, run, stop in this order; no component of a
/// system is started before all are configured, and none is run before all are started.
///
/// All these functions and all callbacks run on the component's own thread. Callbacks run inside
/// `sleep_for` and `wait_for_changes`, and once `run()` has returned. Two pieces of a component's
/// code therefore never run at the same time, and a component needs no locks for its members.
///
/// An exception that leaves one of these functions or a callback ends the component, and only it.
/// It is then replaced by a new one of the same name and with the same options, unless --restart
/// excludes that or it failed too often (docs/supervision.md).
class Component {
public:
  Component();
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  virtual ~Component();

  OptionList& options() { return options_; }

protected:
  /// Options have their values; nothing else exists yet.
  virtual void configure() {}

  /// Everything is connected: the place to register change filters and to add first entries.
  virtual void start() {}

  /// The component's own activity, if it has any besides callbacks. May return at any time.
  virtual void run() {}

  /// The component is about to end. Working memory may still be used. Not called after an
  /// exception.
  virtual void stop() {}

  const std::string& component_name() const;

  /// False from the moment the component was told to stop, also in the middle of a callback. Long
  /// computations should check it regularly.
  bool is_running();

  /// Waits, and delivers events that arrive meanwhile; false if the component was told to stop.
  bool sleep_for(std::chrono::nanoseconds duration);

  /// Calls `f` every `period`, wherever callbacks are called, for the first time in one period. The
  /// times do not drift; calls that were missed because this component was busy are left out.
  /// Throws std::invalid_argument if the period is not positive.
  TimerId every(std::chrono::nanoseconds period, std::function<void()> f);
  void remove_timer(TimerId id);

  /// Time since the start of the system, simulated if its clock is (docs/time.md).
  Timestamp now() const;

  /// Keeps simulated time from going on as long as the result lives, while something goes on that
  /// the runtime does not see, such as work of a thread of one's own. Does nothing if the clock is
  /// real. May be called and destroyed on any thread.
  TimeHold hold_time() const;

  /// A function by which a thread of one's own makes this component look again at what it waits for
  /// in `ActionInProgress::wait_until`. May be called on any thread, also once the component has
  /// ended.
  std::function<void()> waker() const;

  /// Ends this component with its work done. It is started again only with `--restart permanent`,
  /// the default. Does not return.
  [[noreturn]] void end_component();

  /// Ends the whole system; the process exits with `status`.
  void end_system(int status, std::string reason);

  template <class... Ts>
  void trace(fmt::format_string<Ts...> format, Ts&&... xs) {
    log_at(LogLevel::trace, format, std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  void debug(fmt::format_string<Ts...> format, Ts&&... xs) {
    log_at(LogLevel::debug, format, std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  void info(fmt::format_string<Ts...> format, Ts&&... xs) {
    log_at(LogLevel::info, format, std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  void warning(fmt::format_string<Ts...> format, Ts&&... xs) {
    log_at(LogLevel::warning, format, std::forward<Ts>(xs)...);
  }
  template <class... Ts>
  void error(fmt::format_string<Ts...> format, Ts&&... xs) {
    log_at(LogLevel::error, format, std::forward<Ts>(xs)...);
  }

  // -- connections to components outside the schema, for data too frequent or too large for working
  // memory, such as images and motor commands

  /// The newest `T` of the stand-alone component `provider`. Throws ConnectionError if there is no
  /// such component, if it does not provide a `T`, or if it does not answer within the deadline.
  template <ReflectedRecord T>
  std::shared_ptr<const T> pull(const std::string& provider) {
    return require<T>(provider, pull_value(provider, descriptor_of<T>(), {}));
  }

  /// The `T` that the stand-alone component `provider` makes for `argument`; else like `pull`
  /// without one.
  template <ReflectedRecord T, ReflectedRecord Argument>
  std::shared_ptr<const T> pull(const std::string& provider, Argument argument) {
    return require<T>(provider,
                      pull_value(provider, descriptor_of<T>(), Value::of(std::move(argument))));
  }

  /// Calls `callback` with every `T` that the stand-alone component `provider` pushes from now on.
  /// Pushes wait while this component is busy; of more than `--push-limit`, the oldest are dropped.
  /// Throws like `pull`.
  template <ReflectedRecord T>
  void on_push(const std::string& provider,
               std::function<void(const std::shared_ptr<const T>&)> callback) {
    subscribe_to_pushes(provider, descriptor_of<T>(),
                        [this, provider, callback = std::move(callback)](const Value& x) {
                          callback(require<T>(provider, x));
                        });
  }

  // -- commands to effectors: stand-alone components, such as motors, that obey

  /// Commands the effector, and returns once it has obeyed. The command holds for `valid_for`,
  /// counted from now, or for the effector's maximum if that is less or nothing is given. If the
  /// effector demands a lease (`CommandTerms`), this component has to hold it. Throws
  /// CommandRefused if the effector does not obey, and ConnectionError if there is no such
  /// component, or if it fails or does not answer.
  template <ReflectedRecord T>
  void command(const std::string& effector, T x,
               std::optional<std::chrono::microseconds> valid_for = std::nullopt) {
    command_value(effector, Value::of(std::move(x)), valid_for);
  }

  /// Commands the effector without waiting for it, as controllers do many times a second. While one
  /// command of the type is under way, only the newest of those after it is kept. Throws
  /// CommandRefused if an earlier one was refused since the last call; waits only for the first
  /// command, and while the effector is being restarted.
  template <ReflectedRecord T>
  void stream_command(const std::string& effector, T x,
                      std::optional<std::chrono::microseconds> valid_for = std::nullopt) {
    stream_command_value(effector, Value::of(std::move(x)), valid_for);
  }

private:
  friend class ComponentShell;
  friend class StandaloneComponent;
  friend class SubarchitectureComponent;
  friend class ManagedComponent;
  friend class TaskManager;

  template <class... Ts>
  void log_at(LogLevel level, fmt::format_string<Ts...> format, Ts&&... xs) {
    if (level >= own_log_level_)
      log(level, log_name_, fmt::format(format, std::forward<Ts>(xs)...));
  }

  template <ReflectedRecord T>
  std::shared_ptr<const T> require(const std::string& provider, const Value& x) {
    if (auto result = x.as<T>())
      return result;
    wrong_pull(provider, *descriptor_of<T>(), x.type());
  }

  [[noreturn]] void wrong_pull(const std::string& provider, const TypeDescriptor& wanted,
                               const TypeDescriptor& got);
  Value pull_value(const std::string& provider, const TypeDescriptorPtr& type,
                   const Value& argument);
  void command_value(const std::string& effector, const Value& x,
                     std::optional<std::chrono::microseconds> valid_for);
  void stream_command_value(const std::string& effector, const Value& x,
                            std::optional<std::chrono::microseconds> valid_for);
  void subscribe_to_pushes(const std::string& provider, const TypeDescriptorPtr& type,
                           std::function<void(const Value&)> callback);

  /// Throws std::logic_error outside the runtime, and in constructors.
  ComponentRuntime& runtime() const;
  /// Called by the runtime before `configure`.
  void attach(ComponentRuntime& runtime);

  ComponentRuntime* runtime_ = nullptr;
  OptionList options_;
  std::string log_name_;
  LogLevel own_log_level_ = LogLevel::info;

  // Options of every component.
  Option<bool> log_{this, "log", false, "log at level debug"};
  Option<bool> debug_{this, "debug", false, "log at level trace"};
  Option<std::chrono::milliseconds> deadline_{this, "deadline", std::chrono::seconds{10},
                                              "how long an operation may take"};
  Option<std::chrono::milliseconds> budget_{
    this, "budget", std::chrono::seconds{10},
    "how long the component's own code may run without a pause before that is reported"};
  Option<RestartType> restart_{
    this, "restart", RestartType::permanent,
    "whether it is started again: always, only if it has failed, or never"};
  Option<bool> isolate_{this, "isolate", false,
                        "run it in a process of its own: whatever it does there, others go on"};
  Option<std::int64_t> memory_limit_{this, "memory-limit", 0,
                                     "MB that an isolated component may allocate; 0 for no limit"};
  Option<std::chrono::milliseconds> shutdown_{this, "shutdown", standard_stop_patience,
                                              "how long the component may take to stop"};
  Option<std::uint32_t> push_limit_{
    this, "push-limit", standard_push_limit,
    "how many pushes of one type may wait for the component (1 or more); beyond that the oldest "
    "are dropped"};
};

/// A component outside the subarchitectures, without access to working memory: sensors, effectors,
/// servers. Components of subarchitectures connect to it by its name.
class StandaloneComponent : public Component {
protected:
  /// Answers pulls of a `T` by calling `make`, on this component's thread.
  template <ReflectedRecord T>
  void provide(std::function<T()> make) {
    provide_value({descriptor_of<T>(), nullptr,
                   [make = std::move(make)](const Value&) { return Value::of(make()); }});
  }

  /// Answers pulls of a `T` that have an argument.
  template <ReflectedRecord T, ReflectedRecord Argument>
  void provide(std::function<T(const Argument&)> make) {
    provide_value(
      {descriptor_of<T>(), descriptor_of<Argument>(),
       [make = std::move(make)](const Value& x) { return Value::of(make(*x.as<Argument>())); }});
  }

  /// Sends `x` to every subscriber of `T`, without waiting. A subscriber that does not keep up gets
  /// the newest.
  template <ReflectedRecord T>
  void push(T x) {
    push_value(Value::of(std::move(x)));
  }

  /// Calls `obey` with every command of the type that fulfils the terms, on this component's
  /// thread. Once the last one has expired, or its commander or the commander's lease is gone, and
  /// when this component ends, calls `take_safe_state`, which stops whatever could do harm. Neither
  /// is called while this component's own code runs: effectors return quickly, and wait for nobody.
  template <ReflectedRecord T>
  void on_command(std::function<void(const T&)> obey, std::function<void()> take_safe_state,
                  CommandTerms terms = {}) {
    obey_commands({descriptor_of<T>(), std::move(terms),
                   [obey = std::move(obey)](const Value& x) { obey(*x.as<T>()); },
                   std::move(take_safe_state)});
  }

private:
  void provide_value(Provision provision);
  void push_value(Value x);
  void obey_commands(CommandHandler handler);
};

} // namespace castor
