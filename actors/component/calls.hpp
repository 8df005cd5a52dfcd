#pragma once

#include "castor/wm/values/type_descriptor.hpp"
#include "castor/wm/values/value.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace castor {

struct CallOptions {
  /// The component's deadline if there is no value.
  std::optional<std::chrono::nanoseconds> timeout = {};
  /// How often the call is made again if its server goes away while it works on it. Only for
  /// requests that may be served twice.
  int retries = 0;
};

/// The calls over working memory that one component makes and serves, without the types of requests
/// and replies.
class Calls {
public:
  using Handler = std::function<Value(const Value& request)>;

  virtual ~Calls() = default;

  /// Throws CallException, DeadlineException, DeadlockException.
  virtual Value call(const std::string& subarchitecture, const Value& request,
                     const TypeDescriptor& reply_type, const CallOptions& options) = 0;

  virtual void serve(const TypeDescriptor& request_type, const TypeDescriptor& reply_type,
                     Handler handler) = 0;

  /// Whether the caller has cancelled the call that is being served.
  virtual bool is_cancelled() const = 0;
};

} // namespace castor
