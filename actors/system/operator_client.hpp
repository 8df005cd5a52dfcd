#pragma once

#include "castor/wm/entries/client.hpp"

#include <cstdint>
#include <string>

namespace castor {

/// Who stands as the source of what this user writes: "operator:ann".
const std::string& operator_source();

/// Another one for each request: its end is the end of what the request has made ephemeral.
ClientPtr new_operator_client();

/// Number of an entry, or of a client, that operators make in this process; no two have the same.
std::uint64_t next_operator_number();

} // namespace castor
