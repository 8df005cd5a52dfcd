#pragma once

#include "castor/actors/cast/keywords.hpp"
#include "castor/base/source_line.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

/// Value of a condition, or why it has none.
struct ConditionResult {
  /// Without a value `problem` is an error, with one it is a warning.
  std::optional<bool> value;
  std::string problem;
  std::string remedy;
};

/// Replaces variables; nothing if the result would exceed a limit.
using Expander = std::function<std::optional<std::string>(std::string_view)>;

/// Evaluates an IF... line. Its parameters stand between the first opening and the last closing
/// parenthesis. Those with two are split at the first comma; each part is trimmed and then
/// expanded, so commas in values do no harm.
ConditionResult evaluate_condition(const KeywordMatch<Directive>& directive, std::string_view line,
                                   const Expander& expand);

/// Reads a truth value: true, yes, on and 1 to 9, or false, no, off, 0 and nothing at all, in upper
/// or lower case. Pieces of the list `true.yes.on.1.2. ...`, such as `1.2`, have always been taken
/// too; they get a warning.
ConditionResult evaluate_truth(std::string_view text);

/// The conditional blocks around the current line.
class ConditionStack {
public:
  void open(const SourceLine& line, bool enabled);

  enum class Outcome { done, no_block_open, second_else };

  /// Enables the block if it was disabled, and vice versa.
  Outcome otherwise();
  Outcome close();

  /// Whether all blocks around the current line are enabled.
  bool enabled() const noexcept { return disabled_count_ == 0; }

  /// The lines that opened the blocks around the current line, outermost first.
  std::vector<const SourceLine*> open_lines() const;

private:
  struct Block {
    const SourceLine* line = nullptr;
    bool enabled = true;
    bool has_else = false;
  };

  std::vector<Block> blocks_;
  std::size_t disabled_count_ = 0;
};

} // namespace castor::cast
