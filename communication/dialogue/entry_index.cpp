#include "castor/communication/dialogue/entry_index.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

namespace castor::communication {

namespace {

/// "Lying" in "lying on the table": what it goes with means as much without it.
bool says_nothing(const LexicalEntry& entry, const Lexicon& lexicon) {
  const auto& category = lexicon.categories()[entry.category];
  return entry.predications.empty() && !category.arguments.empty() &&
         category.arguments.back().category == without_last_argument(category);
}

} // namespace

EntryIndex::EntryIndex(const Lexicon& lexicon) {
  std::map<Key, std::size_t> frequency;
  for (const auto& entry : lexicon.entries())
    for (const auto& predication : entry.predications)
      ++frequency[key_of(predication)];
  std::set<std::tuple<std::string_view, CategoryId, std::vector<Predication>>> known;
  for (std::uint32_t number = 0; number < lexicon.entries().size(); ++number) {
    const auto& entry = lexicon.entry(number);
    if (says_nothing(entry, lexicon) ||
        !known.emplace(entry.family, entry.category, entry.predications).second)
      continue;
    if (entry.predications.empty() || entry.phrase == quoted_word) {
      always_.push_back(number);
      continue;
    }
    const auto rarest = std::ranges::min_element(
      entry.predications, {}, [&](const auto& x) { return frequency.at(key_of(x)); });
    entries_[key_of(*rarest)].push_back(number);
  }
}

EntryIndex::Key EntryIndex::key_of(const Predication& predication) {
  return {predication.kind, predication.name, predication.value};
}

std::vector<std::uint32_t> EntryIndex::candidates(std::span<const Predication> said) const {
  auto result = always_;
  std::set<Key> keys;
  for (const auto& predication : said)
    keys.insert(key_of(predication));
  for (const auto& key : keys)
    if (const auto found = entries_.find(key); found != entries_.end())
      result.insert(result.end(), found->second.begin(), found->second.end());
  std::ranges::sort(result);
  return result;
}

} // namespace castor::communication
