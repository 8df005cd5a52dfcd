#pragma once

#include "castor/wm/filters/change_filter.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

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
/// for instance `overwritten SceneObject in vision changing pose where confidence > 0.8`. Without
/// `in` it applies to all subarchitectures; the empty text matches every change. Throws
/// ChangeFilterError, whose message has the remedy.
ChangeFilter parse_change_filter(std::string_view text);

/// The text of a filter, for `parse_change_filter`. The notation has no filters for the own
/// subarchitecture: they are written as filters for all.
std::string change_filter_text(const ChangeFilter& x);

} // namespace castor
