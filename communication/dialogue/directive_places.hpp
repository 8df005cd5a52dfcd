#pragma once

#include "castor/communication/dialogue/vocabulary.hpp"
#include "castor/communication/types.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// A place that a phrase such as "next to the box" or "at the left edge of the table" names.
struct PlacePhrase {
  /// As in DirectivePlace.
  std::string relation;
  /// Phrase for the landmarks; null if there are none.
  const Nominal* landmark = nullptr;
  /// How far to a side, metres; 0 if nothing is said.
  double distance = 0;
};

/// The places that a destination names, all of which are to hold: "in front of the box and left of
/// the ball" has two.
///
/// \param destination a region, a place or several of them
/// \throws Uninterpretable if there is no such place
std::vector<PlacePhrase> places_named(const LogicalForm& form, const Nominal& destination,
                                      const Vocabulary& vocabulary);

/// The part of what things are on that a phrase such as "the left side" stands for.
/// \throws Uninterpretable for what is no such part
PlacePhrase part_named(const LogicalForm& form, const Nominal& part, const Vocabulary& vocabulary);

/// The part where something goes that is to be away from one.
std::string part_away_from(std::string_view part);

/// "right" for "left", "back" for "front", and the other way round; nothing for what is no side.
std::optional<std::string_view> opposite_of(std::string_view side);

} // namespace castor::communication
