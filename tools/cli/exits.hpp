#pragma once

namespace castor::cli {

/// Ends the process, as _Exit() does, in whichever thread. Of Castor's own threads; those of
/// components are reported when they end the process (exits.cpp).
[[noreturn]] void leave_process(int status);

} // namespace castor::cli
