#pragma once

#include "castor/mapping/people/body_part.hpp"
#include "castor/mapping/people/joint_assignment.hpp"
#include "castor/mapping/people/person_motion.hpp"
#include "castor/mapping/people/scan_view.hpp"

#include <span>
#include <vector>

namespace castor::mapping {

struct LikelihoodOptions {
  /// Standard deviations of a person's middle as told by two legs, by one, and by a body or legs
  /// that look like one; metres.
  double pair_noise = 0.06;
  double leg_noise = 0.25;
  double body_noise = 0.08;
  /// What is wider is no leg, metres.
  double widest_leg = 0.28;
  /// Legs of one person are at most so far apart, metres.
  double longest_step = 0.58;
  /// A part belongs to a person within so many standard deviations, and within so many metres of
  /// where the person is expected.
  double gate = 3.5;
  double farthest = 1.2;
  /// Probability that somebody has turned since the last scans, and how far off that is, metres.
  double turning = 0.05;
  double turned_off = 0.3;
  /// Probability that somebody who is not hidden is seen.
  double seen = 0.95;
  /// Parts of nobody known, for each square metre: where it was free before or which have just
  /// appeared, and elsewhere, which is furniture for the most part.
  double new_density = 0.05;
  double old_density = 2;
  /// Radius of a body, metres, of which the view decides whether somebody is hidden.
  double body_radius = 0.2;
};

/// What a person's middle is by these parts: one or two.
struct MeasuredPlace {
  Point2 place;
  /// m^2, on each axis.
  double variance = 0;
};
MeasuredPlace measured_place(std::span<const BodyPart> parts, const Explanation& explanation,
                             const LikelihoodOptions& options);

/// Whether that place is rather of somebody who has turned than of one who goes on.
bool has_turned(const PersonMotion& person, const MeasuredPlace& measured,
                const LikelihoodOptions& options);

/// All explanations of what is seen of a person: nothing, a part, or two legs.
std::vector<Explanation> explanations_of(const PersonMotion& person,
                                         std::span<const BodyPart> parts, const ScanView& view,
                                         const LikelihoodOptions& options);

} // namespace castor::mapping
