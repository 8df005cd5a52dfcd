#include "castor/mapping/movement/pose_search.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using SE2 = ob::SE2StateSpace::StateType;
using Motions = std::vector<Twist2>;

/// How far an outline moves between two looks at it while a way is sought, metres.
constexpr double coarse = 0.02;

/// OMPL has one generator of seeds for all threads.
std::mutex& seeding() {
  static std::mutex mutex;
  return mutex;
}

Pose2 pose_of(const ob::State* state) {
  const auto* x = state->as<SE2>();
  return {x->getX(), x->getY(), x->getYaw()};
}

void set(ob::State* state, const Pose2& pose) {
  auto* x = state->as<SE2>();
  x->setXY(pose.x, pose.y);
  // Half a circle is outside OMPL's bounds in this direction.
  const double heading = normalised(pose.heading);
  x->setYaw(heading < std::numbers::pi ? heading : -std::numbers::pi);
}

/// Poses, and the motions that lead from one to another.
class Steering {
public:
  virtual ~Steering() = default;
  virtual Motions motions(const ob::State* from, const ob::State* to) const = 0;
};

class TurnAndDrive final : public ob::SE2StateSpace, public Steering {
public:
  explicit TurnAndDrive(const PosePlanOptions& options) : options_(options) {
    setName("TurnAndDrive" + getName());
  }

  Motions motions(const ob::State* from, const ob::State* to) const override {
    const auto a = pose_of(from);
    const auto b = pose_of(to);
    const double way = distance_between(a, b);
    constexpr double none = 1e-9;
    if (way < none)
      return {{0, normalised(b.heading - a.heading)}};
    const double direction = std::atan2(b.y - a.y, b.x - a.x);
    const auto along = [&](double side) {
      const double heading = side > 0 ? direction : direction + std::numbers::pi;
      return Motions{{0, normalised(heading - a.heading)},
                     {side * way, 0},
                     {0, normalised(b.heading - heading)}};
    };
    auto forwards = along(1);
    auto backwards = along(-1);
    return cost(forwards) <= cost(backwards) ? forwards : backwards;
  }

  double distance(const ob::State* from, const ob::State* to) const override {
    return cost(motions(from, to));
  }

  void interpolate(const ob::State* from, const ob::State* to, double share,
                   ob::State* result) const override {
    const auto all = motions(from, to);
    double left = share * cost(all);
    auto pose = pose_of(from);
    for (const auto& x : all) {
      const double whole = cost({x});
      const double part = whole > 0 ? std::min(1.0, left / whole) : 1;
      pose = pose_on(pose, x, part);
      left -= whole;
      if (left <= 0)
        break;
    }
    set(result, pose);
  }

  // It does not keep the triangle inequality.
  bool isMetricSpace() const override { return false; }
  bool hasSymmetricDistance() const override { return false; }
  bool hasSymmetricInterpolate() const override { return false; }

private:
  static double distance_between(const Pose2& a, const Pose2& b) {
    return castor::mapping::distance(a, b);
  }

  double cost(const Motions& motions) const {
    double result = 0;
    for (const auto& x : motions)
      result += options_.turn_weight * std::abs(x.turn) +
                std::abs(x.forward) * (x.forward < 0 ? options_.backwards_weight : 1);
    return result;
  }

  const PosePlanOptions& options_;
};

class ReedsShepp final : public ob::ReedsSheppStateSpace, public Steering {
public:
  explicit ReedsShepp(double radius) : ob::ReedsSheppStateSpace(radius) {}

  Motions motions(const ob::State* from, const ob::State* to) const override {
    const auto curve = reedsShepp(from, to);
    Motions result;
    for (int i = 0; i < 5; ++i) {
      // Of a circle with radius one.
      const double way = curve.length_[i];
      constexpr double none = 1e-9;
      if (curve.type_[i] == RS_NOP || std::abs(way) < none)
        continue;
      const double side = curve.type_[i] == RS_LEFT ? 1 : curve.type_[i] == RS_RIGHT ? -1 : 0;
      result.push_back({way * rho_, side * way});
    }
    return result;
  }

