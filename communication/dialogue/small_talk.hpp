#pragma once

#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/parsing/word_meanings.hpp"
#include "castor/communication/types.hpp"

#include <string>

namespace castor::communication {

/// What is asked or said about the robot itself: identity, doing, why ... Empty if there is no
/// root.
std::string small_talk_topic(const LogicalForm& form);

/// Whether it is asked about an act that is done to nothing, for which there are no motives: "why
/// did you stop?"
bool asks_about_no_thing(const LogicalForm& form);

/// The things that a question about what the robot does is about, in words for a
/// planning::MotiveQuestion: "blue ball|sphere". Empty if it names none.
std::string things_asked_about(const LogicalForm& form, const Vocabulary& vocabulary);

/// The reply to what is about the robot itself rather than about the scene: thanks, who it is, how
/// it is, what it can do. The form's topic is looked up.
std::string small_talk(const LogicalForm& form, const WordMeanings& meanings);

} // namespace castor::communication
