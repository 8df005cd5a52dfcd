#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/actors/supervision/roster.hpp"

#include <optional>
#include <vector>

namespace castor {

/// What the processes of a system say of themselves, by their numbers; nothing of those that do not
/// answer.
using PartStatuses = std::vector<std::optional<PartStatus>>;

/// How a process sees its link to another; null if it does not answer, or knows of none.
const LinkStatus* find_link(const PartStatuses& parts, ProcessNumber from, ProcessNumber to);

/// Of all components, in the order of their start: what their processes say of them, with what the
/// supervisor knows. Of those whose processes do not answer, that.
std::vector<ComponentStatus> component_statuses(const SystemRoster& roster,
                                                const PartStatuses& parts);

} // namespace castor
