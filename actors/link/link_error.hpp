#pragma once

#include <stdexcept>

namespace castor {

/// The peer violates the protocol.
class LinkError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

} // namespace castor
