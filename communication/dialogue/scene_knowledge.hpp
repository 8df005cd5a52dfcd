#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/dialogue/descriptions.hpp"

#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

/// The unions that something described may be.
struct Candidates {
  /// All that is said of them is known.
  std::vector<std::string> certain;
  /// Nothing that is said of them is denied; the certain ones are among them.
  std::vector<std::string> possible;

  /// The certain ones, or those that may be if there are none.
  const std::vector<std::string>& best() const& { return certain.empty() ? possible : certain; }
  std::vector<std::string> best() && { return std::move(certain.empty() ? possible : certain); }
};

/// How a thing lies to another, by its union.
struct SpatialFact {
  std::string relation;
  std::string landmark;
  /// Between the two, metres; negative if that is not known.
  double distance = -1;
};

/// What binding has said of the scene. It remembers what it was asked for and did not know, so
/// that somebody can ask binding and try again:
///
///     for (auto answer = respond(...); !scene.open_questions().empty(); answer = respond(...))
///       scene.learn(open_questions, call<ReferenceRequest, ReferenceReply>(...));
class SceneKnowledge {
public:
  /// None, if binding has still to be asked.
  Candidates candidates(const LogicalForm& form, const PhraseMeaning& meaning,
                        const Antecedents& antecedents = {});

  /// What was asked for and is not known.
  const std::vector<binding::Description>& open_questions() const { return open_questions_; }

  /// \pre the reply has as many referents as were asked for
  void learn(std::span<const binding::Description> asked, binding::ReferenceReply reply);

  /// The unions of things, not of places and relations; empty before anything was learned.
  const std::vector<std::string>& things() const { return things_; }

  /// The proxy to keep hold of a union by.
  std::string proxy_of(const std::string& union_id) const;

  /// The words that are known, those that were perceived first.
  std::vector<std::string> words(const std::string& union_id, binding::FeatureKind kind) const;

  /// How a thing lies to others, the nearest of them first.
  std::vector<SpatialFact> spatial_facts(const std::string& union_id) const;

private:
  const binding::KnownUnion* find(const std::string& union_id) const;
  const std::vector<binding::Referents>* referents_of(const binding::Description& description);

  std::vector<std::pair<binding::Description, std::vector<binding::Referents>>> known_;
  std::vector<binding::Description> open_questions_;
  binding::ReferenceReply scene_;
  std::vector<std::string> things_;
};

/// The antecedents, and what is meant by each landmark of which there is only one: in "left of the
/// box behind the ball" the ball, and then the box.
Antecedents with_landmarks(const LogicalForm& form, Antecedents antecedents, SceneKnowledge& scene);

} // namespace castor::communication
