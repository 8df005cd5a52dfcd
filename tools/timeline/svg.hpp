#pragma once

#include "castor/tools/timeline/layout.hpp"

#include <string>

namespace castor::timeline {

/// The figure as a self-contained SVG picture. For scripts of a page, cards have the classes `card`
/// and the name of their Fate, and data-v, the index of the version; chips have the class `chip`
/// and data-i, the index of the chip; arrows have the class `arrow`, data-a and data-b, the indices
/// of the cards at their ends.
std::string to_svg(const Figure& figure, const Layout& layout);

} // namespace castor::timeline
