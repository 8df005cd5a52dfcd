#pragma once

#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/types.hpp"

namespace castor::communication {

/// Whether an assertion agrees with what is perceived. `Truth::unknown` is what can be learned from
/// it; what is said of something that is shown ("this is a ball") is unknown where it is not clear
/// what is meant.
///
/// \param root of the form, which the evaluation is of, too
/// \throws Uninterpretable
Truth judge_assertion(const Nominal& root, const LogicalForm& form, Evaluation& evaluation);

} // namespace castor::communication
