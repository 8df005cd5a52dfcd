#pragma once

#include <caf/fwd.hpp>

#include <exception>
#include <string>

namespace castor {

/// Message of an exception, for users. Messages of the standard library and of the JSON library are
/// reworded, and name the path concerned.
std::string plain_words(const std::exception& x);

/// Message of an actor's error: its text alone if it has one, else its code and category.
std::string plain_words(const caf::error& x, const caf::actor_system& system);

} // namespace castor
