#pragma once

#include "castor/base/caf.hpp"

#include <caf/io/accept_handle.hpp>
#include <caf/io/connection_handle.hpp>
#include <caf/io/fwd.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// Sockets as CAF's brokers use them, without what CAF 0.17 gets wrong about them.
namespace castor {

/// Connections that a process had no file descriptor for.
struct DescriptorShortage {
  /// Number of connections accepted with the reserve descriptor, sent the reason, and closed.
  std::size_t turned_away = 0;
  /// Error text of `accept`.
  std::string problem;
};

struct AcceptorParts {
  /// Listens already; belongs to the broker from now on.
  int socket = -1;
  /// Bytes written to a connection that there is no descriptor for, before it is closed.
  std::vector<char> farewell = {};
  /// Called on the network's thread, whenever the limit of descriptors was reached.
  std::function<void(const DescriptorShortage&)> on_shortage = {};
};

/// To a broker with an acceptor: resume accepting after the limit of descriptors was reached. To be
/// passed to `trigger`.
struct ResumeAccepting {
  caf::io::accept_handle acceptor;
};

/// Adds a connected socket to a broker, to which it belongs from now on.
///
/// As `add_scribe`, but for two things: it closes its descriptor also if it is closed in the same
/// round of the network's loop in which it was activated - CAF's own stays open for ever then
/// - and after closing, a peer that acknowledges nothing keeps the socket for two seconds at most.
caf::io::connection_handle add_connection(caf::io::abstract_broker& to, int socket);

/// Adds a listening socket to a broker, which has to handle `ResumeAccepting`. Its connections are
/// made as by `add_connection`.
///
/// As `add_doorman`, but for what happens at the limit of descriptors, where CAF's own retries
/// without a pause: with a reserve descriptor, waiting connections are accepted, sent the reason,
/// and closed; then the acceptor pauses for 0.1 s.
caf::io::accept_handle add_acceptor(caf::io::abstract_broker& to, AcceptorParts parts);

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::ResumeAccepting)
