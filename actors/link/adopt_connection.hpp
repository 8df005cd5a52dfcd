#pragma once

#include "castor/actors/link/channel.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/base/caf.hpp"

#include <caf/io/scribe.hpp>

#include <memory>

namespace castor {

/// A connection that the peer has made, and the bytes received over it so far. It is closed with
/// the last reference to it, unless a link has taken it.
struct AcceptedConnection {
  caf::io::scribe_ptr connection;
  std::shared_ptr<Channel> channel;
  Hello hello;
  Bytes received;
};

/// To a link: it may take the connection; otherwise the sender keeps it.
struct AdoptConnection {
  std::shared_ptr<AcceptedConnection> accepted;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::AdoptConnection)
