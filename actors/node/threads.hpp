#pragma once

#include <cstddef>
#include <string>

namespace castor {

/// Why this process cannot have so many further threads at once, and what to do about it; empty if
/// it can. Found out by making them, since user, container and machine have limits. The actor
/// system cannot handle a failure to make a thread.
std::string why_no_threads(std::size_t count);

} // namespace castor
