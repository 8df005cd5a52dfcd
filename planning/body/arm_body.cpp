#include "castor/planning/body/arm_body.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/grasp_candidates.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace castor::manipulation {

namespace {

/// By what share of its lag a joint catches up in a second.
constexpr double catch_up = 10;
/// Fingers are that much wider apart than the thing that they hold, so that they do not touch it,
/// and a thing gives way that much on each side; metres.
constexpr double give = 0.0005;
/// Speeds below are rest.
constexpr double rest_speed = 1e-3;
/// Things are pushed in steps of that length, metres, as many as a step of the arm may take.
constexpr double push_step = 0.0005;
constexpr int most_push_steps = 40;

double seconds_of(std::chrono::microseconds x) {
  return std::chrono::duration<double>(x).count();
}

/// The thing without its outermost half millimetre.
NamedSolid shrunk(NamedSolid x) {
  for (auto* length : {&x.solid.size.x, &x.solid.size.y, &x.solid.size.z})
    *length = std::max(*length - 2 * give, *length / 2);
  return x;
}

} // namespace

ArmBody::ArmBody(ArmModel arm, TableWorld world, const Configuration& start,
                 const ArmBodyOptions& options)
  : arm_(std::move(arm)), world_(std::move(world)), options_(options),
    reference_(start, options.stop_time), positions_(start), speeds_(start.size(), 0),
    opening_(arm_.gripper ? arm_.gripper->widest : 0), wanted_opening_(opening_),
    random_(options.seed) {
  if (!within_limits(arm_, start))
    throw std::invalid_argument("the arm cannot begin there: not one number within its limits for "
                                "each joint that moves");
  if (const auto contact = checker().contact(start))
    throw std::invalid_argument("the arm cannot begin there: " + contact->part + " touches " +
                                contact->other);
  world_.move_tool(tool());
}

Pose ArmBody::tool() const {
  return tool_pose(arm_, positions_);
}

CollisionChecker& ArmBody::checker() {
  if (!checker_) {
    CollisionOptions options;
    options.margin = 0;
    options.opening = opening_;
    for (const auto& name : {slipped_, let_go_})
      if (!name.empty())
        options.may_touch.push_back(name);
    // Fingers that move push it to where they meet, or let go of it.
    if (wanted_opening_ != opening_)
      if (const auto* thing = world_.between_fingers(*arm_.gripper, tool(), opening_))
        options.may_touch.push_back(thing->thing.name);
    auto scene = world_.scene();
    if (scene.held)
      scene.held = shrunk(*scene.held);
    checker_.emplace(arm_, scene, options);
  }
  return *checker_;
}

void ArmBody::command(const ArmCommand& command, std::chrono::microseconds holds) {
  if (command.motion != motion_) {
    fault_.clear();
    fault_joint_.clear();
    brakes_ = false;
    motion_ = command.motion;
    pushed_.clear();
  }
  if (fault_.empty()) {
    reference_.follow(command);
    wanted_opening_ =
      arm_.gripper ? std::clamp(command.opening, arm_.gripper->narrowest, arm_.gripper->widest) : 0;
    pushes_ = command.pushes;
  }
  commanded_until_ = holds < std::chrono::microseconds::max() - time() ? time() + holds : holds;
}

void ArmBody::release() {
  commanded_until_ = time();
}

bool ArmBody::goes_on() const {
  return fault_.empty() && time() < commanded_until_;
}

void ArmBody::step() {
  const double seconds = seconds_of(options_.step);
  if (loses_at_ && steps_ >= *loses_at_)
    lose();
  move_joints(seconds);
  if (goes_on())
    move_fingers(seconds);
  uncommanded_ = is_still() || time() < commanded_until_ ? 0 : uncommanded_ + seconds;
  longest_uncommanded_ = std::max(longest_uncommanded_, uncommanded_);
  ++steps_;
}

bool ArmBody::is_still() const {
  return std::ranges::all_of(speeds_, [](double x) { return std::abs(x) < rest_speed; });
}

