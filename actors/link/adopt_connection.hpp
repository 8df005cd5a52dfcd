#pragma once

#include "castor/actors/link/channel.hpp"
#include "castor/actors/link/handshake.hpp"
#include "castor/wm/caf.hpp"

#include <caf/io/scribe.hpp>

#include <memory>

namespace castor {

/// To a link: a connection that the peer has made, and what came over it so far.
struct AdoptConnection {
  caf::io::scribe_ptr connection;
  std::shared_ptr<Channel> channel;
  Hello hello;
  Bytes received;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::AdoptConnection)
