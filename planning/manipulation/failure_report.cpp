#include "castor/planning/manipulation/failure_report.hpp"

#include <algorithm>

namespace castor::manipulation {

void tell_failure(Manipulation& told, const MotionFailure& failure,
                  const std::vector<SeenThing>& things) {
  told.reason = failure.text;
  for (const auto& joint : told.still_joints)
    told.reason += "; its joint " + joint + " does not move any more";
  told.in_way = failure.obstacles;
  told.in_way_ids.clear();
  for (const auto& name : failure.obstacles) {
    const auto thing =
      std::ranges::find_if(things, [&](const SeenThing& x) { return x.thing.name == name; });
    told.in_way_ids.push_back(thing == things.end() ? std::string{} : thing->id);
  }
}

} // namespace castor::manipulation
