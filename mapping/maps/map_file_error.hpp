#pragma once

#include "castor/base/diagnostic.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

/// A map file cannot be used; what() lists all its problems, with file, line and remedy.
class MapFileError : public std::runtime_error {
public:
  explicit MapFileError(std::vector<Diagnostic> problems)
    : std::runtime_error(render(problems)), problems_(std::move(problems)) {}

  /// One problem; line 0 is the whole file.
  MapFileError(const std::string& file, std::size_t line, std::string text, std::string message,
               std::string remedy)
    : MapFileError(std::vector<Diagnostic>{{.where = {file, line},
                                            .line = std::move(text),
                                            .expanded = {},
                                            .message = std::move(message),
                                            .remedy = std::move(remedy)}}) {}

  const std::vector<Diagnostic>& problems() const { return problems_; }

private:
  std::vector<Diagnostic> problems_;
};

} // namespace castor::mapping
