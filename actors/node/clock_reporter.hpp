#pragma once

#include "castor/actors/link/mesh.hpp"
#include "castor/wm/clock/simulated_clock.hpp"

#include <memory>
#include <optional>

namespace castor {

/// Connects the simulated clock of a node with that of the coordinator, as long as it lives.
class ClockReporter final : public ClockAuthority {
public:
  ClockReporter(std::shared_ptr<SimulatedClock> clock, std::shared_ptr<Mesh> mesh);
  ~ClockReporter() override;

  MessageCounts counts() const override { return mesh_->message_counts(); }
  std::optional<ClockAdvance> report(ClockReport x) override;

private:
  const std::shared_ptr<SimulatedClock> clock_;
  const std::shared_ptr<Mesh> mesh_;
  std::optional<ClockReport> last_;
};

} // namespace castor
