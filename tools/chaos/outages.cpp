#include "castor/tools/chaos/outages.hpp"

#include "castor/tools/chaos/rounded.hpp"

#include <map>

namespace castor::faults {

std::vector<Outage> outages_of(std::span<const LifeNote> notes,
                               const std::function<Timestamp(const std::string&)>& bound_of) {
  std::vector<Outage> result;
  // Of each target, the last.
  std::map<std::string, std::size_t> last;
  for (auto& note : notes) {
    auto known = last.find(note.target);
    auto outage = known == last.end() ? nullptr : &result[known->second];
    switch (note.kind) {
      case LifeNote::Kind::down:
        if (outage == nullptr || outage->up || outage->escalated) {
          last[note.target] = result.size();
          result.push_back({note.target, note.at, {}, {}, {}, bound_of(note.target), note.reason});
        }
        break;
      case LifeNote::Kind::up:
        if (outage != nullptr && !outage->up)
          outage->up = note.at;
        break;
      case LifeNote::Kind::first_callback:
        if (outage != nullptr && outage->up && !outage->first_callback)
          outage->first_callback = note.at;
        break;
      case LifeNote::Kind::escalated:
        if (outage != nullptr && !outage->up && !outage->escalated)
          outage->escalated = note.at;
        break;
    }
  }
  return result;
}

std::vector<std::string> late_recoveries(std::span<const Outage> outages, Timestamp end) {
  std::vector<std::string> result;
  for (auto& x : outages) {
    auto settled = x.escalated && (!x.up || *x.escalated < *x.up) ? x.escalated : x.up;
    auto took = settled.value_or(end) - x.down;
    if (took <= x.bound)
      continue;
    auto what = settled ? (settled == x.up ? "back only after " : "given up only after ")
                        : "neither back nor given up after ";
    result.push_back(x.target + ", down at " + rounded(x.down) + " (" + x.reason + "), was " +
                     what + rounded(took) + "; its bound is " + rounded(x.bound));
  }
  return result;
}

} // namespace castor::faults
