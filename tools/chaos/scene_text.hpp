#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// The text of a scene file (configs/scenes), of which only the lines are understood that put a
/// thing on the table: COLOUR SHAPE at X Y ..., with name=NAME or without. Things are called by
/// their names, and those without one by colour and shape. Capital letters do not matter.
class SceneText {
public:
  explicit SceneText(std::string_view text);

  /// What they are called, in the order of the file.
  std::vector<std::string> things() const;

  bool has(std::string_view thing) const { return find(thing).has_value(); }

  /// Puts a thing elsewhere; nothing happens if it is not there.
  void move(std::string_view thing, std::string_view x, std::string_view y);

  /// Puts a thing on the table; one that is called the same goes.
  /// @param place what follows `at` in its line
  void add(const std::string& thing, const std::string& place);

  /// Nothing happens if it is not there.
  void remove(std::string_view thing);

  std::string text() const;

private:
  /// The place of its line.
  std::optional<std::size_t> find(std::string_view thing) const;

  std::vector<std::string> lines_;
};

} // namespace castor::faults
