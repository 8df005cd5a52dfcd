#pragma once

#include "castor/binding/features.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <set>
#include <string>
#include <utility>

namespace castor::binding {

struct ComparatorOptions {
  /// Up to here two locations are the same, from there on they are not, metres. In between, nobody
  /// knows: sources differ in precision.
  double same_place = 0.05;
  double other_place = 0.10;
  /// The concept of every object that is nothing in particular.
  std::string top_concept = "thing";
  /// Concepts and what they are a kind of. Whoever is not here is a kind of the top concept; an
  /// empty text stands for nothing above, as for a room.
  std::map<std::string, std::string> is_a = {
    {"location", ""}, {"place", ""}, {"room", ""}, {"area", ""}, {"person", ""}};
  /// Shapes that one thing may be called by, as seen from this side or that: nobody knows whether
  /// they agree.
  std::set<std::pair<std::string, std::string>> alike = {
    {"cube", "square"},      {"cube", "rectangle"}, {"cylinder", "circle"},
    {"square", "rectangle"}, {"sphere", "circle"},  {"cylinder", "rectangle"}};
};

/// Whether two features of these kinds say something about each other at all, besides that they may
/// exclude each other.
bool is_evidence(FeatureKind a, FeatureKind b);

/// Whether features of these kinds may be anything but unknown to each other.
bool may_compare(FeatureKind a, FeatureKind b);

/// Whether both may be true of one thing: yes, if one says what the other says; no, if they exclude
/// each other. The order does not matter.
///
/// Words are compared as such; "unknown" and empty ones are no statement. A concept is what it is a
/// kind of. Of shapes that look alike, nobody knows. Of time frames, ids of sources, groups and
/// singulars, different ones exclude each other and equal ones prove nothing. What is not red
/// excludes what is red, and includes what is blue.
Truth compare(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

/// Whether `a` is a concept that `b` is only a kind of: what is known to be a thing may be a ball,
/// but need not be one.
bool is_more_general(const Feature& a, const Feature& b, const ComparatorOptions& options = {});

} // namespace castor::binding
