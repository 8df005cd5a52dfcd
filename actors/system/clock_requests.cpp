#include "castor/actors/system/clock_requests.hpp"

#include "castor/base/duration.hpp"
#include "castor/wm/clock/clock_control.hpp"

#include <string>

namespace castor {

namespace {

std::optional<double> speed_in(const Json& request, std::optional<double> present) {
  if (!request.contains("speed"))
    return present;
  auto& speed = request.at("speed");
  if (speed == "max")
    return std::nullopt;
  auto result = speed.get<double>();
  if (!(result >= slowest_pace && result <= fastest_pace))
    throw InspectionError("the speed is max, or a factor of real time from 0.001 to 1000000");
  return result;
}

Timestamp step_in(const Json& request) {
  auto seconds = request.at("seconds").get<double>();
  if (!(seconds > 0 && seconds < 1e9))
    throw InspectionError("a step takes more than 0 s and less than 1000000000 s");
  return std::chrono::duration_cast<Timestamp>(std::chrono::duration<double>{seconds});
}

} // namespace

Json clock_report(const ClockControl* clock) {
  if (!clock)
    return {{"kind", "real"}};
  auto pace = clock->pace();
  Json result{{"kind", "simulated"}, {"time", in_seconds(clock->clock()->now())}};
  if (pace.factor)
    result["speed"] = *pace.factor;
  else
    result["speed"] = "max";
  result["paused"] = pace.paused;
  return result;
}

void show_or_set_clock(const InspectionContextPtr& context, const Json& request) {
  auto set = request.value("set", std::string{});
  auto& clock = context->parts.clock;
  if (!clock) {
    if (set.empty())
      return context->answer(clock_report(nullptr));
    throw InspectionError("the clock of the system is the real one; start it with `castor run "
                          "--speed max`, a factor or `paused`, to set it");
  }
  auto pace = clock->pace();
  if (set == "run") {
    clock->set_pace({speed_in(request, pace.factor), false});
  } else if (set == "pause") {
    clock->set_pace({pace.factor, true});
  } else if (set == "step") {
    if (!pace.paused)
      clock->set_pace({pace.factor, true});
    clock->step(step_in(request));
  } else if (!set.empty()) {
    throw InspectionError("a clock cannot be set to " + set + "; there are: pause, run, step");
  }
  context->answer(clock_report(clock.get()));
}

} // namespace castor
