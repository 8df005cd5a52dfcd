#pragma once

#include "castor/planning/symbolic/normal_form.hpp"

namespace castor::planning {

/// Takes out of a task what no plan needs: derived predicates, effects and actions that neither the
/// goal nor a condition of what remains depends on. Its plans stay as they are, but for needless
/// actions.
void remove_irrelevant(NormalTask& task);

} // namespace castor::planning
