#pragma once

#include "castor/binding/types.hpp"
#include "castor/communication/types.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Translates noun phrases into binding's terms: the features of the thing described, and its
/// relations to other things.
namespace castor::communication {

/// What a noun phrase says of the first of the things described.
struct PhraseMeaning {
  binding::Description description;
  /// Words that say nothing in binding's terms, such as "old".
  std::vector<std::string> not_understood;
};

/// The phrase, and that what it describes is as `scope` says: a property, a region, a kind of thing
/// or several of them ("red", "left of the ball", "a cube").
///
/// \pre the phrase is a nominal of the form, of a thing
PhraseMeaning describe_as(const LogicalForm& form, const Nominal& phrase, const Nominal& scope);

/// The features in `scope` alone.
std::vector<binding::Feature> features_of(const LogicalForm& form, const Nominal& scope);

/// Whether it refers to one thing known to both speakers: "it", "the ball".
bool is_definite(const Nominal& nominal);

/// Whether the phrase stands for one thing or several that both know: "the balls", "neither".
bool is_definite_phrase(const Nominal& nominal);

/// "It", "this", "they"...
bool is_pronoun(const Nominal& nominal);

/// "This", "that": things that are shown rather than spoken of.
bool is_deictic(const Nominal& nominal);

/// The place of the word in its sentence that introduced a nominal, by its name: 3 for "w3".
std::size_t place_of_word(const Nominal& nominal);

/// "The others", "the other ball".
bool is_about_others(const LogicalForm& form, const Nominal& nominal);

/// "The two", "the three": as many things, which were spoken of.
bool is_counted_group(const LogicalForm& form, const Nominal& nominal);

/// "How many balls", "two balls": whether a number is said or asked for.
bool asks_for_number(const Nominal& nominal);

/// Whether parts of it are spoken of: "these" in "how many of these".
bool is_whole(const LogicalForm& form, const Nominal& nominal);

/// "That thing", "this red one": what it stands for may have been said before.
bool is_anaphoric(const Nominal& nominal);

/// The kind of feature for a quality ("colour", "size") or a sort of property; nothing if binding
/// has none.
std::optional<binding::FeatureKind> kind_of_quality(const std::string& name);

/// "Thing", "object" and other nouns that say nothing but that there is something.
bool is_general_noun(std::string_view noun);

/// Binding's word for the shape that a noun ("ball") or an adjective ("triangular") stands for;
/// nothing for others.
std::optional<std::string> shape_of_noun(std::string_view noun);
std::optional<std::string> shape_of_adjective(std::string_view adjective);

/// Whether a shape, in binding's words, is that of something flat: "circle".
bool is_flat_shape(std::string_view shape);

/// Binding's word for a spatial relation ("next_to" is "near"); nothing for others.
std::optional<std::string> relation_of_word(std::string_view word);

/// Whether binding has such relations wherever two things have places.
bool is_spatial_relation(std::string_view relation);

/// Where everything is that the robot sees.
bool is_the_table(const Nominal& nominal);

/// All things that a form speaks of and that might be perceived, from its root on: those that are
/// told something about first, others after them. Without those that are only said to be something,
/// as in "this is a ball".
std::vector<const Nominal*> things_spoken_of(const LogicalForm& form);

} // namespace castor::communication
