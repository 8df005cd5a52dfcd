#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/runtime/status.hpp"
#include "castor/actors/supervision/roster.hpp"

#include <optional>
#include <vector>

namespace castor {

/// Statuses of the processes of a system, by their numbers; nothing for those that do not answer.
using PartStatuses = std::vector<std::optional<PartStatus>>;

/// Status of the link from one process to another, as `from` reports it; null if it does not
/// answer, or has no such link.
const LinkStatus* find_link(const PartStatuses& parts, ProcessNumber from, ProcessNumber to);

/// Statuses of all components, in the order of their start: as their processes report them,
/// completed with what the supervisor knows, or that alone if the process does not answer.
std::vector<ComponentStatus> component_statuses(const SystemRoster& roster,
                                                const PartStatuses& parts);

} // namespace castor
