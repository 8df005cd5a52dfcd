#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/types.hpp"

#include <map>
#include <string>
#include <vector>

/// Translates noun phrases into binding's terms: the features of the thing described, and its
/// relations to other things.
namespace castor::communication {

/// Proxies of known referents, such as those of pronouns, by the names of their nominals.
using Antecedents = std::map<std::string, std::string>;

/// "The same colour as the ball": a quality that the thing described shares with another.
struct SharedQuality {
  binding::FeatureKind kind = binding::FeatureKind::colour;
  /// The name of the other's nominal.
  std::string with;

  friend bool operator==(const SharedQuality&, const SharedQuality&) = default;
};

/// Meaning of a noun phrase. The first thing of the description is the phrase's own.
struct PhraseMeaning {
  binding::Description description;
  std::vector<SharedQuality> shared;
  /// Words without an equivalent in binding's terms, such as "old".
  std::vector<std::string> not_understood;
};

/// \pre the nominal is one of the form, of a thing.
PhraseMeaning describe(const LogicalForm& form, const Nominal& phrase,
                       const Antecedents& antecedents = {});

/// The phrase with the predicate `scope` added: a property, a region, a kind of thing or several of
/// them ("red", "left of the ball", "a cube").
PhraseMeaning describe_as(const LogicalForm& form, const Nominal& phrase, const Nominal& scope,
                          const Antecedents& antecedents = {});

/// The features in `scope` alone.
std::vector<binding::Feature> features_of(const LogicalForm& form, const Nominal& scope);

/// Whether it refers to one thing known to both speakers: "it", "the ball".
bool is_definite(const Nominal& nominal);

/// "It", "this", "they"...
bool is_pronoun(const Nominal& nominal);

/// "This", "that": things that are shown rather than spoken of.
bool is_deictic(const Nominal& nominal);

/// The kind of feature for a quality ("colour", "size") or a sort of property; nothing if binding
/// has none.
std::optional<binding::FeatureKind> kind_of_quality(const std::string& name);

/// All perceivable things mentioned in a form, from its root on: subjects first. Without predicate
/// nouns, as "a ball" in "this is a ball".
std::vector<const Nominal*> things_spoken_of(const LogicalForm& form);

} // namespace castor::communication
