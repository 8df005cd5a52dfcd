#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/descriptions.hpp"

#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

/// The possible unions of a description.
struct Candidates {
  /// Unions of which the whole description is known to be true.
  std::vector<std::string> certain;
  /// Unions that contradict nothing in the description; includes the certain ones.
  std::vector<std::string> possible;

  /// The certain ones, or the possible ones if there are none.
  const std::vector<std::string>& best() const& { return certain.empty() ? possible : certain; }
  std::vector<std::string> best() && { return std::move(certain.empty() ? possible : certain); }
};

/// Spatial relation of a thing to a landmark (a union id).
struct SpatialFact {
  std::string relation;
  std::string landmark;
  /// Distance in metres; negative if unknown.
  double distance = -1;
};

/// Cache of binding's answers about the scene. It collects the questions that it could not answer,
/// so that the caller can ask binding and try again:
///
///     for (auto answer = respond(...); !scene.open_questions().empty(); answer = respond(...))
///       scene.learn(open_questions, call<ReferenceRequest, ReferenceReply>(...));
class SceneKnowledge {
public:
  /// Empty, with an open question added, if binding has still to be asked.
  Candidates candidates(const LogicalForm& form, const PhraseMeaning& meaning,
                        const Antecedents& antecedents = {});

  /// Descriptions asked for and not known yet.
  const std::vector<binding::Description>& open_questions() const { return open_questions_; }

  /// \pre the reply has as many referents as were asked for
  void learn(std::span<const binding::Description> asked, binding::ReferenceReply reply);

  /// The unions of things, not of places and relations; empty before anything was learned.
  const std::vector<std::string>& things() const { return things_; }

  /// The proxy by which to refer to a union in the long term.
  std::string proxy_of(const std::string& union_id) const;

  /// The known words of a kind, perceived ones first.
  std::vector<std::string> words(const std::string& union_id, binding::FeatureKind kind) const;

  /// Spatial relations of a thing to others, the nearest first.
  std::vector<SpatialFact> spatial_facts(const std::string& union_id) const;

private:
  const binding::KnownUnion* find(const std::string& union_id) const;
  const std::vector<binding::Referents>* referents_of(const binding::Description& description);

  std::vector<std::pair<binding::Description, std::vector<binding::Referents>>> known_;
  std::vector<binding::Description> open_questions_;
  binding::ReferenceReply scene_;
  std::vector<std::string> things_;
};

/// The antecedents, and the referent of each unambiguous landmark: in "left of the box behind the
/// ball" the ball, and then the box.
Antecedents with_landmarks(const LogicalForm& form, Antecedents antecedents, SceneKnowledge& scene);

} // namespace castor::communication
