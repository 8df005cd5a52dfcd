#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/types.hpp"

#include <map>
#include <string>
#include <vector>

/// Noun phrases in words of binding: which features something has that is called like this, and how
/// it lies to other things.
namespace castor::communication {

/// Proxies of what is known to be meant, such as by a pronoun, by the names of their nominals.
using Antecedents = std::map<std::string, std::string>;

/// "The same colour as the ball": what the thing described has in common with another.
struct SharedQuality {
  binding::FeatureKind kind = binding::FeatureKind::colour;
  /// The name of the other's nominal.
  std::string with;

  friend bool operator==(const SharedQuality&, const SharedQuality&) = default;
};

/// What a noun phrase says of the first of the things described.
struct PhraseMeaning {
  binding::Description description;
  std::vector<SharedQuality> shared;
  /// Words that say nothing in binding's terms, such as "old".
  std::vector<std::string> not_understood;
};

/// \pre the nominal is one of the form, of a thing.
PhraseMeaning describe(const LogicalForm& form, const Nominal& phrase,
                       const Antecedents& antecedents = {});

/// The phrase, and that what it describes is as `scope` says: a property, a region, a kind of thing
/// or several of them ("red", "left of the ball", "a cube").
PhraseMeaning describe_as(const LogicalForm& form, const Nominal& phrase, const Nominal& scope,
                          const Antecedents& antecedents = {});

/// What `scope` alone says of a thing, as far as that are features.
std::vector<binding::Feature> features_of(const LogicalForm& form, const Nominal& scope);

/// Whether one thing is meant that both know: "it", "the ball".
bool is_definite(const Nominal& nominal);

/// "It", "this", "they"...
bool is_pronoun(const Nominal& nominal);

/// "This", "that": things that are shown rather than spoken of.
bool is_deictic(const Nominal& nominal);

/// The kind of feature that a quality ("colour", "size") or a sort of property is about; nothing
/// for what binding does not know.
std::optional<binding::FeatureKind> kind_of_quality(const std::string& name);

/// All things that a form speaks of and that might be perceived, from its root on: those that are
/// told something about first, others after them. Without those that are only said to be something,
/// as in "this is a ball".
std::vector<const Nominal*> things_spoken_of(const LogicalForm& form);

} // namespace castor::communication
