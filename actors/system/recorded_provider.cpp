#include "castor/actors/component/registry.hpp"

namespace castor {

namespace {

/// Stands in for a recorded stand-alone component: hands out what it is told to (HandOut).
class RecordedProvider final : public StandaloneComponent {};

CASTOR_COMPONENT(RecordedProvider,
                 "stands in for a stand-alone component in `castor journal replay`")

} // namespace

} // namespace castor
