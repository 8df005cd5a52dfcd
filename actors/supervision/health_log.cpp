#include "castor/actors/supervision/health_log.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/base/log.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <fmt/core.h>

#include <memory>
#include <utility>

namespace castor {

void HealthLog::down(const Subject& who, const std::string& reason, bool will_restart) {
  bool is_new = down_since_.try_emplace(who.name, self_->clock().now()).second;
  if (!is_new && will_restart)
    return;
  if (!who.reports_itself)
    log_runtime(LogLevel::warning, who.name,
                reason + (will_restart ? "; it is started again" : ""));
  else
    log_runtime(LogLevel::warning, who.name, will_restart ? "is started again" : "stays down");
  ComponentDown x{who.name, who.subarchitecture, who.incarnation, reason, will_restart};
  if (options_.on_down)
    options_.on_down(x);
  write(who.name, Value::of(std::move(x)));
}

void HealthLog::up(const Subject& who) {
  auto since = down_since_.extract(who.name);
  if (!since)
    return;
  auto down =
    std::chrono::duration_cast<std::chrono::microseconds>(self_->clock().now() - since.mapped());
  log_runtime(LogLevel::info, who.name,
              fmt::format("is back after {:.1f} ms", static_cast<double>(down.count()) / 1000));
  ComponentUp x{who.name, who.subarchitecture, who.incarnation, down.count()};
  if (options_.on_up)
    options_.on_up(x);
  write(who.name, Value::of(std::move(x)));
}

void HealthLog::forget_others(const ArchitectureDescription& architecture) {
  std::erase_if(down_since_, [&](auto& x) { return !architecture.component(x.first); });
}

void HealthLog::write(const std::string& name, Value value) {
  static const auto client =
    std::make_shared<const Client>(Client{"supervisor", health_subarchitecture, 1});
  auto i = deployments_.actors().find(working_memory_of(health_subarchitecture));
  if (i == deployments_.actors().end())
    return;
  auto wm = caf::actor_cast<WorkingMemoryActor>(i->second);
  WriteRequest request;
  request.address = {health_subarchitecture, name};
  request.client = client;
  auto send = [&] {
    self_->request(wm, caf::infinite, request)
      .then([](const Outcome<Version>&) {}, [](const caf::error&) {});
  };
  if (!reported_.insert(name).second) {
    request.operation = Operation::remove;
    send();
  }
  request.operation = Operation::add;
  request.value = std::move(value);
  send();
}

} // namespace castor
