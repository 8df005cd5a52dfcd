#pragma once

#include "castor/wm/filters/change_filter.hpp"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// The text is not a change filter.
class ChangeFilterError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Parses a filter in the users' notation:
///
///     [added | overwritten | deleted | changed] [TYPE] [in SUBARCHITECTURE] [from COMPONENT]
///     [at ID] [changing FIELD[,FIELD...]] [where PREDICATE]
///
/// for instance `overwritten SceneObject in vision changing pose where confidence > 0.8`. An id with
/// blanks is in quotes: `at "tile 3 -1"`. Without `in` it applies to all subarchitectures; the empty
/// text matches every change. Throws ChangeFilterError, whose message has the remedy.
ChangeFilter parse_change_filter(std::string_view text);

/// An id as the notation has it: in quotes if it has blanks.
std::string change_filter_word(std::string_view x);

/// The notation of a filter that is given by the arguments of a command line, where one argument is
/// an id, whatever blanks it has: {"at", "tile 3 -1"}.
std::string change_filter_text(const std::vector<std::string>& arguments);

/// The text of a filter, for `parse_change_filter`. The notation has no filters for the own
/// subarchitecture: they are written as filters for all.
std::string change_filter_text(const ChangeFilter& x);

} // namespace castor
