#pragma once

#include <string>
#include <vector>

/// Clauses about whether something can be done, without "if".
namespace castor::communication {

/// "That is not possible", "there is no room behind it", "the place is occupied".
/// \param words in the form returned by words_of()
bool says_it_fails(const std::vector<std::string>& words);

/// "You can", "there is enough room", "possible": of what was said before, and of nothing else.
bool says_it_succeeds(const std::vector<std::string>& words);

} // namespace castor::communication
