#pragma once

#include "castor/tools/timeline/layout.hpp"

#include <string>

namespace castor::timeline {

/// A self-contained page: the picture of `to_svg`, in which a click on an entry shows all of its
/// content, and a click on a number the entries counted there.
std::string to_page(const Figure& figure, const Layout& layout);

} // namespace castor::timeline
