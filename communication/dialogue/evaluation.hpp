#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/dialogue/truth.hpp"
#include "castor/communication/types.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::communication {

/// Why a form has no truth value in a scene.
struct Uninterpretable {
  enum class Reason {
    /// `what` has no meaning here.
    word,
    /// There is nothing like the definite phrase whose nominal is `what`.
    nothing_like,
    /// Several things are like it, and one is meant.
    ambiguous,
    /// Several things may be like it, and one is meant.
    unknown,
    /// Nothing like it is where somebody points.
    nothing_pointed_at,
    /// Nobody knows what there is of its kind.
    unknown_kind,
    /// A clause that a request depends on is not so.
    not_so,
  };

  Reason reason = Reason::word;
  std::string what;
};

/// Which things fit a phrase.
struct Fitting {
  /// All that is said of them is known to be so.
  std::vector<std::string> certain;
  /// Nothing that is said of them is known to be otherwise; the certain ones are among them.
  std::vector<std::string> possible;

  /// The certain ones, or those that may be if there are none.
  const std::vector<std::string>& best() const { return certain.empty() ? possible : certain; }

  Truth contains(const std::string& id) const {
    if (std::ranges::find(certain, id) != certain.end())
      return Truth::yes;
    return std::ranges::find(possible, id) != possible.end() ? Truth::unknown : Truth::no;
  }

  void add(const std::string& id, Truth fits) {
    if (fits != Truth::no)
      possible.push_back(id);
    if (fits == Truth::yes)
      certain.push_back(id);
  }

  Count count() const { return {certain.size(), possible.size()}; }
};

/// What a logical form says of a scene, in Kleene's logic of three values. Quantifiers of subjects
/// have scope over negation: "some things are not red".
///
/// \throws Uninterpretable from every function: nothing is guessed at
class Evaluation {
public:
  /// All of them have to outlive the evaluation.
  Evaluation(const LogicalForm& form, const Antecedents& antecedents, SceneKnowledge& scene)
    : form_(form), antecedents_(antecedents), scene_(scene) {}

  /// Whether a clause is so: an ascription, existence, possession, or several of them.
  Truth clause(const Nominal& e);

  /// Whether a clause is so if what is rather beside a thing than behind it counts as behind it,
  /// too, and so for all sides.
  Truth clause_with_wide_sides(const Nominal& e);

  /// \throws Uninterpretable if there is not what the definite phrases of the form and those with
  /// "all" and "most" take for granted, wherever they are
  void check_presuppositions();

  /// Of which things a clause is true if they stand for one of its phrases: what a question asks
  /// for. Only things that fit the phrase, too.
  Fitting answers(const Nominal& e, const Nominal& asked);

  /// Of which things a clause is true if its subject stands for them, whatever that may mean.
  Fitting subjects(const Nominal& e, const Nominal& subject);

  /// The things that a phrase describes, its determiner aside.
  Fitting described(const Nominal& phrase);

  /// Whether a thing is as `scope` says: a property, a region, a kind of thing, a comparison.
  /// \param among the phrase that the thing is one of; null if any
  Truth is(const std::string& id, const Nominal& scope, const Nominal* among = nullptr);

  /// The sides of the table that a thing is on, "left" and "front", or "centre"; empty if nobody
  /// knows where it is.
  std::vector<std::string> sides_of(const std::string& id);

  /// Whether the phrase stands for who is spoken to, of whom somebody tells, or for who is with
  /// them: "you", "we", "I".
  bool is_addressee(const Nominal& phrase);

  /// The things that a definite phrase means, which exist: one if it is singular. None while
  /// binding has not been asked.
  std::vector<std::string> meant(const Nominal& phrase);

  /// The things that a subject means together, such as "the ball and the cubes".
  std::vector<std::string> members(const Nominal& subject);

  /// Whether `scope` is true of as many of the things that the phrase describes as it says.
  /// \param landmarks what `scope` compares others with, of which it says nothing
  Truth quantified(const Nominal& phrase, const std::function<Truth(const std::string&)>& scope,
                   const std::vector<std::string>& landmarks = {});

  /// Whether an ascription is so of a thing, if that is its subject.
  Truth is_so_of(const Nominal& ascription, const std::string& id);

  /// "A box", "one of the towers": what things are in.
  bool is_container_phrase(const Nominal& phrase);

  /// How many of the things that a phrase describes are in a container.
  Count number_inside(const std::string& container, const Nominal& phrase);

private:
  using Property = std::function<Truth(const std::string&)>;
  using Things = std::vector<std::string>;

