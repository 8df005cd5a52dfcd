#pragma once

#include "castor/base/named_text.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// Reads the file of that name in the folder; if there is none, returns the text of that name among
/// those that come with Castor. `kind` names such files in errors, "the ontology". Throws
/// std::runtime_error.
NamedText read_or_shared(std::string_view kind, const std::string& name,
                         const std::filesystem::path& folder, const std::vector<NamedText>& shared);

} // namespace castor
