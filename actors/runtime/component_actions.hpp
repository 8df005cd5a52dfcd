#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/runtime/action_executor.hpp"
#include "castor/actors/runtime/action_parts.hpp"
#include "castor/actors/runtime/action_requester.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace castor {

class SubarchitectureComponent;

/// The actions over working memory that one component asks for and executes.
class ComponentActions final : public Actions {
public:
  ComponentActions(SubarchitectureComponent& component, const ActionParts& parts)
    : requester_(component, parts), executor_(component, parts) {}

  Address request(const std::string& subarchitecture, const Value& what,
                  const ActionOptions& options) override {
    return requester_.request(subarchitecture, what, options);
  }
  Action state(const Address& action) override { return requester_.state(action); }
  bool is_over(const Address& action) override { return requester_.is_over(action); }
  Action wait(const Address& action, std::optional<std::chrono::nanoseconds> timeout) override {
    return requester_.wait(action, timeout);
  }
  bool wish(const Address& action, ActionWish wish) override {
    return requester_.wish(action, wish);
  }
  void release(const Address& action) override { requester_.release(action); }

  void offer(const TypeDescriptor& type, ActionOffer offer, Handler handler) override {
    executor_.offer(type, std::move(offer), std::move(handler));
  }

private:
  ActionRequester requester_;
  ActionExecutor executor_;
};

} // namespace castor
