#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// The entries that a call over working memory consists of, besides the request and the reply
/// themselves. The caller writes to its own working memory, the server to its own; an entry is
/// deleted when the component that wrote it ends.
namespace castor {

/// Call that a component makes.
struct Call {
  /// Subarchitecture of the server: any of its components that serves such requests.
  std::string subarchitecture;
  std::string request_type;
  std::string reply_type;
  Address request;
  std::string caller;
};
CASTOR_REFLECT(Call, subarchitecture, request_type, reply_type, request, caller)

enum class CallState : std::uint8_t { taken, done, failed };
CASTOR_REFLECT_ENUM(CallState, taken, done, failed)

/// Progress of a call, written by its server.
struct CallProgress {
  Address call;
  std::string caller;
  std::string server;
  CallState state = CallState::taken;
  /// Address of the reply, once the call is done.
  Address reply;
  /// Reason of the failure.
  std::string error;
};
CASTOR_REFLECT(CallProgress, call, caller, server, state, reply, error)

/// A component that serves calls.
struct CallServer {
  std::string component;
  std::string request_type;
  std::string reply_type;
};
CASTOR_REFLECT(CallServer, component, request_type, reply_type)

} // namespace castor
