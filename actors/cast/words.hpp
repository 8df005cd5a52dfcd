#pragma once

#include "castor/actors/cast/preprocessor.hpp"
#include "castor/base/diagnostic_log.hpp"
#include "castor/base/file_access.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace castor::cast {

/// Whether a word is there at all: the line has not ended, and no comment has begun.
bool is_given(const std::optional<std::string>& word) noexcept;

/// The words of a line, one after the other. A word that begins with `$` is replaced as a whole by
/// the environment variable that it names; the value is not split again. Words that are not read
/// are not replaced, so an undefined environment variable in a comment does no harm.
class WordStream {
public:
  /// @param line, environment, log must outlive the stream
  WordStream(const StructureLine& line, const Environment& environment, DiagnosticLog& log);

  /// The next word; nothing at the end of the line. An undefined environment variable is an error,
  /// and the word then stays as written.
  std::optional<std::string> next();

  /// Warns if there are words left that are no comment.
  void warn_of_rest() const;

  /// What `next` will read, as written; empty at the end.
  std::string_view peek() const noexcept;

private:
  const StructureLine& line_;
  std::string_view rest_;
  const Environment& environment_;
  DiagnosticLog& log_;
};

} // namespace castor::cast
