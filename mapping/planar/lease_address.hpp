#pragma once

#include "castor/wm/entries/address.hpp"

#include <optional>
#include <stdexcept>
#include <string>

namespace castor::mapping {

/// Address written as SUBARCHITECTURE/ID; nothing if the text is empty.
/// \throws std::invalid_argument if it is written otherwise.
inline std::optional<Address> address_of(const std::string& text) {
  if (text.empty())
    return std::nullopt;
  const auto slash = text.find('/');
  if (slash == 0 || slash == text.npos || slash + 1 == text.size())
    throw std::invalid_argument("'" + text +
                                "' is no address of an entry; write "
                                "SUBARCHITECTURE/ID");
  return Address{text.substr(0, slash), text.substr(slash + 1)};
}

} // namespace castor::mapping
