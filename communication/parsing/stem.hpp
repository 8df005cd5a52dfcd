#pragma once

#include <string>

namespace castor::communication {

/// The stem of an English word, by Porter's second algorithm: "sort" of "sorted".
/// Source: https://snowballstem.org
std::string stem_of(const std::string& word);

} // namespace castor::communication
