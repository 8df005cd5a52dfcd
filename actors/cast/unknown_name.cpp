#include "castor/actors/cast/unknown_name.hpp"

#include "castor/base/suggestion.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace castor::cast {

void report_unknown(const std::string& name, const std::set<std::string, std::less<>>& known,
                    std::string message, std::string otherwise, const StructureLine& line,
                    DiagnosticLog& log) {
  std::string remedy;
  if (log.has_room(Severity::error)) {
    std::vector<std::string_view> names;
    for (auto i = known.begin(); i != known.end() && names.size() < most_candidates; ++i)
      names.push_back(*i);
    remedy = did_you_mean(name, names);
  }
  log.report(Severity::error, *line.line, std::move(message),
             remedy.empty() ? std::move(otherwise) : std::move(remedy), line.text);
}

} // namespace castor::cast
