#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/geometry/frame_tree.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/entries/failure.hpp"

#include <map>
#include <set>
#include <string>

namespace castor::geometry {

/// A component derived from `Base` that knows how frames lie in each other, from the Transform
/// entries of the subarchitectures that it is told to listen to:
///
///     class Grasper : public geometry::KnowsFrames<UnmanagedComponent> {
///       void start() override { know_frames_of("navigation"); }
///       ...
///       auto cup = frames().transform(seen.pose, "arm", Timestamp{seen.time});
///
/// Frames are up to date as of the last event that was delivered, as always.
template <class Base>
class KnowsFrames : public Base {
protected:
  explicit KnowsFrames(FrameTreeOptions options = {}) : frames_(options) {}

  const FrameTree& frames() const { return frames_; }

  /// From now on, what that subarchitecture's Transforms say counts, including those that are
  /// there. May be called for several.
  void know_frames_of(const std::string& subarchitecture_name) {
    this->on_change(changed<Transform>().in(subarchitecture_name),
                    [this](const ChangeEvent& event) { look_at_transform(event.address); });
    for (auto& x : this->template read_all_in<Transform>(subarchitecture_name))
      learn(x.address, *x);
  }

  /// Called when a frame has got another pose, or is known no longer.
  virtual void frames_changed() {}

private:
  void look_at_transform(const Address& address) {
    try {
      learn(address, *this->template read<Transform>(address));
    } catch (const DoesNotExistOnWM&) {
      forget(address);
    }
  }

  void learn(const Address& address, const Transform& x) {
    if (auto known = told_.find(address); known != told_.end() && known->second != x.frame)
      forget(address);
    try {
      frames_.add(x);
      told_[address] = x.frame;
      refused_.erase(address);
    } catch (const FrameException& e) {
      if (refused_.insert(address).second)
        this->warning("{} is ignored: {}", to_string(address), e.what());
      return;
    }
    frames_changed();
  }

  void forget(const Address& address) {
    refused_.erase(address);
    auto known = told_.find(address);
    if (known == told_.end())
      return;
    auto frame = known->second;
    frames_.remove(frame);
    told_.erase(known);
    // Others may say the same, and what contradicted it may be true now.
    auto others = refused_;
    for (auto& [other, told] : told_)
      if (told == frame)
        others.insert(other);
    for (auto& other : others)
      look_at_transform(other);
    frames_changed();
  }

  FrameTree frames_;
  /// The frames that entries place, by their addresses.
  std::map<Address, std::string> told_;
  /// Entries that do not fit into the tree.
  std::set<Address> refused_;
};

} // namespace castor::geometry
