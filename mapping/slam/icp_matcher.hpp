#pragma once

#include "castor/mapping/slam/scan_matcher.hpp"

#include <optional>

namespace castor::mapping {

/// Iterated closest points with the point-to-point metric: MRPT's CICP (Besl, McKay, "A method for
/// registration of 3-D shapes", 1992). A baseline to compare with.
class IcpMatcher final : public PointMatcher {
public:
  /// Uses the distances, the noise and the number of iterations.
  explicit IcpMatcher(const ScanMatcherOptions& options = {}) : options_(options) {}

  /// The prior is not used. `observability` is not known, and 0.
  ScanMatch match(const PointMap& map, const SurfacePoints& scan, const Pose2& guess,
                  const std::optional<PosePrior>& prior = {}) const override;

private:
  ScanMatcherOptions options_;
};

} // namespace castor::mapping
