#pragma once

#include "castor/communication/parsing/line_pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace castor::communication {

/// What words stand for, in the terms of the robot's other subarchitectures. Words are those of
/// logical forms: the predicates of a lexicon. How it is written says lexicon_reader.hpp.
struct WordMeanings {
  using Words = std::map<std::string, std::string, std::less<>>;

  /// Nouns that are not called like their concepts.
  Words concepts;
  /// Nouns that say nothing but that there is something. The first is the concept of all that.
  std::vector<std::string> general;
  /// Nouns for what is in containers, where things contain others.
  std::set<std::string, std::less<>> contents;
  /// Binding's kinds of features for qualities, such as "colour".
  Words qualities;
  /// For each quality whose values are listed: its adjectives, and their values.
  std::map<std::string, Words, std::less<>> values;

  /// What looks like something, by the values of a quality.
  struct Look {
    std::string quality;
    std::set<std::string, std::less<>> values;
    /// Of these it is not known.
    std::set<std::string, std::less<>> unknown;
  };

  std::map<std::string, Look, std::less<>> looks;
  /// Labels of relations that binding has between any two things, for the words of regions.
  Words relations;

  /// A noun for where everything is, with the words of regions by which that is said.
  struct Surroundings {
    std::string noun;
    /// The first is what the robot says.
    std::vector<std::string> regions;

    bool is_said_by(std::string_view region) const {
      return std::ranges::find(regions, region) != regions.end();
    }
  };

  /// The first is what the robot calls it.
  std::vector<Surroundings> surroundings;
  /// Concept of who is spoken to; empty if nobody tells of that.
  std::string addressee;
  /// Type names of the actions that verbs ask for.
  Words actions;
  /// Verbs for what is done to things that are seen, or for how that goes on: what these ask for is
  /// known thing by thing (steps_of).
  std::set<std::string, std::less<>> handling;

  /// What the robot says when it is spoken to about itself, by what that is about.
  Words replies;

  /// Which sides of a container a noun stands for.
  struct Side {
    bool left = false;
    bool right = false;
    bool top = false;
    bool bottom = false;
    /// Where two sides meet.
    bool corner = false;
  };

  std::map<std::string, Side, std::less<>> sides;
};

/// Whether the word begins a line about meanings.
bool is_meaning_keyword(std::string_view word);

/// These words.
const std::vector<std::string_view>& meaning_keywords();

/// Takes in such a line.
/// \param pieces what follows the keyword
/// \throws ReadError
void read_meaning(const Piece& keyword, const std::vector<Piece>& pieces, WordMeanings& meanings);

} // namespace castor::communication
