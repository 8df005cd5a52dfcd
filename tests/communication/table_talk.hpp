#pragma once

#include "castor/communication/dialogue/question_context.hpp"
#include "castor/communication/dialogue/realiser.hpp"
#include "castor/communication/dialogue/respond.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/parsing/parser.hpp"
#include "castor/communication/types.hpp"
#include "castor/tests/communication/shared_vocabulary.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication::test {

/// What the robot makes of an utterance.
struct Reply {
  DialogueMoveType move = DialogueMoveType::none;
  RhetoricalRelation relation = RhetoricalRelation::narration;
  std::string text;
  /// The parser has found no reading of the whole utterance.
  bool is_parsed = true;
  /// Sentences that there were no words for.
  std::size_t silences = 0;
  /// What is asked to be done.
  std::vector<DirectiveStep> steps = {};
  /// It is only asked whether that is possible.
  bool asks_whether_possible = false;
  /// It takes the place of the request before, or comes before that.
  bool corrects = false;
  bool comes_first = false;
  /// What is said next.
  std::string sequel = {};
};

/// A conversation about a scene, without actors and working memories: what the components of
/// communication do, one after the other.
class TableTalk {
public:
  /// Answers what binding is asked.
  using Binding = std::function<binding::ReferenceReply(const binding::ReferenceRequest&)>;

  /// Is told what is asserted, under a name.
  using Tell = std::function<void(const std::string&, std::vector<binding::Feature>)>;

  /// \param tell nobody is told anything without
  explicit TableTalk(Binding binding, Tell tell = {},
                     const std::shared_ptr<const Vocabulary>& vocabulary = shared_vocabulary())
    : binding_(std::move(binding)), tell_(std::move(tell)), vocabulary_(vocabulary),
      questions_(vocabulary) {}

  /// \returns the reply to the last sentence
  Reply say(const std::string& text);

  /// From now on somebody points there.
  void point(const Pointing& pointing);

private:
  /// With what follows from it.
  Reply say_all(const std::string& text);
  Reply say_sentence(const std::string& text);

  void tell_of(const DialogueMove& move, const MoveReferents& referents);

  Binding binding_;
  Tell tell_;
  std::shared_ptr<const Vocabulary> vocabulary_;
  QuestionContext questions_;
  std::vector<MoveReferents> history_;
  std::optional<Pointing> pointing_;
  std::uint64_t gestures_ = 0;
  std::size_t told_ = 0;
  std::optional<bool> last_answer_;
};

} // namespace castor::communication::test
