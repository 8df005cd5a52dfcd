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

/// Of what binding is told what is asserted.
enum class Telling {
  /// Of nothing: "most balls are toys".
  nothing,
  /// Of the thing that it is about: "the ball is a toy", "there is a toy".
  of_one,
  /// Of each of the things that it is about: "all balls are toys".
  of_each,
};

Telling telling_of(const Nominal& root, const LogicalForm& form);

} // namespace castor::communication
