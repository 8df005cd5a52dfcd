#pragma once

#include "castor/actors/cast/description.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace castor::cast {

/// A word that begins a section or stands for itself at top level. To add one, add it here, to the
/// table in keywords.cpp, and to the dispatch in grammar.cpp.
enum class SectionKeyword {
  subarchitecture,
  architecture,
  host,
  connection,
  component,
  access,
  supervise,
  failover
};

enum class VariableCommand { set, set_default, set_options, default_options };

enum class Directive {
  if_equal,
  if_not_equal,
  if_true,
  if_false,
  if_any_option,
  if_all_options,
  otherwise,
  end
};

/// The keyword at the beginning of a line.
template <class Keyword>
struct KeywordMatch {
  Keyword keyword;
  std::string_view word;
  /// Letters or other text that follow the keyword without a blank: `ENDIFF`. The language reads
  /// such a line as if they were not there.
  bool glued = false;
};

/// These match by prefix, as in the original language, except for keywords that were added later.
/// HOSTNAME does not match.
std::optional<KeywordMatch<SectionKeyword>> match_section_keyword(std::string_view line) noexcept;
std::optional<KeywordMatch<VariableCommand>> match_variable_command(std::string_view line) noexcept;
std::optional<KeywordMatch<Directive>> match_directive(std::string_view line) noexcept;

inline constexpr std::string_view include_keyword = "INCLUDE";
inline constexpr std::string_view host_name_keyword = "HOSTNAME";
inline constexpr std::string_view expand_comment = "#EXPAND";
inline constexpr std::string_view multiline_begin = "<multiline>";
inline constexpr std::string_view multiline_end = "</multiline>";

/// Exactly CPP, JAVA or PYTHON.
std::optional<Language> match_language(std::string_view word) noexcept;

/// WM, TM, MG, UM, and the old GD for MG and DD for UM.
std::optional<ComponentKind> match_kind(std::string_view word) noexcept;

/// Every word that may begin a line: for suggestions.
const std::vector<std::string_view>& all_line_keywords();

/// Variables that the parser sets for every file: its directory, by two names, and its path.
inline constexpr std::string_view config_dir_variable = "CONFIG_DIR";
inline constexpr std::string_view current_dir_variable = "CURRENT_DIR";
inline constexpr std::string_view current_file_variable = "CURRENT_FILE";
/// The directory of the main file.
inline constexpr std::string_view main_dir_variable = "MAIN_DIR";

} // namespace castor::cast
