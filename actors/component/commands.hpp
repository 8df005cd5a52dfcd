#pragma once

#include "castor/actors/component/command_terms.hpp"
#include "castor/actors/component/connections.hpp"
#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace castor {

/// An effector has refused a command; the message says why. It may be obeyed later: once the
/// commander holds the lease that the effector demands, for instance.
class CommandRefused : public ConnectionError {
public:
  using ConnectionError::ConnectionError;
};

/// How an effector obeys commands of one type.
struct CommandHandler {
  TypeDescriptorPtr type;
  CommandTerms terms;
  std::function<void(const Value&)> obey;
  /// Without commander: stops whatever could do harm.
  std::function<void()> take_safe_state;
};

/// A component's commands, at either end, without the types of values.
class Commands {
public:
  virtual ~Commands() = default;

  // -- effector

  virtual void obey(CommandHandler handler) = 0;

  // -- commander: `valid_for` is how long the command holds; the effector's maximum if there is
  // none

  /// Returns once the effector has obeyed. Throws CommandRefused or ConnectionError.
  virtual void command(const std::string& effector, const Value& x,
                       std::optional<std::chrono::microseconds> valid_for) = 0;

  /// Returns at once. Throws CommandRefused if an earlier command of the type was refused since the
  /// last call.
  virtual void stream(const std::string& effector, const Value& x,
                      std::optional<std::chrono::microseconds> valid_for) = 0;
};

} // namespace castor
