#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::faults {

/// The text of a scene file (configs/scenes). Only lines that put a thing on the table are
/// interpreted: COLOUR SHAPE at X Y ..., with or without name=NAME. A thing without a name is
/// identified by colour and shape. Case is ignored.
class SceneText {
public:
  explicit SceneText(std::string_view text);

  /// Names of the things, in the order of the file.
  std::vector<std::string> things() const;

  bool has(std::string_view thing) const { return find(thing).has_value(); }

  /// Moves a thing; no effect if it does not exist.
  void move(std::string_view thing, std::string_view x, std::string_view y);

  /// Puts a thing on the table; replaces one of the same name.
  /// @param place the rest of its line after `at`
  void add(const std::string& thing, const std::string& place);

  /// No effect if it does not exist.
  void remove(std::string_view thing);

  std::string text() const;

private:
  /// Index of the thing's line.
  std::optional<std::size_t> find(std::string_view thing) const;

  std::vector<std::string> lines_;
};

} // namespace castor::faults
