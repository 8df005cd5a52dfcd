#pragma once

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace castor::communication {

/// Whether a word is one of those.
inline bool is_among(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

} // namespace castor::communication
