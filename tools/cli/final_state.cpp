#include "castor/tools/cli/final_state.hpp"

#include "castor/actors/system/system.hpp"
#include "castor/wm/values/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace castor::cli {

namespace {

void leave_out(nlohmann::json& x, const std::set<std::string>& names) {
  if (x.is_object())
    for (auto& name : names)
      x.erase(name);
  if (x.is_structured())
    for (auto& y : x)
      leave_out(y, names);
}

/// Long lines are told apart by their ends as well.
std::string shortened(const std::string& line) {
  constexpr std::size_t most = 300;
  if (line.size() <= most)
    return line;
  return line.substr(0, most) + "... (" + std::to_string(line.size()) + " characters, hash " +
         std::to_string(std::hash<std::string>{}(line)) + ")";
}

} // namespace

std::vector<std::string> state_of(System& system, const ComparedEntries& compared) {
  std::vector<std::string> result;
  for (auto& name : system.subarchitectures())
    for (auto& entry : system.entries(name)) {
      if (compared.types.count(entry->type_name()) == 0)
        continue;
      auto content = nlohmann::json::parse(to_json(entry->value));
      leave_out(content, compared.ignored);
      result.push_back(name + ' ' + entry->type_name() + ' ' + content.dump());
    }
  std::sort(result.begin(), result.end());
  return result;
}

std::string difference(const std::vector<std::string>& wanted,
                       const std::vector<std::string>& got) {
  std::vector<std::string> missing;
  std::vector<std::string> added;
  std::set_difference(wanted.begin(), wanted.end(), got.begin(), got.end(),
                      std::back_inserter(missing));
  std::set_difference(got.begin(), got.end(), wanted.begin(), wanted.end(),
                      std::back_inserter(added));
  std::string result;
  for (auto& x : missing)
    result += "- " + shortened(x) + '\n';
  for (auto& x : added)
    result += "+ " + shortened(x) + '\n';
  return result;
}

} // namespace castor::cli