  // -- clauses
  Truth affirmed_clause(const Nominal& e);
  Truth ascription(const Nominal& e);
  Truth about_qualities(const Nominal& subject, const Nominal& scope);
  Truth existence(const Nominal& subject);
  const Nominal* pronoun_in(const Nominal& phrase);
  std::optional<Truth> one_and_its_own(const Nominal& one, const Nominal& other);
  static Truth compared(const std::string& word, const Count& a, const Count& b);
  Truth compared_counts(const Nominal& subject, const Nominal& quantity);
  bool is_of_any_number(const Nominal& subject);
  bool is_as_before(const Nominal& subject, const Nominal& comparison);
  Truth collectively(const Nominal& subject, const Nominal& comparison);
  Truth are_near_each_other(const Nominal& subject);
  Truth has(const std::string& id, const Nominal& scope);

  // -- containers and what is in them (evaluation_containers.cpp)
  bool is_in_each(const Nominal& container);
  Truth there_are(const Nominal& subject, const Property& scope);
  Truth contains_both(const std::string& container, const Nominal& both_of);
  Nominal with_bound_of(const Nominal& first, Nominal next);
  Truth has_end(const std::string& container, const Nominal& end);
  Truth contains(const std::string& container, const Nominal& what);
  Truth only_these(const Nominal& phrases, const Nominal& first, const Property& scope);
  Truth in_each(const Nominal& subject, const Nominal& region, const Nominal& container);
  std::optional<Truth> are_in_one(const Nominal& subject, const Nominal& scope);
  std::optional<Truth> of_own_things(const Nominal& phrase, const Property& scope);
  std::optional<Truth> agreed_by_all(const Nominal& phrase, const Property& scope);
  Truth has_some_of_each(const Nominal& what);
  static bool is_after_noun(const Nominal& phrase, const std::string& modifier);
  Truth accompanied(const std::string& id, const Nominal& phrase, const Nominal& what);
  Truth discourse(const Nominal& first, const Nominal& next);
  Truth definite_inside(const Nominal& phrase, const Property& scope);
  bool is_outside(const std::string& id, const Nominal& phrase);
  bool is_container(const std::string& id) { return !scene_.contents(id).empty(); }
  bool is_container_noun(const std::string& noun);
  /// The feature of what is called so.
  binding::Feature named(const std::string& noun) const;
  bool has_containers();
  std::optional<Truth> is_named_by_sense(const std::string& id, const Nominal& phrase);
  Things items(const std::string& container);

  // -- what is said of several things together (evaluation_together.cpp)
  const Nominal* collective_modifier(const Nominal& phrase);
  Truth collectively(const Nominal& phrase, const Nominal& modifier, const Property& scope);
  bool is_of_comparisons(const Nominal& scope);
  Truth ascription_of_each(const Nominal& e, const Nominal& scopes);
  bool is_only_plural(const Nominal& phrase);
  Truth are_the_only(const Nominal& subject, const Nominal& only);
  bool is_the_other_of(const Nominal& one, const Nominal& other);
  Truth one_and_the_other(const Nominal& first, const Nominal& next);
  Truth of_some_together(const Nominal& subject, const Nominal& comparison);
  Things compared_together(const Nominal& subject);
  Truth distinct_values(const Things& things, const Nominal& quality);
  std::optional<std::string> value_of(const std::string& id, const Nominal& quality);
  Truth compares_with_before(const std::string& id, const Nominal& comparison);
  Truth differs_from_context(const std::string& id, const Nominal& comparison);

  // -- places in containers (evaluation_places.cpp)
  bool is_side_of_container(const Nominal& phrase);
  bool is_side(const Nominal& phrase) const;
  bool is_corner(const Nominal& phrase) const;
  bool is_end_of_some(const Nominal& phrase);
  std::optional<Truth> is_in_container_part(const std::string& id, const Nominal& region);
  Truth touches(const std::string& id, const Nominal& region, const Nominal& anchor);
  Truth touches_side(const std::string& id, const Nominal& side, double slack);
  Truth touches_thing(const std::string& a, const std::string& b, double slack);
  Truth is_at_end(const std::string& id, const std::string& container, bool top);
  Truth of_own_container(const std::string& id, const Nominal& container, const Property& scope);
  Truth is_between_some(const std::string& id, const Nominal& anchor);
  Truth is_in_middle(const std::string& id, const std::string& container);
  bool is_mutual(const Nominal& region);
  std::optional<Truth> is_with_the_others(const std::string& id, const Nominal& phrase,
                                          const Nominal& region);

  // -- what was spoken of before (evaluation_pronouns.cpp)
  Things antecedents_of(const std::string& name);
  Fitting members_of_pronoun(const Nominal& phrase);
  Things pointed_out_before(const Nominal& phrase);
  const Nominal* earlier_phrase(const Nominal& pronoun);
  Fitting handled_before(const Nominal& pronoun);
  const Nominal* phrase_in_predicate(const Nominal& pronoun);
  const Nominal* patient_described_by(const Nominal& pronoun);
  const Nominal* phrase_in_request(const Nominal& pronoun);

