#pragma once

#include "castor/tests/communication/grid_phrases.hpp"

#include <functional>
#include <string>
#include <vector>

namespace castor::communication::test {

/// What somebody says, made together with its meaning.
struct GridSentence {
  enum class Kind {
    /// Asks whether `claim` is so.
    whether,
    /// Says that `claim` is so.
    statement,
    /// Asks how many things are `asked`.
    how_many,
    /// Asks which things are `asked`.
    which,
    /// Asks for the colour, the shape or the size of what is `asked`.
    quality,
    /// Asks which of `alternatives` are so of what is `asked`.
    choice,
  };

  /// The form that is filled in, with letters for what it is filled with.
  std::string form;
  std::string text;
  Kind kind = Kind::whether;
  Presuppositions needs = {};
  oracle::Claim claim = {};
  oracle::Predicate asked = {};
  /// "colour", "shape" or "size".
  std::string quality = {};
  std::vector<std::string> alternatives = {};
  /// Whether in a world nobody would say so: something is compared with itself.
  std::function<bool(const oracle::World&)> is_odd = {};
};

/// All forms with all that they are filled with.
std::vector<GridSentence> question_grid();

} // namespace castor::communication::test
