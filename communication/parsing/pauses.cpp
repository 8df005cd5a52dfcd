#include "castor/communication/parsing/pauses.hpp"

#include <cstddef>
#include <utility>

namespace castor::communication {

std::optional<PackedLogicalForm> parsed_with_pause(Parser& parser, std::vector<std::string> words,
                                                   const PackedLogicalForm& form) {
  if (form.unparsable.size() != 1)
    return std::nullopt;
  const auto position = static_cast<std::size_t>(form.unparsable.front().first_word);
  if (position == 0 || position >= words.size() || words[position] == "," ||
      words[position - 1] == ",")
    return std::nullopt;
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(position), ",");
  return parser.parse_whole(std::move(words));
}

} // namespace castor::communication