  // -- phrases
  const Things& candidates(const Nominal& phrase);
  const Nominal* room_asked_beside(const Nominal& asked) const;
  void check_place_of_other_kind(const std::string& relation, const Nominal& anchor);
  Truth unfocused(const Nominal& phrase, const Property& scope, const Things& landmarks = {});
  Fitting members_of(const Nominal& phrase);
  Fitting presupposed(const Nominal& x);
  void check_consistency(const std::vector<std::pair<const Nominal*, Fitting>>& phrases) const;
  bool exclude_each_other(const Nominal& a, const Nominal& b) const;
  bool has_pronoun(const Nominal& phrase) const;
  bool is_stack(const Nominal& x);
  bool is_other_than_subject(const Nominal& clause, const Nominal& x) const;
  Truth fits_but_for(const std::string& id, const Nominal& phrase, const Nominal& modifier);
  Truth fits(const std::string& id, const Nominal& phrase, bool with_selection = true);
  Truth is_called(const std::string& id, const Nominal& phrase);
  Truth has_shape(const std::string& id, const std::string& shape);
  Truth modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                 const Nominal& dependent);
  Truth as_modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                    const Nominal& dependent);
  Truth is_one_of(const std::string& id, const Nominal& phrase);
  static void check_coordination(const Nominal& x);
  bool is_pointed_at(const Nominal& phrase) const;
  Fitting members_pointed_at(const Nominal& phrase);
  static Count count(const Fitting& candidates, const Property& scope, const Things& landmarks);

  // -- properties
  Things landmarks_of(const Nominal& scope);
  Truth denial(const std::string& id, const Nominal& scope, Truth truth, const Nominal* among);
  Truth has_property(const std::string& id, const Nominal& property);
  Truth looks(const std::string& id, const WordMeanings::Look& look);
  Truth conjoined(const std::string& id, const Nominal& conjunction, const Nominal* among);
  Truth is_in(const std::string& id, const Nominal& region);
  Truth is_end_of_stack(const std::string& id, bool is_top);
  Things surroundings_of_addressee();
  Truth is_in_part_of_table(const std::string& id, const std::string& part);
  Truth is_related(const std::string& id, const std::string& relation, const Nominal& anchor);
  Truth is_between(const std::string& id, const Nominal& anchor);
  Truth is_directly(const std::string& id, const std::string& side, const std::string& other);
  Truth is_far(const std::string& id, const std::string& other);
  Truth is_selected(const std::string& id, const Nominal& selection, const Fitting& among,
                    std::size_t number = 1);
  std::size_t number_of_selected(const Nominal& phrase) const;
  std::optional<std::string> distinguished(const Nominal& phrase, const Things& certain);
  std::optional<std::string> distinguished_by_size(const Nominal& phrase);
  std::optional<std::string> distinguished_by_side(const Nominal& phrase);
  std::optional<std::string> outermost(const Things& things, const std::string& side) const;
  bool may_have_wide_sides();
  Fitting strict_answers(const Nominal& e, const Nominal& asked);
  Fitting outermost_answer(const Nominal& e, const Nominal& asked);
  Truth compares(const std::string& id, const Nominal& comparison);
  Truth compares_with_length(const std::string& id, const Nominal& comparison,
                             const Nominal& length);
  Truth compares_distances(const std::string& id, const Nominal& comparison, const Nominal& other);
  Truth shares(const std::string& a, const std::string& b, const std::string& quality);
  /// Whether something is to be done, and not only to be told.
  bool is_request() const;
  Truth is_more(const std::string& a, const std::string& b, const std::string& dimension,
                const Nominal* anchor);
  std::optional<double> measure(const std::string& id, const std::string& dimension,
                                const Nominal* anchor);

  const Nominal& need(const Nominal& of, const char* mode);
  [[noreturn]] static void not_understood(const std::string& word);

  const Vocabulary& vocabulary() const { return scene_.vocabulary(); }

  const LogicalForm& form_;
  const Antecedents& antecedents_;
  SceneKnowledge& scene_;
  /// What the nominals of clauses stand for that are asked about, or that relative clauses are
  /// about.
  std::map<std::string, std::string> bound_;
  /// The container that is spoken about: only what is in it is meant. Empty if there is none.
  std::string within_;
  /// The thing whose relation to others is looked at: what "a different colour" differs from.
  std::string related_;
  /// All that are compared together: what "the others" are others than.
  Things related_group_;
  /// Modifiers that are being evaluated. "The ball that is the largest" is so among balls: what is
  /// asked of them meanwhile leaves the modifier aside.
  std::set<std::string> modifiers_;
  /// Shapes that look alike may be meant, since nothing has the shape itself.
  bool is_lenient_ = false;
  /// What is rather on the next side of something may be meant, since nothing is straight there.
  bool has_wide_sides_ = false;
};

/// Numbers of things that a quantity such as "at least two" stands for; nothing for "several".
std::optional<NumberRange> number_range(const Nominal& quantity);

} // namespace castor::communication
