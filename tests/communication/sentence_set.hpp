#pragma once

#include "castor/tests/communication/table_scene.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// Sentences that people say about things on a table, with what is right to reply to them.
namespace castor::communication::test {

/// What a reply has to say.
struct ExpectedReply {
  enum class Kind {
    yes,
    no,
    /// `number` things.
    count,
    /// All of `values`, and no others, as colours, shapes or sizes.
    colour,
    shape,
    size,
    /// What tells `things` from others, and nothing about others.
    objects,
    /// One of `places`.
    place,
    /// Everything on the table.
    description,
    /// "Ok."
    accepted,
    /// That it is not so.
    contradicted,
    /// Something about the robot itself.
    small_talk,
    /// That there is nothing like what is spoken of.
    presupposition_failure,
    /// That it is not known, or not understood.
    unknown,
  };

  Kind kind = Kind::unknown;
  std::size_t number = 0;
  std::vector<std::string> values;
  /// Ids.
  std::vector<std::string> things;
  /// A relation, and the id of a thing or "table".
  std::vector<std::pair<std::string, std::string>> places;
};

/// Something on a table.
struct ThingInSet {
  std::string id;
  std::string shape;
  std::string colour;
  /// To the right, away from the viewer, and the length of its sides; metres.
  double x = 0;
  double y = 0;
  double side = 0;
  /// Metres; as long as its sides if 0.
  double height = 0;

  bool is_large() const;
};

struct Turn {
  std::string said;
  ExpectedReply expected;
};

struct Dialogue {
  /// Name of the scene that it is about.
  std::string scene;
  /// What it is for, such as "counting".
  std::string kind;
  std::vector<Turn> turns;
};

struct SentenceSet {
  std::map<std::string, std::vector<ThingInSet>> scenes;
  std::vector<Dialogue> dialogues;
};

/// \throws std::exception if the file is not readable, or is no such set
SentenceSet read_sentence_set(const std::string& file);

/// Puts things on a table as vision sees them: with places, spatial relations, and words for their
/// properties.
void lay_out(const std::vector<ThingInSet>& things, TableScene& table);

} // namespace castor::communication::test
