#pragma once

#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/response.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// Replies to one dialogue move, by what is known of the scene.
class Responder {
public:
  /// All of them have to outlive the responder.
  Responder(const LogicalForm& form, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(form), antecedents_(antecedents), scene_(scene), evaluation_(form, antecedents, scene) {
  }

  // Each throws Uninterpretable.

  void check_presuppositions() { evaluation_.check_presuppositions(); }
  Response to_question_w();
  Response to_question_yn();
  Response to_assertion() { return to_assertion(root()); }
  /// Corrects what is said before a question in the same sentence; nothing if it may be so.
  std::optional<Response> to_preface();
  /// Asks back if it is not clear what is meant. Whoever does what is asked for, or knows whether
  /// it is possible, replies otherwise.
  Response to_directive();

  /// The response with descriptions of what only the speaker can call "this".
  Response described(Response response);

  /// Says why there is no other reply.
  Response to(const Uninterpretable& why);

private:
  using Things = std::vector<std::string>;

  const Nominal& root() const;
  const Nominal& need(const Nominal& of, const char* mode) const;

  Response to_assertion(const Nominal& said);
  bool is_told_in_vain(const Nominal& said) const;
  bool says_what_is_not_seen(const Nominal& said) const;

  // -- questions
  Response about(const Nominal& asked);
  Response owned_quality(const Nominal& x);
  Response count(const Fitting& found, const Nominal& phrase, const Nominal* scope);
  std::optional<LogicalForm> share_of(const Count& number, const Nominal& phrase,
                                      const Nominal* scope);
  bool is_number(const Nominal& asked) const;
  Response some_of(const Fitting& found, const Nominal& asked) const;
  Response list(const Things& things) const;
  bool asks_what_is_held() const;
  Response where(const Nominal& phrase);
  Response way_to(const Nominal& phrase);
  bool is_on_another(const std::string& id);
  std::optional<LogicalForm> place_of(const std::string& id);
  std::optional<LogicalForm> where_it_is(const Fitting& found, const Nominal& asked);
  Response what(const Nominal& phrase);
  Response quality(const Nominal& asked, const Nominal& of);
  Response quality(const std::string& name, const Nominal& of);
  Response qualities(const Things& things, const Nominal& of, const std::string& name,
                     binding::FeatureKind kind);
  Response yes_or_no(Truth truth);
  bool is_sure(const std::string& id, const Nominal& scope) const;
  Response choice_of_clauses();
  Response partly();
  std::optional<binding::FeatureKind> kind_asked_for(const Nominal& quality) const;
  const Nominal* commonest_quality(const Nominal& asked) const;
  Response most_common(const Nominal& quality);
  Response values_seen(const Nominal& asked, const Nominal* region = nullptr);
  Response choice(const Nominal& subject, const Nominal& alternatives);

  // -- why a statement is not so (response_reasons.cpp)
  std::optional<LogicalForm> reason(const Nominal& said);
  std::optional<LogicalForm> exception(const Nominal& said, const Nominal& subject,
                                       const Nominal& scope);
  std::optional<LogicalForm> what_it_has(const std::string& id, const LogicalForm& owner,
                                         const Nominal& what);
  std::optional<LogicalForm> by_position(const std::string& id, const std::string& noun);

  // -- replies
  Response cannot_do_that() const;
  LogicalForm nothing_like(const Nominal& phrase) const;
  std::vector<Sentence> others_of_noun(const Nominal& phrase);
  LogicalForm as_it_is(const std::string& id, const LogicalForm& what, const Nominal& scope) const;
  LogicalForm denied(const std::string& id, const Nominal& scope) const;
  LogicalForm called(const Nominal& phrase) const;
  LogicalForm described(LogicalForm said);

  const Vocabulary& vocabulary() const { return scene_.vocabulary(); }

  const LogicalForm& form_;
  const Antecedents& antecedents_;
  SceneKnowledge& scene_;
  Evaluation evaluation_;
};

} // namespace castor::communication
