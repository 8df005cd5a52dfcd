#pragma once

#include "castor/wm/entries/address.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

/// Values of the components' options.
namespace castor::mapping {

/// The file, in the working directory or else in the folder `base`.
inline std::filesystem::path file_named(const std::string& name, const std::string& base) {
  const std::filesystem::path path(name);
  std::error_code ignored;
  if (path.is_absolute() || base.empty() || std::filesystem::exists(path, ignored))
    return path;
  const auto based = std::filesystem::path(base) / path;
  return std::filesystem::exists(based, ignored) ? based : path;
}

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
