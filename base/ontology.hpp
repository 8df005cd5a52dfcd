#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor {

/// A property and its value, such as the shape sphere.
struct ConceptProperty {
  std::string property;
  std::string value;

  friend bool operator==(const ConceptProperty&, const ConceptProperty&) = default;
};

/// What somebody states of a concept. Several statements of one concept add up.
struct ConceptStatement {
  std::string name;
  /// More general concepts: a kitchen is a room.
  std::vector<std::string> is_a = {};
  /// What is of these kinds and has these properties is an instance of the concept: a ball is a
  /// thing with the shape sphere.
  std::vector<ConceptProperty> defined_by = {};
  /// Nothing is an instance of the concept and of one of these.
  std::vector<std::string> disjoint_with = {};
  /// Its kinds exclude each other, unless one is a kind of the other, or both are of one kind of
  /// it, or something is a kind of both.
  bool is_partitioned = false;
  /// Words for what may be one and the same: a cube looks like a square. They need not be concepts.
  std::vector<std::string> alike = {};

  friend bool operator==(const ConceptStatement&, const ConceptStatement&) = default;
};

/// A statement that cannot be used, by its number.
struct OntologyProblem {
  std::size_t statement = 0;
  /// The word of the statement that is wrong.
  std::string word;
  std::string message;
  std::string remedy;
};

/// Concepts, their kinds, and what excludes what. Immutable.
class Ontology {
public:
  /// Most concepts of an ontology; further ones are problems.
  static constexpr std::size_t max_concepts = 1024;

  /// Most pairs of disjoint concepts.
  static constexpr std::size_t max_disjoint = 4096;

  /// Knows nothing.
  Ontology() = default;

  /// From the statements without problems. A statement has one if it names a concept that no
  /// statement is about, makes a concept a kind of itself, or contradicts others: what is of two
  /// kinds that exclude each other. The order of the statements does not matter, but for which of
  /// two that contradict each other has the problem: the later.
  /// \param problems gets the others
  explicit Ontology(const std::vector<ConceptStatement>& statements,
                    std::vector<OntologyProblem>* problems = nullptr);

  bool empty() const { return concepts_.empty(); }

  /// Whether some statement is about the concept.
  bool knows(std::string_view name) const { return find(name) != nullptr; }

  /// Whether every instance of `special` is one of `general`. A concept is a kind of itself.
  bool is_kind_of(std::string_view special, std::string_view general) const;

  /// Whether nothing is an instance of both.
  bool excludes(std::string_view a, std::string_view b) const;

  /// Whether two words may be said of one and the same. Symmetric.
  bool are_alike(std::string_view a, std::string_view b) const;

  /// The concepts that it is stated to be a kind of; empty for unknown ones.
  const std::vector<std::string>& parents(std::string_view name) const;

  /// Whether other concepts are kinds of it.
  bool has_kinds(std::string_view name) const;

  /// The properties that define a concept; empty if there are none.
  const std::vector<ConceptProperty>& definition(std::string_view name) const;

  std::vector<std::string_view> names() const;

  /// The concept that has just this property for its definition; of several the one that was stated
  /// first. Empty if there is none.
  std::string_view defined_by(const ConceptProperty& property) const;

private:
  struct Concept {
    std::size_t number = 0;
    std::vector<std::string> parents;
    std::vector<ConceptProperty> definition;
    bool is_partitioned = false;
    /// Itself, with more general and with more special concepts; bits by number.
    std::vector<std::uint64_t> ancestors;
    std::vector<std::uint64_t> kinds;
  };

  struct Builder;

  const Concept* find(std::string_view name) const;
  bool excludes(const Concept& a, const Concept& b) const;
  static bool share(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b,
                    const Concept& whole);

  std::map<std::string, Concept, std::less<>> concepts_;
  /// Numbers of disjoint concepts.
  std::vector<std::pair<std::size_t, std::size_t>> disjoint_;
  /// Concepts whose kinds exclude each other.
  std::vector<std::string> partitioned_;
  /// Each pair in both orders, sorted.
  std::vector<std::pair<std::string, std::string>> alike_;
};

} // namespace castor
