#include "castor/tools/timeline/selection.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace castor::timeline {

namespace {

/// How much a type tells, the most telling first.
enum class KindRank { scene, linked_elsewhere, linked, few, books };

/// Types in a working memory.
using Kind = std::pair<std::string, std::string>;

/// Of a type that nothing refers to, so many are few.
constexpr std::size_t few_entries = 2;

class Selector {
public:
  Selector(const Figure& figure, const SelectionOptions& options)
    : figure_(figure), options_(options) {
    rank_types();
    for (std::size_t i = 0; i < figure.versions.size(); ++i)
      for (auto x : figure.versions[i].links)
        referring_[x].insert(figure.versions[i].entry);
  }

  std::vector<std::vector<Group>> select() {
    std::vector<std::vector<Group>> result(figure_.cells.size());
    for (std::size_t column = 0; column < figure_.columns.size(); ++column) {
      auto before = std::exchange(chosen_, {});
      for (std::size_t row = 0; row < figure_.rows.size(); ++row)
        result[row * figure_.columns.size() + column] =
          groups_of(figure_.cell(row, column), before);
    }
    return result;
  }

private:
  Kind kind_of(std::size_t entry) const {
    auto& x = figure_.entries[entry];
    return {x.address.subarchitecture, x.type};
  }

  std::size_t entry_of(const CellEntry& x) const { return figure_.versions[x.version].entry; }

  void rank_types() {
    for (auto& cell : figure_.cells) {
      std::map<Kind, std::size_t> counts;
      for (auto& x : cell)
        ++counts[kind_of(entry_of(x))];
      for (auto& [kind, count] : counts) {
        auto& rank = ranks_.try_emplace(kind, KindRank::few).first->second;
        if (count > few_entries)
          rank = KindRank::books;
      }
    }
    for (auto& x : figure_.versions) {
      auto kind = kind_of(x.entry);
      for (auto i : x.links)
        if (auto linked = kind_of(i); linked != kind)
          improve(linked,
                  linked.first == kind.first ? KindRank::linked : KindRank::linked_elsewhere);
      if (!x.pictures.empty())
        improve(kind, KindRank::linked);
      if (std::ranges::any_of(
            x.pictures, [&](std::size_t i) { return figure_.pictures[i].width >= large_from; }))
        improve(kind, KindRank::scene);
    }
  }

  void improve(const Kind& x, KindRank rank) {
    auto& known = ranks_.try_emplace(x, rank).first->second;
    known = std::min(known, rank);
  }

  std::vector<Group> groups_of(const std::vector<CellEntry>& cell,
                               const std::set<std::size_t>& before) {
    std::vector<Group> result;
    for (auto& x : cell) {
      auto& type = figure_.entries[entry_of(x)].type;
      auto i = std::ranges::find(result, type, &Group::type);
      if (i == result.end())
        i = result.insert(i, {type, {}, {}});
      i->hidden.push_back(x);
    }
    auto rank = [&](const Group& x) { return ranks_.at(kind_of(entry_of(x.hidden.front()))); };
    std::ranges::stable_sort(result, {}, rank);
    std::size_t count = 0;
    for (auto& x : result) {
      if (rank(x) == KindRank::books)
        continue;
      choose(x, count, before);
      count += x.shown.size();
    }
    return result;
  }

  void choose(Group& group, std::size_t count, const std::set<std::size_t>& before) {
    auto candidates = std::exchange(group.hidden, {});
    // What came and went is nothing to look at.
    auto there = std::ranges::stable_partition(
      candidates, [](const CellEntry& x) { return x.fate != Fate::passed; });
    group.hidden.assign(there.begin(), there.end());
    candidates.erase(there.begin(), there.end());
    auto is_whole =
      candidates.size() <= options_.whole_group && count + candidates.size() <= options_.whole_cell;
    auto most = is_whole ? candidates.size() : std::min(options_.some, candidates.size());
    if (!is_whole)
      std::ranges::stable_sort(candidates, std::greater{},
                               [&](const CellEntry& x) { return worth(x, before); });
    auto end = candidates.begin() + static_cast<std::ptrdiff_t>(most);
    group.hidden.insert(group.hidden.begin(), end, candidates.end());
    candidates.erase(end, candidates.end());
    for (auto& x : candidates)
      chosen_.insert(entry_of(x));
    std::ranges::sort(candidates, {}, [&](const CellEntry& x) { return entry_of(x); });
    group.shown = std::move(candidates);
  }

  /// First of all the reader is to find again what there was, then see what is new, then why.
  std::tuple<bool, bool, bool> worth(const CellEntry& x,
                                     const std::set<std::size_t>& before) const {
    auto entry = entry_of(x);
    auto is_chosen = [&](std::size_t i) { return chosen_.count(i) > 0; };
    auto referring = referring_.find(entry);
    bool is_linked =
      std::ranges::any_of(figure_.versions[x.version].links, is_chosen) ||
      (referring != referring_.end() && std::ranges::any_of(referring->second, is_chosen));
    return {before.count(entry) > 0 && x.fate != Fate::gone,
            x.fate == Fate::added || x.fate == Fate::changed, is_linked};
  }

  const Figure& figure_;
  const SelectionOptions& options_;
  std::map<Kind, KindRank> ranks_;
  /// Who has ever referred to an entry.
  std::map<std::size_t, std::set<std::size_t>> referring_;
  /// In the stage that is looked at.
  std::set<std::size_t> chosen_;
};

} // namespace

std::vector<std::vector<Group>> select(const Figure& figure, const SelectionOptions& options) {
  return Selector{figure, options}.select();
}

} // namespace castor::timeline