  bool isMetricSpace() const override { return false; }
};

/// A motion is free if the footprint fits all along it.
class FreeMotions final : public ob::MotionValidator {
public:
  FreeMotions(const ob::SpaceInformationPtr& space, const Steering& steering,
              const FootprintRoom& room)
    : ob::MotionValidator(space), steering_(steering), room_(room) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const bool result = room_.is_free({pose_of(from), steering_.motions(from, to)}, coarse);
    ++(result ? valid_ : invalid_);
    return result;
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    const bool result = checkMotion(from, to);
    if (!result) {
      // Nothing asks for more of those whom this is for.
      if (last_valid.first)
        si_->copyState(last_valid.first, from);
      last_valid.second = 0;
    }
    return result;
  }

private:
  const Steering& steering_;
  const FootprintRoom& room_;
};

/// Samples along the way of a disc more often than elsewhere.
class GuidedSampler final : public ob::StateSampler {
public:
  GuidedSampler(const ob::StateSpace* space, const std::vector<Point2>& guide)
    : ob::StateSampler(space), elsewhere_(space->allocDefaultStateSampler()), guide_(guide) {
    for (std::size_t i = 1; i < guide.size(); ++i)
      length_ += distance(guide[i - 1], guide[i]);
  }

  void sampleUniform(ob::State* state) override {
    constexpr double guided = 0.6;
    if (rng_.uniform01() >= guided || !(length_ > 0))
      return elsewhere_->sampleUniform(state);
    double left = rng_.uniformReal(0, length_);
    std::size_t i = 1;
    for (; i + 1 < guide_.size() && left > distance(guide_[i - 1], guide_[i]); ++i)
      left -= distance(guide_[i - 1], guide_[i]);
    const auto& a = guide_[i - 1];
    const auto& b = guide_[i];
    const double whole = distance(a, b);
    const double share = whole > 0 ? std::min(1.0, left / whole) : 0;
    constexpr double aside = 0.12;      // metres
    constexpr double turned = 0.1;      // radians
    constexpr double along_path = 0.75; // of them
    const double spread = rng_.uniform01();
    double heading = std::atan2(b.y - a.y, b.x - a.x) + rng_.gaussian(0, turned * spread);
    if (rng_.uniform01() < 0.3)
      heading += std::numbers::pi;
    if (rng_.uniform01() >= along_path)
      heading = rng_.uniformReal(-std::numbers::pi, std::numbers::pi);
    set(state, {std::lerp(a.x, b.x, share) + rng_.gaussian(0, aside * spread),
                std::lerp(a.y, b.y, share) + rng_.gaussian(0, aside * spread), heading});
    space_->enforceBounds(state);
  }

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    elsewhere_->sampleUniformNear(state, near, distance);
  }

  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    elsewhere_->sampleGaussian(state, mean, deviation);
  }

private:
  ob::StateSamplerPtr elsewhere_;
  const std::vector<Point2>& guide_;
  double length_ = 0;
};

std::pair<std::shared_ptr<ob::SE2StateSpace>, const Steering*>
space(const PosePlanOptions& options) {
  if (options.steering == PoseSteering::turn_and_drive) {
    auto result = std::make_shared<TurnAndDrive>(options);
    return {result, result.get()};
  }
  auto result = std::make_shared<ReedsShepp>(options.turning_radius);
  return {result, result.get()};
}

ob::RealVectorBounds bounds_of(const CellMap& map) {
  ob::RealVectorBounds result(2);
  result.setLow(0, map.origin.x);
  result.setHigh(0, map.origin.x + map.columns * map.cell_size);
  result.setLow(1, map.origin.y);
  result.setHigh(1, map.origin.y + map.rows * map.cell_size);
  return result;
}

