#pragma once

#include "castor/actors/component/task_event.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// One line of the timeline: time, subarchitecture, operation, type, id, component, version.
std::string timeline_line(const ChangeEvent& event, bool coloured);

/// The same for an event in the JSON form of running systems.
std::string timeline_line(const nlohmann::ordered_json& event, bool coloured);

/// The same columns: time, subarchitecture, change of the task, its name, id, component, and the
/// reason or the outcome.
std::string timeline_line(const TaskEvent& event, bool coloured);

/// Headings of the columns.
std::string timeline_head(bool coloured);

} // namespace castor::cli
