#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace castor::timeline {

/// How wide a text is in Helvetica, and in the letters that are made to its measure (Arial,
/// Liberation Sans), at a size; letters other than ASCII count as wide ones.
double text_width(std::string_view text, double size, bool bold = false);

/// The text, or as much of it as fits with an ellipsis.
std::string fitted(std::string_view text, double width, double size, bool bold = false);

/// The words in so many lines at most; the last one ends with an ellipsis if not all fit.
std::vector<std::string> wrapped(std::string_view text, double width, double size,
                                 std::size_t most_lines);

} // namespace castor::timeline
