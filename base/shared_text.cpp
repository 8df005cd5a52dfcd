#include "castor/base/shared_text.hpp"

#include "castor/base/input_file.hpp"

#include <algorithm>
#include <stdexcept>

namespace castor {

NamedText read_or_shared(std::string_view kind, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<NamedText>& shared) {
  const auto file = folder / name;
  try {
    return {name, read_input_file(file)};
  } catch (const InputFileError& e) {
    const auto known = std::ranges::find(shared, name, &NamedText::name);
    if (known != shared.end() && e.reason() == InputFileError::Reason::missing)
      return *known;
    std::string names;
    for (auto& x : shared)
      names += (names.empty() ? "" : ", ") + x.name;
    throw std::runtime_error(std::string{kind} + ' ' + file.string() + " cannot be read: " +
                             e.what() + ". Name a file, or one that comes with Castor: " + names);
  }
}

} // namespace castor
