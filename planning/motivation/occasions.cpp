#include "castor/planning/motivation/occasions.hpp"

namespace castor::planning {

std::vector<Motive> Occasions::look(const std::vector<std::string>& facts, bool is_idle,
                                    Timestamp now) {
  if (!is_idle)
    idle_since_.reset();
  else if (!idle_since_)
    idle_since_ = now;
  std::vector<Motive> result;
  std::set<std::pair<std::string, MotiveValues>> present;
  for (const auto& x : templates_) {
    if (!x.on.empty() || (x.when.empty() && !x.idle))
      continue;
    if (x.idle && (!idle_since_ || now - *idle_since_ < *x.idle))
      continue;
    for (auto& values : matches(x.when, facts)) {
      const auto [place, is_new] = present.emplace(x.name, std::move(values));
      if (!present_.contains(*place))
        if (auto motive = make_motive(x, place->second))
          result.push_back(std::move(*motive));
    }
  }
  present_ = std::move(present);
  return result;
}

} // namespace castor::planning
