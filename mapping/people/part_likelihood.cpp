#include "castor/mapping/people/part_likelihood.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace castor::mapping {

namespace {

/// Of two legs, those that are seen one by one.
constexpr double pair_share = 0.6;

/// Of a normal distribution in two dimensions.
double density(double off, double variance) {
  return std::exp(-off * off / (2 * variance)) / (2 * std::numbers::pi * variance);
}

/// Negative logarithm of the probability that a part which nobody takes is there.
double cost_of_nobody(const BodyPart& x, const LikelihoodOptions& options) {
  return -std::log(x.is_new || !x.is_settled ? options.new_density : options.old_density);
}

/// Explanations by the parts within the gate.
class Collector {
public:
  Collector(const PersonMotion& person, std::span<const BodyPart> parts,
            const LikelihoodOptions& options)
    : person_(person), parts_(parts), options_(options) {}

  void add(Explanation x, double prior, std::vector<Explanation>& result) const {
    const auto measured = measured_place(parts_, x, options_);
    const double variance = person_.variance() + measured.variance;
    const double turned = variance + options_.turned_off * options_.turned_off;
    const double off = distance(person_.place(), measured.place);
    if (off > options_.farthest || off > options_.gate * std::sqrt(turned))
      return;
    x.cost = -std::log(
      options_.seen * prior *
      ((1 - options_.turning) * density(off, variance) + options_.turning * density(off, turned)));
    for (const auto part : x.all_parts())
      x.cost -= cost_of_nobody(parts_[part], options_);
    result.push_back(x);
  }

private:
  const PersonMotion& person_;
  std::span<const BodyPart> parts_;
  const LikelihoodOptions& options_;
};

} // namespace

MeasuredPlace measured_place(std::span<const BodyPart> parts, const Explanation& explanation,
                             const LikelihoodOptions& options) {
  const auto& first = parts[explanation.parts[0]];
  if (explanation.number_of_parts == 2) {
    const auto& second = parts[explanation.parts[1]];
    return {{(first.place.x + second.place.x) / 2, (first.place.y + second.place.y) / 2},
            options.pair_noise * options.pair_noise};
  }
  const double noise = first.width > options.widest_leg ? options.body_noise : options.leg_noise;
  return {first.place, noise * noise};
}

bool has_turned(const PersonMotion& person, const MeasuredPlace& measured,
                const LikelihoodOptions& options) {
  const double variance = person.variance() + measured.variance;
  const double off = distance(person.place(), measured.place);
  return options.turning * density(off, variance + options.turned_off * options.turned_off) >
         (1 - options.turning) * density(off, variance);
}

std::vector<Explanation> explanations_of(const PersonMotion& person,
                                         std::span<const BodyPart> parts, const ScanView& view,
                                         const LikelihoodOptions& options) {
  const auto shares = view.towards(person.place(), options.body_radius);
  std::vector<Explanation> result{{-std::log(1 - options.seen * (1 - shares.hidden)), {}, 0}};
  const Collector collector{person, parts, options};
  // Of legs that may be anywhere within a step's circle around the other one.
  const double second_leg = 1 / (std::numbers::pi * options.longest_step * options.longest_step);
  const auto is_near = [&](const BodyPart& x) {
    return distance(x.place, person.place()) < options.farthest;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_near(parts[i]))
      continue;
    const bool is_leg = parts[i].width <= options.widest_leg;
    collector.add({0, {i, 0}, 1}, is_leg ? 1 - pair_share : 1, result);
    for (std::size_t j = i + 1; is_leg && j < parts.size(); ++j)
      if (parts[j].width <= options.widest_leg &&
          distance(parts[i].place, parts[j].place) < options.longest_step)
        collector.add({0, {i, j}, 2}, pair_share * second_leg, result);
  }
  return result;
}

} // namespace castor::mapping
