#include "castor/planning/motivation/occasions.hpp"

namespace castor::planning {

std::vector<Motive> Occasions::look(const std::vector<std::string>& facts, bool is_idle,
                                    Timestamp now) {
  if (!is_idle)
    idle_since_.reset();
  else if (!idle_since_)
    idle_since_ = now;
  std::vector<Motive> result;
  decltype(present_) present;
  for (const auto& x : templates_) {
    if (!x.on.empty() || (x.when.empty() && !x.idle))
      continue;
    if (x.idle && (!idle_since_ || now - *idle_since_ < *x.idle))
      continue;
    for (auto& values : matches(x.when, facts)) {
      const std::pair key{x.name, std::move(values)};
      const auto before = present_.find(key);
      const bool is_due =
        before == present_.end() || (again_.count() > 0 && now - before->second >= again_);
      present[key] = is_due ? now : before->second;
      if (!is_due)
        continue;
      if (auto motive = make_motive(x, key.second))
        result.push_back(std::move(*motive));
    }
  }
  present_ = std::move(present);
  return result;
}

} // namespace castor::planning
