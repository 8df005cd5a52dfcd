#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/stand_in.hpp"

namespace castor {

namespace {

/// Stands in for a stand-alone component: hands out what it is told to (HandOut), and obeys
/// commands without any effect (`is_stand_in`).
class RecordedProvider final : public StandaloneComponent {};

CASTOR_COMPONENT(RecordedProvider,
                 "stands in for a stand-alone component in `castor journal replay`")

} // namespace

} // namespace castor
