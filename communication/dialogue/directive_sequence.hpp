#pragma once

#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

#include <vector>

namespace castor::communication {

/// Steps as each of them was read, made what they mean together: two things that go where the other
/// is are swapped, "there" is where the step before is done, "where it is" of what moves before is
/// where it was, and what is only said again is left out.
/// \param request that they are read from
std::vector<DirectiveStep> taken_together(std::vector<DirectiveStep> steps,
                                          const LogicalForm& request, const Vocabulary& vocabulary);

} // namespace castor::communication
