#include "castor/actors/node/clock_reporter.hpp"

#include "castor/actors/node/clock_protocol.hpp"

#include <utility>

namespace castor {

ClockReporter::ClockReporter(std::shared_ptr<SimulatedClock> clock, std::shared_ptr<Mesh> mesh)
  : clock_(std::move(clock)), mesh_(std::move(mesh)) {
  mesh_->set_sink(clock_number, [clock = clock_](ProcessNumber, const caf::message& x, auto*) {
    if (x.match_elements<ClockAdvance>())
      clock->advance(x.get_as<ClockAdvance>(0));
  });
  mesh_->set_clock(clock_);
  clock_->report_to(this);
}

ClockReporter::~ClockReporter() {
  clock_->report_to(nullptr);
}

std::optional<ClockAdvance> ClockReporter::report(ClockReport x) {
  if (last_ == x)
    return std::nullopt;
  last_ = x;
  if (auto coordinator = mesh_->well_known(0, clock_number))
    coordinator->enqueue(nullptr, caf::make_message_id(),
                         caf::make_message(ClockReportFrom{mesh_->self(), std::move(x)}), nullptr);
  return std::nullopt;
}

} // namespace castor
