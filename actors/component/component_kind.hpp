#pragma once

namespace castor {

enum class ComponentKind { working_memory, task_manager, managed, unmanaged, standalone };

} // namespace castor
