#include "castor/benchmarks/manipulation/physics/physical_table.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace castor::manipulation {

namespace {

/// Seconds in which things come to rest at the beginning, and fingers and joints after a motion.
constexpr double settling = 0.5;

struct DeleteModel {
  void operator()(mjModel* x) const { mj_deleteModel(x); }
};
struct DeleteData {
  void operator()(mjData* x) const { mj_deleteData(x); }
};
using Model = std::unique_ptr<mjModel, DeleteModel>;
using Data = std::unique_ptr<mjData, DeleteData>;

Model model_of(const std::string& text) {
  constexpr const char* name = "arm.xml";
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, name, static_cast<int>(text.size()));
  const int index = mj_findFileVFS(&files, name);
  std::copy(text.begin(), text.end(), static_cast<char*>(files.filedata[index]));
  std::array<char, 1000> error{};
  Model result(mj_loadXML(name, &files, error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(&files);
  if (!result)
    throw std::runtime_error(std::string("MuJoCo: ") + error.data());
  return result;
}

} // namespace

class PhysicalTable::Simulation {
public:
  Simulation(const ArmModel& arm, const Scene& scene, const Configuration& start,
             const PhysicsOptions& options)
    : model_(model_of(physics_model(arm, scene, options))), data_(mj_makeData(model_.get())) {
    for (auto i : moving_joints(arm))
      joints_.push_back(index(mjOBJ_JOINT, arm.joints[i].name));
    for (std::size_t i = 0; i < 2; ++i)
      fingers_.push_back(index(mjOBJ_JOINT, finger_joint(i)));
    for (const auto& x : arm.links)
      for (std::size_t i = 0; i < x.shapes.size(); ++i)
        links_.insert(x.name + (i == 0 ? "" : ' ' + std::to_string(i + 1)));
    for (std::size_t i = 0; i < joints_.size(); ++i)
      data_->qpos[position(joints_[i])] = data_->ctrl[i] = start.at(i);
    opening_ = arm.gripper->widest;
    finger_speed_ = arm.gripper->speed / 2;
    for (std::size_t i = 0; i < fingers_.size(); ++i)
      data_->qpos[position(fingers_[i])] = data_->ctrl[joints_.size() + i] = opening_ / 2;
    mj_forward(model_.get(), data_.get());
    const JointState state{start, Configuration(start.size(), 0), {}};
    for (double time = 0; time < settling; time += model_->opt.timestep)
      step(state, opening_);
    touched_.clear();
  }

  void carry_out(const MotionStage& stage) {
    const double fingers_take = std::abs(stage.opening - opening_) / (2 * finger_speed_);
    const double duration = std::max(stage.trajectory.duration(), fingers_take) + settling;
    for (double time = 0; time < duration; time += model_->opt.timestep)
      step(stage.trajectory.at(time), stage.opening);
  }

  Configuration positions() const {
    Configuration result;
    for (auto x : joints_)
      result.push_back(data_->qpos[position(x)]);
    return result;
  }

  double opening() const {
    return data_->qpos[position(fingers_[0])] + data_->qpos[position(fingers_[1])];
  }

  Pose pose_of(const std::string& thing) const {
    const auto body = static_cast<std::size_t>(index(mjOBJ_BODY, thing));
    const mjtNum* at = data_->xpos + 3 * body;
    const mjtNum* turned = data_->xquat + 4 * body;
    return {{at[0], at[1], at[2]}, {turned[0], turned[1], turned[2], turned[3]}, arm_frame};
  }

  const std::set<std::string>& touched() const { return touched_; }
  double most_lag() const { return most_lag_; }

private:
  int index(mjtObj kind, const std::string& name) const {
    const int result = mj_name2id(model_.get(), kind, name.c_str());
    if (result < 0)
      throw std::invalid_argument("there is no " + name);
    return result;
  }

  std::size_t position(int joint) const {
    return static_cast<std::size_t>(model_->jnt_qposadr[joint]);
  }

  std::size_t degree_of_freedom(int joint) const {
    return static_cast<std::size_t>(model_->jnt_dofadr[joint]);
  }

  /// @param opening that the fingers go to, with their speed
  void step(const JointState& wanted, double opening) {
    const double most = finger_speed_ * model_->opt.timestep;
    opening_ += std::clamp(opening - opening_, -2 * most, 2 * most);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      // What damping costs is added, so that a joint that moves evenly does not lag behind.
      data_->ctrl[i] = wanted.positions[i] + wanted.speeds[i] * joint_damping / joint_stiffness;
      compensate_weight(joints_[i]);
    }
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      data_->ctrl[joints_.size() + i] = opening_ / 2;
      compensate_weight(fingers_[i]);
    }
    mj_step(model_.get(), data_.get());
    for (std::size_t i = 0; i < joints_.size(); ++i)
      most_lag_ =
        std::max(most_lag_, std::abs(data_->qpos[position(joints_[i])] - wanted.positions[i]));
    note_contacts();
  }

  void compensate_weight(int joint) {
    const auto at = degree_of_freedom(joint);
    data_->qfrc_applied[at] = data_->qfrc_bias[at];
  }

  void note_contacts() {
    for (int i = 0; i < data_->ncon; ++i) {
      const auto& contact = data_->contact[i];
      const std::string names[] = {name_of(contact.geom1), name_of(contact.geom2)};
      for (int side = 0; side < 2; ++side)
        if (contact.dist < 0 && links_.contains(names[side]))
          touched_.insert(names[1 - side]);
    }
  }

  std::string name_of(int shape) const {
    const char* name = mj_id2name(model_.get(), mjOBJ_GEOM, shape);
    return name ? name : "";
  }

  Model model_;
  Data data_;
  std::vector<int> joints_;
  std::vector<int> fingers_;
  std::set<std::string> links_;
  std::set<std::string> touched_;
  /// That the fingers are commanded to just now.
  double opening_ = 0;
  /// Of a finger, m/s.
  double finger_speed_ = 0;
  double most_lag_ = 0;
};

PhysicalTable::PhysicalTable(const ArmModel& arm, const Scene& scene, const Configuration& start,
                             const PhysicsOptions& options)
  : simulation_(std::make_unique<Simulation>(arm, scene, start, options)) {}

PhysicalTable::PhysicalTable(PhysicalTable&&) noexcept = default;
PhysicalTable& PhysicalTable::operator=(PhysicalTable&&) noexcept = default;
PhysicalTable::~PhysicalTable() = default;

void PhysicalTable::carry_out(const MotionStage& stage) {
  simulation_->carry_out(stage);
}

Configuration PhysicalTable::positions() const {
  return simulation_->positions();
}

double PhysicalTable::opening() const {
  return simulation_->opening();
}

Pose PhysicalTable::pose_of(const std::string& thing) const {
  return simulation_->pose_of(thing);
}

const std::set<std::string>& PhysicalTable::touched() const {
  return simulation_->touched();
}

double PhysicalTable::most_lag() const {
  return simulation_->most_lag();
}

} // namespace castor::manipulation