void ArmBody::move_joints(double seconds) {
  const auto before = reference_.position();
  reference_.advance(seconds, goes_on());
  const auto after = reference_.position();
  const auto moving = moving_joints(arm_);
  Configuration next = positions_;
  double largest = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto& joint = arm_.joints[moving[i]];
    double speed =
      brakes_ ? 0 : (after[i] - before[i]) / seconds + catch_up * (before[i] - positions_[i]);
    speed = std::clamp(speed, -joint.speed, joint.speed);
    const double change = joint.acceleration * seconds;
    speed = std::clamp(speed, speeds_[i] - change, speeds_[i] + change);
    if (stuck_ == i)
      speed = 0;
    next[i] = std::clamp(positions_[i] + speed * seconds, joint.lower, joint.upper);
    largest = std::max(largest, std::abs(next[i] - positions_[i]));
    speeds_[i] = (next[i] - positions_[i]) / seconds;
    if (fault_.empty() && std::abs(after[i] - next[i]) > options_.most_lag) {
      fault_joint_ = joint.name;
      stop("the joint " + joint.name + " does not follow");
      brakes_ = true;
    }
  }
  if (largest <= 0) {
    if (std::exchange(brakes_, false))
      reference_.stay(positions_);
    return;
  }
  if (const auto contact = contact_at(next)) {
    stop_at_contact(*contact);
    return;
  }
  moved_ += distance(positions_, next);
  positions_ = std::move(next);
  world_.move_tool(tool());
  ++changes_;
}

std::optional<Contact> ArmBody::contact_at(const Configuration& positions) {
  auto contact = checker().contact(positions);
  while (contact && pushes_ && contact->part == "the gripper" && !contact->is_of_arm) {
    const auto from = tool().position;
    const auto to = tool_pose(arm_, positions).position;
    if (!push_away(contact->other, positions, to.x - from.x, to.y - from.y))
      return contact;
    contact = checker().contact(positions);
  }
  return contact;
}

bool ArmBody::push_away(const std::string& thing, const Configuration& positions, double along_x,
                        double along_y) {
  const double length = std::hypot(along_x, along_y);
  const auto& things = world_.things();
  const bool is_thing = std::ranges::any_of(
    things, [&](const auto& x) { return x.thing.name == thing && x.support != "the floor"; });
  if (!is_thing || length < 1e-9)
    return false;
  const double x = along_x / length * push_step;
  const double y = along_y / length * push_step;
  for (int i = 0; i < most_push_steps; ++i) {
    if (!world_.push(thing, x, y))
      return false;
    checker_.reset();
    ++changes_;
    const auto contact = checker().contact(positions);
    if (!contact || contact->other != thing)
      return true;
  }
  return false;
}

void ArmBody::move_fingers(double seconds) {
  if (!arm_.gripper || opening_ == wanted_opening_)
    return;
  const double change = arm_.gripper->speed * seconds;
  const double before = opening_;
  if (wanted_opening_ > opening_) {
    if (world_.open_gripper())
      loses_at_.reset();
    open_fingers(std::min(wanted_opening_, opening_ + change));
    if (opening_ == wanted_opening_)
      slipped_.clear();
  } else if (!world_.held()) {
    opening_ = std::max(wanted_opening_, opening_ - change);
    const auto* thing = world_.between_fingers(*arm_.gripper, tool(), opening_);
    if (thing && thing->thing.name != slipped_)
      grasp(*thing);
  }
  if (opening_ != before)
    ++changes_;
  checker_.reset();
}

void ArmBody::open_fingers(double opening) {
  const auto* between = world_.between_fingers(*arm_.gripper, tool(), opening_);
  let_go_ = between ? between->thing.name : std::string{};
  checker_.reset();
  if (const auto contact = contact_when_open(opening))
    stop_at_contact(*contact);
  else
    opening_ = opening;
  let_go_.clear();
  checker_.reset();
}

std::optional<Contact> ArmBody::contact_when_open(double opening) {
  // What they touch already, as it has turned when it was let go, is not what they open against.
  if (!checker().is_free(positions_))
    return {};
  const double before = std::exchange(opening_, opening);
  checker_.reset();
  const auto across = geometry::rotate(tool().rotation, Point3{0, 1, 0});
  auto contact = checker().contact(positions_);
  while (contact && contact->part == "the gripper" && !contact->is_of_arm) {
    const auto name = contact->other;
    if (!push_outwards(name, across))
      break;
    count_push(name);
    contact = checker().contact(positions_);
  }
  opening_ = before;
  return contact;
}

bool ArmBody::push_outwards(const std::string& thing, const Point3& across) {
  const auto found =
    std::ranges::find(world_.things(), thing, [](const WorldThing& x) { return x.thing.name; });
  if (found == world_.things().end())
    return false;
  const auto at = found->thing.pose.position;
  const auto middle = tool().position;
  const bool is_ahead = (at.x - middle.x) * across.x + (at.y - middle.y) * across.y >= 0;
  const double sign = is_ahead ? 1 : -1;
  return push_away(thing, positions_, sign * across.x, sign * across.y);
}

