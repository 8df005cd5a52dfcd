#include "castor/mapping/localisation/particle_filter.hpp"

#include "castor/mapping/localisation/distance_field.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/random.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>

namespace castor::mapping {

namespace {

/// MRPT draws from one generator of the process, which is seeded anew for each operation.
std::mutex& generator_mutex() {
  static std::mutex result;
  return result;
}

std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid_of(const CellMap& map,
                                                         const ParticleFilterOptions& options) {
  if (map.origin.heading != 0)
    throw std::invalid_argument("the map is turned; set the third number of its origin to 0");
  auto left = static_cast<float>(map.origin.x);
  auto bottom = static_cast<float>(map.origin.y);
  auto cell = static_cast<float>(map.cell_size);
  auto result = std::make_shared<mrpt::maps::COccupancyGridMap2D>(
    left, left + cell * static_cast<float>(map.columns), bottom,
    bottom + cell * static_cast<float>(map.rows), cell);
  // MRPT has the probability of being free.
  result->fill(0.5F);
  bool has_free = false;
  bool has_occupied = false;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      auto percent = map.at(column, row);
      if (percent < 0)
        continue;
      auto is_occupied = percent >= options.occupied_from;
      (is_occupied ? has_occupied : has_free) = true;
      result->setCell(column, row, is_occupied ? 0.02F : 0.98F);
    }
  if (!has_free || !has_occupied)
    throw std::invalid_argument(has_free ? "the map has no occupied cell, so that a laser would "
                                           "see nothing; check its thresholds"
                                         : "the map has no free cell for the robot; check its "
                                           "thresholds");
  auto& likelihood = result->likelihoodOptions;
  likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  likelihood.LF_stdHit = static_cast<float>(options.hit_deviation);
  likelihood.LF_zHit = static_cast<float>(1 - options.random_beams);
  likelihood.LF_zRandom = static_cast<float>(options.random_beams);
  likelihood.LF_maxCorrsDistance = static_cast<float>(3 * options.hit_deviation);
  // The scan is thinned before.
  likelihood.LF_decimation = 1;
  return result;
}

mrpt::obs::CObservation2DRangeScan::Ptr observation_of(const LaserScan& scan, std::size_t beams) {
  auto each = std::max<std::size_t>(1, scan.ranges.size() / std::max<std::size_t>(1, beams));
  auto count = (scan.ranges.size() + each - 1) / each;
  auto result = mrpt::obs::CObservation2DRangeScan::Create();
  auto aperture = scan.angle_step * static_cast<double>(each * (count - 1));
  result->aperture = static_cast<float>(std::abs(aperture));
  result->rightToLeft = aperture >= 0;
  result->maxRange = static_cast<float>(scan.max_range);
  result->sensorPose = mrpt::poses::CPose3D(
    scan.mount.x, scan.mount.y, 0, scan.mount.heading + scan.first_angle + aperture / 2, 0, 0);
  result->resizeScan(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto range = scan.ranges[i * each];
    auto is_valid = range > 0 && range < static_cast<float>(scan.max_range);
    result->setScanRange(i, is_valid ? range : static_cast<float>(scan.max_range));
    result->setScanRangeValidity(i, is_valid);
  }
  return result;
}

} // namespace

struct ParticleFilter::Filter {
  std::shared_ptr<mrpt::maps::COccupancyGridMap2D> grid;
  mrpt::slam::CMonteCarloLocalization2D poses;
  mrpt::bayes::CParticleFilter filter;
};

ParticleFilter::ParticleFilter(const CellMap& map, const ParticleFilterOptions& options)
  : options_(options), filter_(std::make_unique<Filter>()) {
  // Within walls a beam's end is as far from the surface as before it.
  filter_->grid = grid_of(visible_surfaces(map, options.occupied_from), options);
  filter_->poses.options.metricMap = filter_->grid;
  auto& kld = filter_->poses.options.KLD_params;
  kld.KLD_minSampleSize = options.least_particles;
  kld.KLD_maxSampleSize = options.most_particles;
  kld.KLD_binSize_XY = 0.1;
  kld.KLD_binSize_PHI = 5 * std::numbers::pi / 180;
  auto& filter = filter_->filter.m_options;
  filter.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  // The only way that goes with a number of particles that adapts.
  filter.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
  filter.adaptiveSampleSize = true;
}

ParticleFilter::~ParticleFilter() = default;

void ParticleFilter::seed_generator() {
  std::seed_seq sequence{options_.seed, ++draws_};
  std::uint32_t seed = 0;
  sequence.generate(&seed, &seed + 1);
  // A new one, because randomize() keeps a normal deviate that was drawn before.
  mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator{seed};
}

void ParticleFilter::spread_everywhere(unsigned particles) {
  std::lock_guard lock{generator_mutex()};
  seed_generator();
  filter_->poses.resetUniformFreeSpace(filter_->grid.get(), 0.7, static_cast<int>(particles));
}

void ParticleFilter::spread_around(const std::vector<Pose2>& poses, double deviation,
                                   double deviation_heading) {
  std::lock_guard lock{generator_mutex()};
  seed_generator();
  auto& generator = mrpt::random::getRandomGenerator();
  constexpr std::size_t least_each = 30;
  auto each =
    std::max(least_each, std::max<std::size_t>(1000, options_.least_particles) / poses.size());
  filter_->poses.resetDeterministic({poses.front().x, poses.front().y, poses.front().heading},
                                    each * poses.size());
  for (std::size_t i = 0; i < filter_->poses.m_particles.size(); ++i) {
    const auto& pose = poses[i / each];
    filter_->poses.m_particles[i].d = {
      generator.drawGaussian1D(pose.x, deviation), generator.drawGaussian1D(pose.y, deviation),
      normalised(generator.drawGaussian1D(pose.heading, deviation_heading))};
  }
}

void ParticleFilter::update(const Pose2& motion, const LaserScan& scan) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  auto& gaussian = model.gaussianModel;
  // Deviations of the position and of the heading by the way (a1, a3) and by the turn (a2, a4).
  gaussian.a1 = options_.odometry_translation;
  gaussian.a2 = options_.odometry_translation / 10;
  gaussian.a3 = options_.odometry_turn;
  gaussian.a4 = options_.odometry_turn;
  gaussian.minStdXY = options_.least_translation;
  gaussian.minStdPHI = options_.least_turn;
  mrpt::obs::CActionRobotMovement2D move;
  move.computeFromOdometry(mrpt::poses::CPose2D(motion.x, motion.y, motion.heading), model);
  mrpt::obs::CActionCollection actions;
  actions.insert(move);
  mrpt::obs::CSensoryFrame frame;
  frame.insert(observation_of(scan, options_.beams));
  std::lock_guard lock{generator_mutex()};
  seed_generator();
  filter_->filter.executeOn(filter_->poses, &actions, &frame);
}

std::vector<Particle> ParticleFilter::particles() const {
  const auto& all = filter_->poses.m_particles;
  std::vector<Particle> result;
  if (all.empty())
    return result;
  result.reserve(all.size());
  auto highest = std::ranges::max_element(all, {}, [](const auto& x) { return x.log_w; })->log_w;
  double sum = 0;
  for (const auto& x : all) {
    result.push_back({{x.d.x, x.d.y, x.d.phi}, std::exp(x.log_w - highest)});
    sum += result.back().weight;
  }
  for (auto& x : result)
    x.weight /= sum;
  return result;
}

} // namespace castor::mapping
