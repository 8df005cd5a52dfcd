#pragma once

#include <caf/fwd.hpp>

#include <exception>
#include <string>

namespace castor {

/// What an exception says, for people: what those of the standard library and of JSON say in their
/// own words is said in ours, with the path that it is about.
std::string plain_words(const std::exception& x);

/// What an error of an actor says: its text alone if it has one, else its code and category.
std::string plain_words(const caf::error& x, const caf::actor_system& system);

} // namespace castor
