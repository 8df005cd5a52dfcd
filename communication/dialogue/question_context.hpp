#pragma once

#include "castor/communication/dialogue/fragments.hpp"
#include "castor/communication/dialogue/response.hpp"
#include "castor/communication/dialogue/salience.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace castor::communication {

/// The questions of a dialogue that later moves take up: "the red one" after "which ball do you
/// mean?", "and the disc?" after "what colour is the ball?", and "yes" after "shall I take it?".
class QuestionContext {
public:
  explicit QuestionContext(std::shared_ptr<const Vocabulary> vocabulary)
    : vocabulary_(std::move(vocabulary)) {}

  /// From now on words mean that.
  void set_vocabulary(std::shared_ptr<const Vocabulary> vocabulary) {
    vocabulary_ = std::move(vocabulary);
  }

  /// Things that were spoken of are known by other proxies from now on.
  void rename(const RenamedThings& renamed);

  /// The move as it is meant: a fragment takes the place of what it is about in a question before.
  CompleteMove complete(const DialogueMove& move, const Antecedents& antecedents) const;

  /// The move has been replied to.
  void note(const CompleteMove& move, const Response& response);

private:
  DialogueMove with_what_is_the_same(DialogueMove move) const;
  void replace_one(LogicalForm& form) const;
  void keep_landmark(CompleteMove& move) const;
  void resolve_there(CompleteMove& move) const;
  std::optional<CompleteMove> once_more(const DialogueMove& move) const;
  std::optional<CompleteMove> clarified(const DialogueMove& move,
                                        const Antecedents& antecedents) const;
  std::optional<CompleteMove> put_topic(const CompleteMove& place) const;

  std::shared_ptr<const Vocabulary> vocabulary_;
  std::optional<CompleteMove> question_;
  /// The last question or statement.
  std::optional<CompleteMove> clause_;
  std::optional<CompleteMove> unclear_;
  /// A thing that was only named: "the red cube."
  std::optional<CompleteMove> topic_;
  /// A request that the robot has asked whether to do.
  std::optional<CompleteMove> proposed_;
  /// A request that somebody has only asked whether it is possible.
  std::optional<CompleteMove> possible_;
  /// Noun of the last thing that was spoken of, for which "one" stands.
  std::string noun_;
  /// Nominal of the unclear move that the other was asked about.
  std::string asked_about_;
};

} // namespace castor::communication