/// Once the fingers have come to it.
void ArmBody::grasp(const WorldThing& thing) {
  const auto y_axis = geometry::rotate(tool().rotation, Point3{0, 1, 0});
  const double width = 2 * half_extent(thing.thing, y_axis);
  if (opening_ > width + 2 * give)
    return;
  if (std::bernoulli_distribution(options_.missed_grasp)(random_) ||
      !is_between_pads(*arm_.gripper, thing.thing, tool(), 0)) {
    slipped_ = thing.thing.name;
    ++missed_;
    return;
  }
  opening_ = std::min(arm_.gripper->widest, width + 2 * give);
  // To the middle between the fingers, if there is room.
  const auto at = thing.thing.pose.position;
  const auto centre = tool().position;
  const double off =
    (at.x - centre.x) * y_axis.x + (at.y - centre.y) * y_axis.y + (at.z - centre.z) * y_axis.z;
  world_.push(thing.thing.name, -off * y_axis.x, -off * y_axis.y);
  world_.close_gripper(*arm_.gripper, tool(), opening_);
  if (std::bernoulli_distribution(options_.dropped)(random_)) {
    const double after =
      std::uniform_real_distribution(0.5, std::max(0.6, options_.dropped_within))(random_);
    loses_at_ = steps_ + static_cast<std::int64_t>(after / seconds_of(options_.step));
  }
}

void ArmBody::lose() {
  loses_at_.reset();
  const auto lost = world_.open_gripper();
  if (!lost)
    return;
  slipped_ = *lost;
  ++dropped_;
  ++changes_;
  checker_.reset();
}

void ArmBody::stop_at_contact(const Contact& contact) {
  std::ranges::fill(speeds_, 0);
  const auto text = contact.part + " touches " + contact.other;
  if (fault_.empty() || collision_ != text) {
    ++collisions_;
    collision_ = text;
  }
  stop(text);
  brakes_ = false;
  reference_.stay(positions_);
}

void ArmBody::count_push(const std::string& thing) {
  if (pushed_ == thing)
    return;
  pushed_ = thing;
  ++collisions_;
  collision_ = "the opening gripper pushes " + thing;
}

void ArmBody::stop(std::string fault) {
  if (fault_.empty())
    fault_ = std::move(fault);
  wanted_opening_ = opening_;
}

SavedArm ArmBody::saved() const {
  return {positions_, opening_, changes_, collisions_, missed_, dropped_, moved_, world_.things()};
}

void ArmBody::resume(const SavedArm& x) {
  if (!within_limits(arm_, x.positions))
    throw std::invalid_argument("the joints of another arm");
  world_.restore(x.things, tool_pose(arm_, x.positions));
  positions_ = x.positions;
  speeds_.assign(positions_.size(), 0);
  reference_.stay(positions_);
  opening_ = wanted_opening_ = x.opening;
  // Pictures of what came after the state was saved are not taken for new ones.
  constexpr std::uint64_t unsaved = 1000;
  changes_ = x.changes + unsaved;
  collisions_ = x.collisions;
  missed_ = x.missed;
  dropped_ = x.dropped;
  moved_ = x.moved;
  random_.seed(options_.seed + changes_);
  checker_.reset();
}

ArmState ArmBody::state() const {
  ArmState result;
  result.time = time().count();
  result.positions = positions_;
  result.speeds = speeds_;
  result.opening = opening_;
  result.holds = world_.held() != nullptr;
  result.motion = motion_;
  result.motion_time = reference_.time();
  const bool fingers_rest = opening_ == wanted_opening_ || world_.held() || !goes_on();
  result.rests = is_still() && fingers_rest;
  result.fault = fault_;
  result.fault_joint = fault_joint_;
  return result;
}

ArmStatus ArmBody::status() const {
  ArmStatus result;
  result.time = time().count();
  for (const auto& [thing, support] : world_.things())
    result.things.push_back({thing.name, thing.pose, support});
  result.collisions = collisions_;
  result.collision = collision_;
  result.missed = missed_;
  result.dropped = dropped_;
  result.moved = moved_;
  result.uncommanded = longest_uncommanded_;
  return result;
}

} // namespace castor::manipulation
