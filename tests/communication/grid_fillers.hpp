#pragma once

#include "castor/tests/communication/grid_phrases.hpp"

#include <vector>

/// What the forms of the grid are filled with.
namespace castor::communication::test {

// -- orders

oracle::Before by_size(bool largest_first);
oracle::Before from_the_left();
oracle::Before from_the_right();
/// The one that is nearer to what is meant by `to` comes first.
oracle::Before nearer_to(const NounPhrase& to);

// -- phrases

std::vector<NounPhrase> nouns();
std::vector<Scope> places();
/// What is said of one thing or of several.
std::vector<Scope> scopes();
/// Not for single things that are known: "is the ball red or blue?" asks which.
std::vector<Scope> scopes_of_several();

// -- relations that sentences have besides

extern const Relation left;
extern const Relation near;

} // namespace castor::communication::test
