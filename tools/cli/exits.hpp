#pragma once

namespace castor::cli {

/// Ends the process, as _Exit() does, from any thread. For Castor's own threads: an exit from a
/// component's thread is reported (exits.cpp).
[[noreturn]] void leave_process(int status);

} // namespace castor::cli
