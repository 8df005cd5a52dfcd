#pragma once

#include "castor/tools/timeline/layout.hpp"

#include <string>

namespace castor::timeline {

/// A page that needs no other file and no network: the picture of `to_svg`, in which a click on an
/// entry shows all of it and one on a number what is counted there.
std::string to_page(const Figure& figure, const Layout& layout);

} // namespace castor::timeline
