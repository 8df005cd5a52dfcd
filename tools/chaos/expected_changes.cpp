#include "castor/tools/chaos/expected_changes.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/rounded.hpp"
#include "castor/wm/entries/change_event.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace castor::faults {

namespace {

/// Whether the entry is as changes that the filter matches leave it.
bool is_so(ChangeFilter filter, const Entry& entry) {
  filter.operation.reset();
  filter.source.clear();
  filter.changing.clear();
  ChangeEvent event;
  event.operation = Operation::overwrite;
  event.address = entry.address;
  event.type = entry.value.type_ptr();
  return matches(filter, event, entry.value);
}

} // namespace

std::vector<ChangeFilter> ExpectedChanges::filters() const {
  std::vector<ChangeFilter> result;
  for (const auto& x : each_) {
    result.push_back(x.begin);
    result.push_back(x.end);
  }
  return result;
}

void ExpectedChanges::note(std::size_t filter, const Address& entry) {
  const std::lock_guard guard{mutex_};
  auto& seen = entries_.at(filter / 2)[entry];
  (filter % 2 == 0 ? seen.begin : seen.end) = true;
}

void ExpectedChanges::note(const Entry& entry) {
  for (std::size_t i = 0; i < each_.size(); ++i) {
    if (is_so(each_[i].begin, entry))
      note(2 * i, entry.address);
    if (is_so(each_[i].end, entry))
      note(2 * i + 1, entry.address);
  }
}

bool ExpectedChanges::is_complete() const {
  const std::lock_guard guard{mutex_};
  return std::ranges::all_of(entries_, [](const auto& statement) {
    return std::ranges::all_of(statement,
                               [](const auto& x) { return x.second.end || !x.second.begin; });
  });
}

std::size_t ExpectedChanges::begun() const {
  const std::lock_guard guard{mutex_};
  std::size_t result = 0;
  for (const auto& statement : entries_)
    result += static_cast<std::size_t>(
      std::ranges::count_if(statement, [](const auto& x) { return x.second.begin; }));
  return result;
}

Timestamp ExpectedChanges::patience() const {
  Timestamp result{0};
  for (const auto& x : each_)
    result = std::max(result, x.within);
  return result;
}

std::vector<std::string> ExpectedChanges::violations() const {
  constexpr std::size_t most_named = 5;
  const std::lock_guard guard{mutex_};
  std::vector<std::string> result;
  for (std::size_t i = 0; i < each_.size(); ++i) {
    std::vector<std::string> missing;
    for (const auto& [entry, seen] : entries_[i])
      if (seen.begin && !seen.end)
        missing.push_back(to_string(entry));
    if (!missing.empty())
      result.push_back(fmt::format("{}: {}: {} did not: {}", to_string(each_[i].where),
                                   each_[i].line, counted(missing.size(), "entry", "entries"),
                                   list_of(missing, most_named)));
  }
  return result;
}

} // namespace castor::faults
