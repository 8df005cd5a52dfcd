#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/words.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <vector>

namespace castor::cast {

/// Reads the options at the end of a component line: keys begin with a dash, the next word without
/// one is the key's value, a key without a value gets "true", and a word that begins with `#` ends
/// the line. A value that begins with a double quote goes on until a word ends with one; its words
/// are joined by single blanks and the quotes are removed. There are no escapes.
///
/// Values without a key and unterminated quotes are errors; repeated keys, of which the last
/// counts, and negative numbers, which are keys, get warnings.
std::vector<OptionSetting> parse_arguments(WordStream& words, const StructureLine& line,
                                           DiagnosticLog& log);

} // namespace castor::cast
