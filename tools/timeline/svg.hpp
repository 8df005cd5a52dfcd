#pragma once

#include "castor/tools/timeline/layout.hpp"

#include <string>

namespace castor::timeline {

/// The figure as an SVG picture that needs nothing else: letters, lines and embedded pictures. For
/// a page, its cards have the classes `card` and what became of the entry, and data-v, the number
/// of its version; its chips the class `chip` and data-i, the number of the chip; its arrows the
/// class `arrow`, data-a and data-b, the numbers of the cards at their ends.
std::string to_svg(const Figure& figure, const Layout& layout);

} // namespace castor::timeline
