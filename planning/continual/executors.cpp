#include "castor/planning/continual/executors.hpp"

#include "castor/base/name_and_value.hpp"
#include "castor/base/text.hpp"

#include <stdexcept>
#include <utility>

namespace castor::planning {

Executors::Executors(const std::vector<std::string>& rules, std::string standard)
  : standard_(std::move(standard)) {
  for (const auto& rule : rules) {
    auto parts = name_and_value(rule);
    if (!parts)
      throw std::invalid_argument("the executor " + in_quotes(rule) +
                                  " is not understood: write ACTION=SUBARCHITECTURE");
    auto& [action, executor] = *parts;
    auto name = lower_case(action);
    if (name.back() == '*') {
      name.pop_back();
      prefixes_[name] = std::move(executor);
    } else {
      names_[name] = std::move(executor);
    }
  }
}

std::string Executors::executor_of(std::string_view action) const {
  const auto found = names_.find(action);
  if (found != names_.end())
    return found->second;
  const std::string* result = &standard_;
  std::size_t longest = 0;
  for (const auto& [prefix, executor] : prefixes_)
    if (action.starts_with(prefix) && prefix.size() >= longest) {
      longest = prefix.size();
      result = &executor;
    }
  return *result;
}

} // namespace castor::planning
