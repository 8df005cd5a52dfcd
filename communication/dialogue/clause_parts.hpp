#pragma once

#include "castor/communication/types.hpp"

#include <optional>
#include <vector>

/// Parts of a clause that are said apart from what they belong to, or not said at all.
namespace castor::communication {

/// The form with relative clauses and alternatives where they belong: "do you see a ball on the
/// table that is red" asks for a red ball, and "which is larger, the ball or the cube" for one of
/// these. "One ball is red, which one" asks what the clause before it is about.
LogicalForm reunited(LogicalForm form);

/// The questions of "what colour is it, and where is it?", the second with the first as its
/// preface; empty for other forms.
std::vector<LogicalForm> questions_in(const LogicalForm& form);

/// Whether nothing but the question word or the subject is said: "which one", "how many", "where",
/// "is the cube".
bool is_elliptical(const LogicalForm& form);

/// Before the names of the nominals of an elliptical question in what it asks.
inline constexpr std::string_view said_now = "now-";

/// What an elliptical question asks about the clause before it; nothing if that speaks of nothing
/// that could be asked for.
///
/// \returns `before`, as a question; its nominals keep their names, and those of the elliptical
/// question follow `said_now`
std::optional<LogicalForm> completed(const LogicalForm& elliptical, LogicalForm before);

} // namespace castor::communication
