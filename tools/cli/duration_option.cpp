#include "castor/tools/cli/duration_option.hpp"

#include "castor/base/duration.hpp"

namespace castor::cli {

std::optional<std::chrono::milliseconds> duration(const std::string& text) {
  return parse_duration(text);
}

std::string check_duration(const std::string& text) {
  return duration(text) ? std::string{}
                        : "write a duration such as 500ms, 10s or 2min, not " + text;
}

} // namespace castor::cli
