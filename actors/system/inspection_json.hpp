#pragma once

#include "castor/actors/component/task_event.hpp"
#include "castor/actors/supervision/roster.hpp"
#include "castor/actors/system/component_statuses.hpp"
#include "castor/actors/system/replay.hpp"
#include "castor/actors/system/system_summary.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Answers of an inspection as JSON. Times are in seconds.
namespace castor {

using Json = nlohmann::ordered_json;

/// As JSON in UTF-8: bytes of strings that are not valid become U+FFFD.
std::string to_text(const Json& x);

/// The same as a line.
std::string as_line(const Json& x);

/// Everything about a system at one moment: what `castor ps` shows.
struct SystemReport {
  PartStatuses parts;
  std::vector<WorkingMemoryStatus> working_memories;
};

Json to_json(const SystemReport& report, const SystemRoster& roster);
/// Summary of the processes, working memories and components of a system, for its end.
Json to_json(const SystemSummary& summary, const SystemRoster& roster);
Json to_json(const Usage& x);
Json to_json(const ChangeEvent& x);
Json to_json(const TaskEvent& x);
Json to_json(const ReplayOutcome& x);
/// The position in the recording (`at`) is in microseconds since 1970.
Json to_json(const ReplayProgress& x);

/// A type: its fields, and an example of a value.
Json to_json(const TypeDescriptor& x);

/// Subarchitectures and components that join a system with `added`.
Json members_of(const ArchitectureDescription& added);

/// Subarchitectures and components that leave a system with the component or subarchitecture of
/// that name.
Json members_of(const SystemRoster& roster, const std::string& name);

/// An entry, with its value if that is wanted. Byte fields of more than `max_bytes` are shown as
/// their size.
std::string entry_as_json(const Entry& x, bool with_value, std::size_t max_bytes);

/// The event and, if there is one, the entry's value after it.
std::string change_as_json(const ChangeEvent& x, const Value& value, std::size_t max_bytes);

} // namespace castor
