#pragma once

#include "castor/communication/dialogue/response.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Utterances that say several things, of which one has to wait for another.
namespace castor::communication {

/// Parses a part of an utterance in any way in which it is understood; nothing if it is not.
using PartParser = std::function<std::optional<PackedLogicalForm>(const std::vector<std::string>&)>;

/// A question after a request, "put the ball on the left and then tell me where it is", or about
/// the answer to one before it, "which one is the tallest, and where is it?"; a request after a
/// question. Nothing if the parts are not understood by themselves.
std::optional<PackedLogicalForm> parsed_question_beside(Parser& parser,
                                                        const std::vector<std::string>& words,
                                                        const PartParser& parse_part);

/// Whether the second of two questions may be about the answer to the first.
bool asks_about_answer(const std::vector<std::string>& words);

/// Whether the condition of a request may be about what the request names: "take it if it is red".
bool has_condition_on_it(const std::vector<std::string>& words);

/// Requests on a condition, "if the ball is red, take it; otherwise leave it", and requests in
/// another order than they are said in, "before you take the ball, move the cube". "If so" is about
/// the question before: the form is a yes then, of "if not" a no.
std::optional<PackedLogicalForm> parsed_in_order(Parser& parser,
                                                 const std::vector<std::string>& words,
                                                 const PartParser& parse_part);

/// Whether a response says yes or no; nothing if it says neither.
std::optional<bool> truth_said(const Response& response);

/// What to say of a move with a condition, and what is said next; the sequel is empty if nothing
/// is.
struct Continuation {
  Response response;
  std::string sequel;
};

/// \param move without a condition, its sequel is said as soon as it is answered
/// \param last_answer whether the answer to the last question was yes
Continuation continued(const DialogueMove& move, Response response,
                       std::optional<bool> last_answer);

} // namespace castor::communication
