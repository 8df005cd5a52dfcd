#pragma once

#include "castor/communication/dialogue/evaluation.hpp"
#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace castor::communication {

/// Unions, of which so many are meant; 0 for all.
struct MeantThings {
  std::vector<std::string> things;
  std::int32_t number = 0;
};

std::vector<std::string> all_but(std::vector<std::string> things,
                                 const std::vector<std::string>& others);

/// What the phrases of a request stand for, one step after the other.
///
/// \throws Uninterpretable from every function if it is not clear what is meant, or nothing like it
/// is there
class DirectiveThings {
public:
  using Things = std::vector<std::string>;

  /// All of them have to outlive it.
  DirectiveThings(const LogicalForm& form, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(form), antecedents_(antecedents), scene_(scene), evaluation_(form, antecedents, scene) {
  }

  /// What is to be handled: what pronouns of the next step stand for.
  MeantThings things(const Nominal& phrase);
  /// The same, but for pronouns of the next step.
  MeantThings things_of(const Nominal& phrase);
  /// "Next to the ball" is next to the other one, if a ball is to be put there.
  Things landmarks_of(const Nominal& phrase, const Things& patients);
  /// From the bottom: in the order in which they are named, else the widest first, and what nothing
  /// stays on last. "With the green one at the bottom" says which is first.
  MeantThings in_stacking_order(const Nominal& patient, const Nominal& x, MeantThings meant);
  /// "In a row, starting with the yellow one": that first, the others as they lie. Nothing if no
  /// end of the row is named.
  std::optional<Things> from_left(const Nominal& x, const Things& things);
  /// Any of those that are like it, if it is not clear which: what is put down is held, and what is
  /// put back was moved, which tells.
  MeantThings one_of_like(const Nominal& phrase);

  Things proxies(const Things& unions) const;

  /// A step ends: pronouns of the next one stand for its things.
  /// \param names_things whether there are any
  void end_step(bool names_things);
  /// "Stack the cubes, and put the ball in front of the tower": what stands below in it.
  void note_stack(const std::string& bottom) { stack_ = {bottom}; }
  void note_landmarks(const Things& landmarks) { landmarks_before_ = landmarks; }
  /// Those of the step before.
  const Things& landmarks_before() const { return landmarks_before_; }
  /// "If there is a ball on the left, take it": a clause that a step depends on, or is asked for
  /// because of, says what its pronouns stand for.
  void note_clause(const Nominal& clause);

  Evaluation& evaluation() { return evaluation_; }

private:
  const Vocabulary& vocabulary() const { return scene_.vocabulary(); }

  MeantThings things_named(const Nominal& phrase);
  bool names_nothing_seen(const Nominal& phrase);
  Things bottom_of_stack(const Nominal& phrase);
  Things whole_stack(const Nominal& phrase);
  LogicalForm with_thing_for(const Nominal& phrase) const;
  Things as_thing(const Nominal& phrase);
  std::optional<std::string> named_before(const Nominal& phrase);
  Things ends_named(const Nominal& phrase, const Things& things);
  Things only_other_before(const Nominal& pronoun, const Things& patients);
  Things nearest_of(const MeantThings& all, const Things& patients) const;
  Things of_before(const Nominal& phrase);
  std::optional<MeantThings> of_step_before(const Nominal& phrase) const;
  std::optional<MeantThings> of_steps_together(const Nominal& phrase) const;
  std::optional<MeantThings> of_clause(const Nominal& phrase) const;
  Things all_but_those_before(const Nominal& phrase);
  Things all_but_landmarks(const Nominal& phrase);
  std::optional<MeantThings> besides(const Things& those, const std::string& noun,
                                     const Nominal& phrase);
  std::string head_noun(const Nominal& phrase) const;
  MeantThings all_or_one_of(const Nominal& phrase);
  MeantThings indefinite(const Nominal& phrase);
  bool is_shared_out(const Nominal& phrase) const;
  std::int32_t number_of(const Nominal& phrase, std::size_t all) const;

  const LogicalForm& form_;
  const Antecedents& antecedents_;
  SceneKnowledge& scene_;
  Evaluation evaluation_;
  /// What the step before was about, and what this one is.
  std::optional<MeantThings> last_;
  MeantThings current_;
  /// What all steps before were about, and the noun of the last of them.
  Things of_steps_;
  std::string noun_;
  /// Whether these are several in the singular: "each cube".
  bool is_last_each_ = false;
  bool is_current_each_ = false;
  /// What the request has named so far.
  Things mentioned_;
  /// "One of the balls ..., and the other one ...": those of a kind that are not chosen yet.
  std::optional<Things> remaining_;
  /// What the things of the step before were put at.
  Things landmarks_before_;
  /// What stands below in what the request has stacked.
  Things stack_;
  /// What a clause beside the request is about: its subject, and all of its things.
  std::optional<MeantThings> subject_;
  MeantThings of_whole_clause_;
};

} // namespace castor::communication
