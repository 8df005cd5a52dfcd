#pragma once

#include <string>
#include <string_view>

namespace castor {

/// Escapes text for HTML and SVG, in text and in attributes; control characters become visible.
std::string escaped(std::string_view text);

} // namespace castor
