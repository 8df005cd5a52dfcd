#include "castor/communication/dialogue/understanding.hpp"

#include "castor/communication/dialogue/likely_meaning.hpp"
#include "castor/communication/dialogue/partial_requests.hpp"
#include "castor/communication/dialogue/reparsing.hpp"
#include "castor/communication/dialogue/self_correction.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/spelling.hpp"

#include <utility>

namespace castor::communication {

PackedLogicalForm understood(Parser& parser, const std::vector<std::string>& said,
                             const std::function<void(const PackedLogicalForm&)>& heard) {
  auto words = self_corrected(said).value_or(said);
  auto corrections = correct_spelling(words, parser.lexicon());
  IncrementalParse parse{parser};
  for (const auto& word : words) {
    parse.add(word);
    if (heard)
      heard(parse.form());
  }
  parse.finish();
  auto form = parse.form();
  if (auto other = reparsed(parser, words, form))
    form = std::move(*other);
  else if (!is_understood(form)) {
    if (auto part = partly_understood(parser, said, words, corrections)) {
      form = std::move(*part);
      corrections.clear();
    } else
      form.mention = LikelyMeaning{parser, said}.mention();
  }
  form.corrections.insert(form.corrections.begin(), corrections.begin(), corrections.end());
  return form;
}

} // namespace castor::communication
