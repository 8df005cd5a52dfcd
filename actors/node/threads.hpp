#pragma once

#include <cstddef>
#include <string>

namespace castor {

/// Why this process may not have so many further threads at once, and what to do about it; empty if
/// it may. Found out by making them: the limits are those of the user, of the container, and of the
/// machine. The actor system cannot cope with one that it is refused.
std::string why_no_threads(std::size_t count);

} // namespace castor
