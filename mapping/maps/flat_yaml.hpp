#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace castor::mapping {

/// A key with its value in a text of the part of YAML that map files use: one level of `key: value`
/// lines, values that are scalars (plain, or in quotes) or lists of scalars (`[a, b]`, or lines
/// that begin with `-`), comments after `#`, and the mark `---` before all.
struct YamlItem {
  std::string key;
  /// One for a scalar.
  std::vector<std::string> values;
  bool is_list = false;
  /// Line of the key, from 1, and its text.
  std::size_t line = 0;
  std::string text;
};

/// All items in their order.
/// @throws MapFileError for text that is not of this part of YAML, naming its line
std::vector<YamlItem> parse_flat_yaml(std::string_view text, const std::string& file_name);

} // namespace castor::mapping
