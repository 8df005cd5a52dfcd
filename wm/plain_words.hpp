#pragma once

#include <exception>
#include <string>

namespace castor {

/// What an exception says, for people: what those of the standard library and of JSON say in their
/// own words is said in ours, with the path that it is about.
std::string plain_words(const std::exception& x);

} // namespace castor
