#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// One word of an option variable: a name, unset by an odd number of exclamation marks before it.
struct OptionFlag {
  std::string_view name;
  bool set = true;
};

/// Splits at blanks. Words of exclamation marks only are no flags and are left out.
std::vector<OptionFlag> parse_flags(std::string_view text);

enum class Merge {
  /// Flags that are present take their new state, in their old place.
  replace,
  /// Flags that are present keep their state.
  keep
};

/// The text of `current` with the flags of `changes` merged in; absent ones are appended. Each word
/// is followed by a blank, the last one too: that is how the language has always done it, and a
/// comparison by IFEQ can tell.
std::string merge_flags(std::string_view current, std::string_view changes, Merge merge);

/// Whether any, or all, of the wanted flags have the wanted state in `value`. A flag that is absent
/// there is unset; of one that occurs twice the first counts. With no wanted flags, all is true and
/// any is false.
bool matches_any_flag(std::string_view value, std::string_view wanted);
bool matches_all_flags(std::string_view value, std::string_view wanted);

} // namespace castor::cast
