#pragma once

#include "castor/wm/entries/client.hpp"

#include <cstdint>
#include <string>

namespace castor {

/// Source of this user's writes: "operator:ann".
const std::string& operator_source();

/// A new client for each request: its end is the end of the request's ephemeral entries.
ClientPtr new_operator_client();

/// Number of an entry, or of a client, that operators make in this process; no two have the same.
std::uint64_t next_operator_number();

} // namespace castor
