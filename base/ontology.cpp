#include "castor/base/ontology.hpp"

#include "castor/base/suggestion.hpp"

#include <algorithm>
#include <optional>

namespace castor {

namespace {

constexpr std::size_t bits = 64;

using Bits = std::vector<std::uint64_t>;

bool has(const Bits& set, std::size_t number) {
  return number / bits < set.size() && ((set[number / bits] >> (number % bits)) & 1U) != 0;
}

void insert(Bits& set, std::size_t number) {
  set.resize(std::max(set.size(), number / bits + 1));
  set[number / bits] |= std::uint64_t{1} << (number % bits);
}

void insert(Bits& set, const Bits& more) {
  set.resize(std::max(set.size(), more.size()));
  for (std::size_t i = 0; i < more.size(); ++i)
    set[i] |= more[i];
}

void add_to(std::vector<std::string>& all, const std::string& x) {
  if (std::ranges::find(all, x) == all.end())
    all.push_back(x);
}

std::string double_quoted(std::string_view name) {
  return '"' + std::string{name} + '"';
}

} // namespace

/// Takes one statement after the other into an ontology, unless it contradicts those before.
struct Ontology::Builder {
  Ontology& made;
  const std::vector<ConceptStatement>& statements;

  /// A word that names no concept.
  std::optional<OntologyProblem> unknown_name(std::size_t number) const {
    const auto& x = statements[number];
    auto check = [&](const std::string& word) -> std::optional<OntologyProblem> {
      if (made.concepts_.contains(word))
        return std::nullopt;
      auto meant = did_you_mean(word, made.names());
      return OntologyProblem{number, word, double_quoted(word) + " is no concept",
                             meant.empty() ? "State what it is: concept " + word : meant};
    };
    for (const auto* words : {&x.is_a, &x.disjoint_with})
      for (const auto& word : *words)
        if (auto problem = check(word))
          return problem;
    return std::nullopt;
  }

  /// Names are made known first, so that the order of statements does not matter.
  bool introduce(const ConceptStatement& x) {
    if (made.concepts_.contains(x.name) || is_about_word(x))
      return true;
    if (made.concepts_.size() == max_concepts)
      return false;
    auto& known = made.concepts_[x.name];
    known.number = made.concepts_.size() - 1;
    insert(known.ancestors, known.number);
    return true;
  }

  /// Words that look alike need not be concepts.
  static bool is_about_word(const ConceptStatement& x) {
    return !x.alike.empty() && x.is_a.empty() && x.defined_by.empty() && x.disjoint_with.empty() &&
           !x.is_partitioned;
  }

  std::optional<OntologyProblem> take(std::size_t number) {
    const auto& x = statements[number];
    for (const auto& other : x.alike) {
      made.alike_.emplace_back(x.name, other);
      made.alike_.emplace_back(other, x.name);
    }
    if (is_about_word(x))
      return std::nullopt;
    auto& about = made.concepts_.at(x.name);
    for (const auto& parent : x.is_a)
      if (parent == x.name || made.is_kind_of(parent, x.name))
        return OntologyProblem{number, parent, "cycle of kinds: " + chain(parent, x.name),
                               "Leave one of these statements out."};
    if (made.disjoint_.size() + x.disjoint_with.size() > max_disjoint)
      return OntologyProblem{
        number, x.name, "there are more than " + std::to_string(max_disjoint) + " disjoint pairs",
        "Say of more general concepts that they exclude each other."};
    if (auto problem = contradiction(number))
      return problem;
    Bits more;
    for (const auto& parent : x.is_a) {
      add_to(about.parents, parent);
      insert(more, made.concepts_.at(parent).ancestors);
    }
    // What is a kind of a concept is a kind of all that it is a kind of.
    for (auto& [name, y] : made.concepts_)
      if (has(y.ancestors, about.number))
        insert(y.ancestors, more);
    for (const auto& property : x.defined_by)
      if (std::ranges::find(about.definition, property) == about.definition.end())
        about.definition.push_back(property);
    for (const auto& other : x.disjoint_with)
      made.disjoint_.emplace_back(about.number, made.concepts_.at(other).number);
    if (x.is_partitioned && !about.is_partitioned) {
      about.is_partitioned = true;
      made.partitioned_.push_back(x.name);
    }
    return std::nullopt;
  }

  /// A concept that would be of two kinds that exclude each other.
  std::optional<OntologyProblem> contradiction(std::size_t number) const {
    const auto& x = statements[number];
    const auto& about = made.concepts_.at(x.name);
    Bits more;
    for (const auto& parent : x.is_a)
      insert(more, made.concepts_.at(parent).ancestors);
    std::vector<std::pair<std::size_t, std::size_t>> added;
    for (const auto& other : x.disjoint_with)
      added.emplace_back(about.number, made.concepts_.at(other).number);
    for (auto& [name, y] : made.concepts_) {
      auto ancestors = y.ancestors;
      const bool is_changed = !x.is_a.empty() && has(ancestors, about.number);
      if (is_changed)
        insert(ancestors, more);
      for (const auto* pairs : {is_changed ? &made.disjoint_ : nullptr, &added})
        if (pairs != nullptr)
          for (auto [a, b] : *pairs)
            if (has(ancestors, a) && has(ancestors, b))
              return OntologyProblem{number, x.name, exclusion(name, name_of(a), name_of(b)),
                                     "Leave one of these statements out."};
    }
    return std::nullopt;
  }

