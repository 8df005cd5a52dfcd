#pragma once

#include "castor/wm/filters/change_filter.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

namespace castor {

/// A text that is no change filter.
class ChangeFilterError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

/// Reads a filter as people write it:
///
///     [added | overwritten | deleted | changed] [TYPE] [in SUBARCHITECTURE] [from COMPONENT]
///     [at ID] [changing FIELD[,FIELD...]] [where PREDICATE]
///
/// for instance `overwritten SceneObject in vision changing pose where confidence > 0.8`. Without
/// `in` it is for all subarchitectures; the empty text is for every change. Throws
/// ChangeFilterError, which says what to write.
ChangeFilter parse_change_filter(std::string_view text);

/// As `parse_change_filter` reads it. A filter for the own subarchitecture cannot be written; it is
/// written as one for all.
std::string change_filter_text(const ChangeFilter& x);

} // namespace castor