/// Whether one goes on as the other did.
bool is_one(const Twist2& a, const Twist2& b) {
  constexpr double same = 1e-6;
  if (a.forward == 0 || b.forward == 0)
    return a.forward == 0 && b.forward == 0;
  return a.forward * b.forward > 0 && std::abs(a.turn / a.forward - b.turn / b.forward) < same;
}

/// The same path with motions joined that are one.
PosePath joined(const PosePath& path) {
  PosePath result{path.start, {}};
  constexpr double none = 1e-6;
  for (const auto& x : path.motions) {
    if (std::abs(x.forward) < none && std::abs(x.turn) < none)
      continue;
    if (!result.motions.empty() && is_one(result.motions.back(), x)) {
      result.motions.back().forward += x.forward;
      result.motions.back().turn += x.turn;
    } else {
      result.motions.push_back(x);
    }
  }
  return result;
}

/// The way along a path's states, and what it costs.
FoundPoses way_along(const Pose2& start, const og::PathGeometric& path,
                     const ob::StateSpace& states, const Steering& steering) {
  PosePath result{start, {}};
  double cost = 0;
  for (unsigned i = 1; i < path.getStateCount(); ++i) {
    const auto* from = path.getState(i - 1);
    const auto* to = path.getState(i);
    cost += states.distance(from, to);
    for (const auto& x : steering.motions(from, to))
      result.motions.push_back(x);
  }
  return {joined(result), cost};
}

void shorten(const ob::SpaceInformationPtr& information, og::PathGeometric& path) {
  og::PathSimplifier simplifier(information);
  constexpr unsigned most = 60;
  constexpr unsigned patience = 25;
  constexpr double whole = 1;
  simplifier.reduceVertices(path, most, patience, whole);
  simplifier.shortcutPath(path, most, patience, whole);
  simplifier.reduceVertices(path, most, patience, whole);
}

} // namespace

FoundPoses search_poses(const CellMap& map, const FootprintRoom& room, const Pose2& start,
                        const std::vector<Pose2>& goals, const std::vector<Point2>& guide,
                        const PosePlanOptions& options, const PoseSearch& attempt) {
  const std::lock_guard lock(seeding());
  // It calls it an error to set a seed again; samplers that are made from now on take it.
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(attempt.seed);
  const auto [states, steering] = space(options);
  states->setBounds(bounds_of(map));
  states->setStateSamplerAllocator([&guide](const ob::StateSpace* x) -> ob::StateSamplerPtr {
    return std::make_shared<GuidedSampler>(x, guide);
  });
  og::SimpleSetup setup(states);
  const auto& information = setup.getSpaceInformation();
  setup.setStateValidityChecker(
    [&room](const ob::State* state) { return room.at(pose_of(state)) > 0; });
  information->setMotionValidator(std::make_shared<FreeMotions>(information, *steering, room));
  auto planner = std::make_shared<og::RRTConnect>(information);
  planner->setRange(attempt.range);
  setup.setPlanner(planner);
  ob::ScopedState<ob::SE2StateSpace> state(states);
  set(state.get(), start);
  setup.setStartState(state);
  const auto ends = std::make_shared<ob::GoalStates>(information);
  for (const auto& x : goals) {
    set(state.get(), x);
    ends->addState(state.get());
  }
  setup.setGoal(ends);
  ob::IterationTerminationCondition steps(attempt.steps);
  const auto until =
    ob::plannerOrTerminationCondition(ob::PlannerTerminationCondition(steps),
                                      ob::timedPlannerTerminationCondition(attempt.time_limit));
  // An approximate solution, which does not reach the goal, would count as true.
  if (setup.solve(until) != ob::PlannerStatus::EXACT_SOLUTION)
    return {};
  auto& found = setup.getSolutionPath();
  const auto result = way_along(start, found, *states, *steering);
  shorten(information, found);
  // Pieces of a curve need not be the shortest between their ends, which lead elsewhere.
  auto shorter = way_along(start, found, *states, *steering);
  return room.is_free(shorter.path, fine_step) ? shorter : result;
}

} // namespace castor::mapping
