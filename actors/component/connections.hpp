#pragma once

#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <functional>
#include <stdexcept>
#include <string>

namespace castor {

/// A push or pull connection failed; the message says why.
class ConnectionError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// How a component answers pulls.
struct Provision {
  TypeDescriptorPtr type;
  /// Null if pulls have no argument.
  TypeDescriptorPtr argument_type;
  /// Gets the argument; empty if there is none.
  std::function<Value(const Value&)> make;
};

/// A component's push and pull connections, at either end, without the types of values.
class Connections {
public:
  virtual ~Connections() = default;

  // -- provider

  virtual void provide(Provision provision) = 0;
  virtual void push(const Value& x) = 0;

  // -- receiver: both throw ConnectionError

  /// @param argument may be empty
  virtual Value pull(const std::string& provider, const TypeDescriptorPtr& type,
                     const Value& argument) = 0;
  virtual void subscribe(const std::string& provider, const TypeDescriptorPtr& type,
                         std::function<void(const Value&)> callback) = 0;
};

} // namespace castor