  static std::string exclusion(const std::string& name, const std::string& a,
                               const std::string& b) {
    if (name != a && name != b)
      return double_quoted(name) + " is a kind of " + double_quoted(a) + " and of " + double_quoted(b) +
             ", which exclude each other";
    const auto& other = name == a ? b : a;
    return a == b ? double_quoted(name) + " excludes itself"
                  : double_quoted(name) + " is a kind of " + double_quoted(other) + ", which excludes it";
  }

  const std::string& name_of(std::size_t number) const {
    return std::ranges::find_if(made.concepts_,
                                [number](auto& x) { return x.second.number == number; })
      ->first;
  }

  /// "kitchen -> room -> kitchen".
  std::string chain(const std::string& from, const std::string& to) const {
    auto text = to + " -> " + from;
    auto current = from;
    while (current != to)
      for (const auto& parent : made.parents(current))
        if (made.is_kind_of(parent, to)) {
          current = parent;
          text += " -> " + current;
          break;
        }
    return text;
  }
};

Ontology::Ontology(const std::vector<ConceptStatement>& statements,
                   std::vector<OntologyProblem>* problems) {
  Builder builder{*this, statements};
  auto report = [problems](OntologyProblem problem) {
    if (problems != nullptr)
      problems->push_back(std::move(problem));
  };
  std::vector<bool> is_usable(statements.size(), true);
  for (std::size_t i = 0; i < statements.size(); ++i)
    if (statements[i].name.empty() || !builder.introduce(statements[i])) {
      is_usable[i] = false;
      report({i, statements[i].name,
              statements[i].name.empty()
                ? "the statement is about no concept"
                : "there are more than " + std::to_string(max_concepts) + " concepts",
              statements[i].name.empty() ? "Name one." : "Leave some out."});
    }
  for (std::size_t i = 0; i < statements.size(); ++i) {
    if (!is_usable[i])
      continue;
    auto problem = builder.unknown_name(i);
    if (!problem)
      problem = builder.take(i);
    if (problem)
      report(*std::move(problem));
  }
  std::ranges::sort(alike_);
  std::map<std::size_t, Concept*> by_number;
  for (auto& [name, x] : concepts_)
    by_number[x.number] = &x;
  for (auto& [name, x] : concepts_)
    for (auto& [number, y] : by_number)
      if (has(x.ancestors, number))
        insert(y->kinds, x.number);
}

const Ontology::Concept* Ontology::find(std::string_view name) const {
  const auto found = concepts_.find(name);
  return found == concepts_.end() ? nullptr : &found->second;
}

bool Ontology::is_kind_of(std::string_view special, std::string_view general) const {
  if (special == general)
    return true;
  const auto* a = find(special);
  const auto* b = find(general);
  return a != nullptr && b != nullptr && has(a->ancestors, b->number);
}

bool Ontology::excludes(std::string_view a, std::string_view b) const {
  const auto* one = find(a);
  const auto* other = find(b);
  return one != nullptr && other != nullptr && excludes(*one, *other);
}

bool Ontology::excludes(const Concept& a, const Concept& b) const {
  if (has(a.ancestors, b.number) || has(b.ancestors, a.number))
    return false;
  for (auto [p, q] : disjoint_)
    if ((has(a.ancestors, p) && has(b.ancestors, q)) ||
        (has(a.ancestors, q) && has(b.ancestors, p)))
      return true;
  return std::ranges::any_of(partitioned_, [&](auto& name) {
    const auto& whole = concepts_.find(name)->second;
    return has(a.ancestors, whole.number) && has(b.ancestors, whole.number) &&
           !share(a.ancestors, b.ancestors, whole) && !share(a.kinds, b.kinds, whole);
  });
}

/// Whether two sets have a kind of `whole` in common, other than that itself.
bool Ontology::share(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b,
                     const Concept& whole) {
  for (std::size_t i = 0; i < std::min({a.size(), b.size(), whole.kinds.size()}); ++i) {
    auto common = a[i] & b[i] & whole.kinds[i];
    if (whole.number / bits == i)
      common &= ~(std::uint64_t{1} << (whole.number % bits));
    if (common != 0)
      return true;
  }
  return false;
}

bool Ontology::are_alike(std::string_view a, std::string_view b) const {
  return std::ranges::any_of(alike_, [&](auto& x) { return x.first == a && x.second == b; });
}

const std::vector<std::string>& Ontology::parents(std::string_view name) const {
  static const std::vector<std::string> none;
  const auto* x = find(name);
  return x == nullptr ? none : x->parents;
}

bool Ontology::has_kinds(std::string_view name) const {
  const auto* x = find(name);
  return x != nullptr && std::ranges::any_of(concepts_, [x](auto& y) {
           return &y.second != x && has(y.second.ancestors, x->number);
         });
}

const std::vector<ConceptProperty>& Ontology::definition(std::string_view name) const {
  static const std::vector<ConceptProperty> none;
  const auto* x = find(name);
  return x == nullptr ? none : x->definition;
}

std::string_view Ontology::defined_by(const ConceptProperty& property) const {
  const std::pair<const std::string, Concept>* first = nullptr;
  for (auto& x : concepts_)
    if (x.second.definition.size() == 1 && x.second.definition.front() == property &&
        (first == nullptr || x.second.number < first->second.number))
      first = &x;
  return first == nullptr ? std::string_view{} : first->first;
}

std::vector<std::string_view> Ontology::names() const {
  std::vector<std::string_view> result;
  for (auto& [name, x] : concepts_)
    result.push_back(name);
  return result;
}

} // namespace castor
