#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace castor::timeline {

/// Font families of the timeline in CSS notation, the preferred one first.
inline constexpr const char* font_families = "Liberation Sans, Arial, Helvetica, sans-serif";

/// Width of one line of text at a font size in pixels, as Pango measures it with the first of
/// `font_families` that is installed, or what fontconfig takes instead.
double text_width(std::string_view text, double size, bool bold = false);

/// The text, or as much of it as fits with an ellipsis; at least the ellipsis.
std::string fitted(std::string_view text, double width, double size, bool bold = false);

/// The words in so many lines at most; the last one ends with an ellipsis if not all fit.
std::vector<std::string> wrapped(std::string_view text, double width, double size,
                                 std::size_t most_lines);

} // namespace castor::timeline
