#include "castor/actors/component/component.hpp"

#include "castor/actors/component/component_runtime.hpp"
#include "castor/base/log.hpp"

#include <stdexcept>
#include <utility>

namespace castor {

namespace {

/// For what any thread may ask.
ComponentRuntime& attached(ComponentRuntime* runtime) {
  if (!runtime)
    throw std::logic_error("a component can do nothing before configure(): its constructor only "
                           "declares options");
  return *runtime;
}

} // namespace

// -- Component

Component::Component() = default;
Component::~Component() = default;

ComponentRuntime& Component::runtime() const {
  auto& result = attached(runtime_);
  if (!result.is_own_thread())
    throw std::logic_error(result.identity().full_name() +
                           " was used by another thread than its own. Let that thread put its "
                           "data into a queue, and take them from there in run()");
  return result;
}

void Component::attach(ComponentRuntime& runtime) {
  runtime_ = &runtime;
  log_name_ = runtime.identity().full_name();
  own_log_level_ = debug_ ? LogLevel::trace : log_ ? LogLevel::debug : log_level();
}

const std::string& Component::component_name() const {
  return attached(runtime_).identity().name;
}

bool Component::is_running() {
  return runtime().is_running();
}

bool Component::sleep_for(std::chrono::nanoseconds duration) {
  return runtime().deliver(duration, nullptr);
}

TimerId Component::every(std::chrono::nanoseconds period, std::function<void()> f) {
  if (period.count() <= 0)
    throw std::invalid_argument("the period of a timer has to be more than 0 s");
  return runtime().add_timer(period, std::move(f));
}

void Component::remove_timer(TimerId id) {
  runtime().remove_timer(id);
}

Timestamp Component::now() const {
  return attached(runtime_).now();
}

TimeHold Component::hold_time() const {
  return attached(runtime_).hold_time();
}

std::function<void()> Component::waker() const {
  return attached(runtime_).waker();
}

void Component::end_component() {
  throw ComponentStopped{};
}

void Component::end_system(int status, std::string reason) {
  runtime().end_system(status, log_name_ + ": " + reason);
}

Value Component::pull_value(const std::string& provider, const TypeDescriptorPtr& type,
                            const Value& argument) {
  return runtime().connections().pull(provider, type, argument);
}

void Component::command_value(const std::string& effector, const Value& x,
                              std::optional<std::chrono::microseconds> valid_for) {
  runtime().commands().command(effector, x, valid_for);
}

void Component::stream_command_value(const std::string& effector, const Value& x,
                                     std::optional<std::chrono::microseconds> valid_for) {
  runtime().commands().stream(effector, x, valid_for);
}

void Component::subscribe_to_pushes(const std::string& provider, const TypeDescriptorPtr& type,
                                    std::function<void(const Value&)> callback) {
  runtime().connections().subscribe(provider, type, std::move(callback));
}

void Component::wrong_pull(const std::string& provider, const TypeDescriptor& wanted,
                           const TypeDescriptor& got) {
  throw ConnectionError(provider + " sent a " + to_string(got) + " where " + to_string(wanted) +
                        " was expected");
}

// -- StandaloneComponent

void StandaloneComponent::provide_value(Provision provision) {
  runtime().connections().provide(std::move(provision));
}

void StandaloneComponent::obey_commands(CommandHandler handler) {
  runtime().commands().obey(std::move(handler));
}

void StandaloneComponent::push_value(Value x) {
  runtime().connections().push(x);
}

} // namespace castor
