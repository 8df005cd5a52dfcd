#include "castor/mapping/localisation/particles.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

namespace castor::mapping {

namespace {

/// Column, row, and sector of the heading.
using CellIndex = std::array<std::int64_t, 3>;

using Members = std::vector<const Particle*>;

ParticleCluster cluster_of(const Members& members) {
  ParticleCluster result;
  Pose2 sum;
  double c = 0;
  double s = 0;
  for (const auto* x : members) {
    result.weight += x->weight;
    sum.x += x->weight * x->pose.x;
    sum.y += x->weight * x->pose.y;
    c += x->weight * std::cos(x->pose.heading);
    s += x->weight * std::sin(x->pose.heading);
  }
  if (!(result.weight > 0))
    return result;
  result.mean = {sum.x / result.weight, sum.y / result.weight, std::atan2(s, c)};
  auto& covariance = result.covariance;
  for (const auto* x : members) {
    auto share = x->weight / result.weight;
    auto dx = x->pose.x - result.mean.x;
    auto dy = x->pose.y - result.mean.y;
    auto turn = normalised(x->pose.heading - result.mean.heading);
    covariance.xx += share * dx * dx;
    covariance.xy += share * dx * dy;
    covariance.yy += share * dy * dy;
    covariance.x_heading += share * dx * turn;
    covariance.y_heading += share * dy * turn;
    covariance.heading += share * turn * turn;
  }
  return result;
}

} // namespace

double ParticleCluster::spread() const {
  return std::sqrt(covariance.xx + covariance.yy);
}

std::vector<ParticleCluster> clusters_of(const std::vector<Particle>& particles,
                                         const ClusterOptions& options) {
  constexpr double turn = 2 * std::numbers::pi;
  auto sectors = std::max<std::int64_t>(1, std::llround(turn / options.cell_heading));
  std::map<CellIndex, Members> cells;
  for (const auto& x : particles) {
    auto sector = static_cast<std::int64_t>(
      std::floor((normalised(x.pose.heading) / turn + 0.5) * static_cast<double>(sectors)));
    cells[{std::llround(x.pose.x / options.cell), std::llround(x.pose.y / options.cell),
           sector % sectors}]
      .push_back(&x);
  }
  std::vector<ParticleCluster> result;
  while (!cells.empty()) {
    Members members;
    std::vector<CellIndex> to_visit{cells.begin()->first};
    while (!to_visit.empty()) {
      auto here = to_visit.back();
      to_visit.pop_back();
      auto found = cells.find(here);
      if (found == cells.end())
        continue;
      members.insert(members.end(), found->second.begin(), found->second.end());
      cells.erase(found);
      for (int dx : {-1, 0, 1})
        for (int dy : {-1, 0, 1})
          for (int turned : {-1, 0, 1})
            to_visit.push_back(
              {here[0] + dx, here[1] + dy, (here[2] + turned + sectors) % sectors});
    }
    result.push_back(cluster_of(members));
  }
  std::ranges::stable_sort(result, std::greater{}, &ParticleCluster::weight);
  return result;
}

} // namespace castor::mapping
