#pragma once

#include "castor/actors/link/handshake.hpp"
#include "castor/wm/caf.hpp"

#include <caf/io/scribe.hpp>

namespace castor {

/// To a link: a connection that the peer has made, and what came over it so far.
struct AdoptConnection {
  caf::io::scribe_ptr connection;
  Hello hello;
  Bytes received;
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::AdoptConnection)
