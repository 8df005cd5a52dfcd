#pragma once

#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

namespace castor::communication {

/// Puts a fragment in the place of what is like it in a question: a thing for the thing that it is
/// about, a colour for a colour, a place for a place.
///
/// \param form of the question; has the nominals of the fragment, too
/// \returns whether there is such a place; otherwise the form is unchanged
bool substitute_fragment(LogicalForm& form, const Nominal& fragment, const Vocabulary& vocabulary);

} // namespace castor::communication
