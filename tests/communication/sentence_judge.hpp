#pragma once

#include "castor/tests/communication/sentence_set.hpp"
#include "castor/tests/communication/table_talk.hpp"

#include <vector>

namespace castor::communication::test {

enum class SentenceJudgement {
  right,
  /// The robot says that it does not know or does not understand, or asks back, or has no words.
  not_answered,
  /// It is sure, and wrong.
  wrong,
};

/// What somebody makes of a reply who knows what is right.
/// \param things what lies on the table
SentenceJudgement judge(const Reply& reply, const ExpectedReply& expected,
                        const std::vector<ThingInSet>& things);

} // namespace castor::communication::test
