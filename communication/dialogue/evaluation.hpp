#pragma once

#include "castor/communication/dialogue/scene_knowledge.hpp"
#include "castor/communication/dialogue/truth.hpp"
#include "castor/communication/types.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
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

  /// Of which things a clause is true if they stand for one of its phrases: what a question asks
  /// for. Only things that fit the phrase, too.
  Fitting answers(const Nominal& e, const Nominal& asked);

  /// The things that a phrase describes, its determiner aside.
  Fitting described(const Nominal& phrase);

  /// Whether a thing is as `scope` says: a property, a region, a kind of thing, a comparison.
  /// \param among the phrase that the thing is one of; null if any
  Truth is(const std::string& id, const Nominal& scope, const Nominal* among = nullptr);

  /// The things that a definite phrase means, which exist: one if it is singular. None while
  /// binding has not been asked.
  std::vector<std::string> meant(const Nominal& phrase);

  /// Whether `scope` is true of as many of the things that the phrase describes as it says.
  Truth quantified(const Nominal& phrase, const std::function<Truth(const std::string&)>& scope);

private:
  using Property = std::function<Truth(const std::string&)>;
  using Things = std::vector<std::string>;

  // -- clauses
  Truth affirmed_clause(const Nominal& e);
  Truth ascription(const Nominal& e);
  Truth about_qualities(const Nominal& subject, const Nominal& scope);
  Truth existence(const Nominal& subject);
  Truth compared_counts(const Nominal& subject, const Nominal& quantity);
  Truth collectively(const Nominal& subject, const Nominal& comparison);
  Truth are_near_each_other(const Nominal& subject);
  Truth has(const std::string& id, const Nominal& scope);
  Things members(const Nominal& subject);

  // -- phrases
  Truth unfocused(const Nominal& phrase, const Property& scope);
  Truth fits_but_for(const std::string& id, const Nominal& phrase, const Nominal& modifier);
  Truth fits(const std::string& id, const Nominal& phrase, bool with_selection = true);
  Truth is_called(const std::string& id, const Nominal& phrase);
  Truth has_shape(const std::string& id, const std::string& shape);
  const Nominal* earlier_phrase(const Nominal& pronoun);
  Truth modified(const std::string& id, const Nominal& phrase, const std::string& mode,
                 const Nominal& dependent);
  NumberRange wanted_number(const Nominal& phrase) const;
  Truth is_one_of(const std::string& id, const Nominal& phrase);
  static void check_coordination(const Nominal& x);
  Things antecedents_of(const std::string& name);
  Count count(const Nominal& phrase, const Property& scope);

  // -- properties
  Truth has_property(const std::string& id, const Nominal& property);
  Truth conjoined(const std::string& id, const Nominal& conjunction, const Nominal* among);
  Truth is_in(const std::string& id, const Nominal& region);
  Truth is_in_part_of_table(const std::string& id, const std::string& part);
  Truth is_related(const std::string& id, const std::string& relation, const Nominal& anchor);
  Truth is_between(const std::string& id, const Nominal& anchor);
  Truth is_selected(const std::string& id, const Nominal& selection, const Things& among);
  Truth compares(const std::string& id, const Nominal& comparison);
  Truth shares(const std::string& a, const std::string& b, const std::string& quality);
  Truth is_more(const std::string& a, const std::string& b, const std::string& dimension,
                const Nominal* anchor);
  std::optional<double> measure(const std::string& id, const std::string& dimension,
                                const Nominal* anchor);

  const Nominal& need(const Nominal& of, const char* mode);
  [[noreturn]] static void not_understood(const std::string& word);

  const LogicalForm& form_;
  const Antecedents& antecedents_;
  SceneKnowledge& scene_;
  /// What the nominals of clauses stand for that are asked about, or that relative clauses are
  /// about.
  std::map<std::string, std::string> bound_;
  /// Shapes that look alike may be meant, since nothing has the shape itself.
  bool is_lenient_ = false;
};

/// Numbers of things that a quantity such as "at least two" stands for; nothing for "several".
std::optional<NumberRange> number_range(const Nominal& quantity);

/// "Two" for 2; "many" for what there is no word for.
std::string number_word(std::size_t number);

} // namespace castor::communication
