#include "castor/communication/parsing/pauses.hpp"

#include <cstddef>

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
  IncrementalParse parse{parser};
  for (auto& word : words)
    parse.add(std::move(word));
  parse.finish();
  auto result = parse.form();
  if (!result.unparsable.empty() || result.readings.empty())
    return std::nullopt;
  return result;
}

} // namespace castor::communication
