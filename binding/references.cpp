#include "castor/binding/references.hpp"

#include "castor/binding/features.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace castor::binding {

namespace {

struct Fit {
  const std::string* union_id = nullptr;
  std::uint32_t unknown = 0;
};

/// How many features are neither confirmed nor denied; nothing if any is denied.
std::optional<std::uint32_t> unknown_of(const DescribedThing& thing, const BindingUnion& of,
                                        const FeatureComparator& comparator) {
  std::uint32_t unknown = 0;
  for (const auto& described : thing.features) {
    if (described.kind == FeatureKind::existing_proxy_id && !described.negated) {
      if (std::find(of.proxy_ids.begin(), of.proxy_ids.end(), described.text) == of.proxy_ids.end())
        return std::nullopt;
      continue;
    }
    bool confirmed = false;
    for (const auto& known : of.features) {
      if (!comparator.may_compare(described.kind, known.kind))
        continue;
      if (comparator.compare(described, known) == Truth::no)
        return std::nullopt;
      confirmed |= comparator.confirms(known, described);
    }
    unknown += confirmed ? 0 : 1;
  }
  return unknown;
}

bool is_better(const Referents& a, const Referents& b) {
  return std::tie(a.unknown, a.unions) < std::tie(b.unknown, b.unions);
}

/// Assigns unions to the described things one after the other.
class Search {
public:
  Search(const Description& description, const std::map<std::string, BindingUnion>& unions,
         const FeatureComparator& comparator, const std::vector<UnionRelation>& relations)
    : description_(description), relations_(relations) {
    for (const auto& thing : description.things) {
      auto& fits = fits_.emplace_back();
      for (const auto& [id, of] : unions) {
        if (of.type == ProxyType::relation)
          continue;
        if (const auto unknown = unknown_of(thing, of, comparator))
          fits.push_back({&id, *unknown});
      }
    }
  }

  std::vector<Referents> run() {
    if (!description_.things.empty())
      assign();
    std::sort(found_.begin(), found_.end(), is_better);
    return std::move(found_);
  }

private:
  /// Of those relations whose ends are known by now.
  bool relations_hold() const {
    const std::size_t last = current_.unions.size() - 1;
    return std::all_of(
      description_.relations.begin(), description_.relations.end(), [&](const auto& x) {
        return std::max(x.from, x.to) != last ||
               std::ranges::binary_search(
                 relations_,
                 UnionRelation{x.label, current_.unions[x.from], current_.unions[x.to]});
      });
  }

  void assign() {
    if (current_.unions.size() == description_.things.size()) {
      found_.push_back(current_);
      return;
    }
    for (const auto& fit : fits_[current_.unions.size()]) {
      if (std::find(current_.unions.begin(), current_.unions.end(), *fit.union_id) !=
          current_.unions.end())
        continue;
      current_.unions.push_back(*fit.union_id);
      current_.unknown += fit.unknown;
      if (relations_hold())
        assign();
      current_.unknown -= fit.unknown;
      current_.unions.pop_back();
    }
  }

  const Description& description_;
  /// Sorted; may be empty if none is described.
  const std::vector<UnionRelation>& relations_;
  /// For each described thing.
  std::vector<std::vector<Fit>> fits_;
  Referents current_;
  std::vector<Referents> found_;
};

} // namespace

std::vector<UnionRelation> relations_between(const std::map<std::string, BindingUnion>& unions) {
  std::unordered_map<std::string_view, const std::string*> union_of;
  for (const auto& [id, of] : unions) {
    for (const auto& proxy : of.proxy_ids)
      union_of.emplace(proxy, &id);
  }
  std::vector<UnionRelation> result;
  for (const auto& [id, of] : unions) {
    if (of.type != ProxyType::relation)
      continue;
    for (const auto& feature : of.features) {
      if (feature.kind != FeatureKind::relation_label || feature.negated)
        continue;
      for (const auto& from : of.out_ports) {
        for (const auto& to : of.out_ports) {
          if (from.owner != to.owner || from.label != from_port || to.label != to_port)
            continue;
          const auto source = union_of.find(from.proxy);
          const auto target = union_of.find(to.proxy);
          if (source != union_of.end() && target != union_of.end())
            result.push_back({feature.text, *source->second, *target->second});
        }
      }
    }
  }
  std::ranges::sort(result);
  const auto repeated = std::ranges::unique(result);
  result.erase(repeated.begin(), repeated.end());
  return result;
}

std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator, std::size_t limit) {
  return find_referents(description, unions, comparator,
                        description.relations.empty() ? std::vector<UnionRelation>{}
                                                      : relations_between(unions),
                        limit);
}

std::vector<Referents> find_referents(const Description& description,
                                      const std::map<std::string, BindingUnion>& unions,
                                      const FeatureComparator& comparator,
                                      const std::vector<UnionRelation>& relations,
                                      std::size_t limit) {
  for (const auto& x : description.relations) {
    if (std::max(x.from, x.to) >= description.things.size())
      throw std::out_of_range("the relation " + x.label +
                              " is about a thing that the description "
                              "does not have");
  }
  auto result = Search(description, unions, comparator, relations).run();
  if (result.size() > limit)
    result.resize(limit);
  return result;
}

std::vector<Referents> distinct_referents(std::span<const Referents> all) {
  std::map<std::string, Referents> best;
  for (const auto& x : all) {
    const auto known = best.find(x.unions.front());
    if (known == best.end() || is_better(x, known->second))
      best.insert_or_assign(x.unions.front(), x);
  }
  std::vector<Referents> result;
  for (auto& [id, x] : best)
    result.push_back(std::move(x));
  std::sort(result.begin(), result.end(), is_better);
  return result;
}

} // namespace castor::binding
