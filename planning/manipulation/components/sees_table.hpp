#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/seen_table.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// A component derived from `Base` that knows what vision sees, and keeps vision from looking while
/// an arm is in the picture.
template <class Base>
class SeesTable : public Base {
protected:
  /// From now on, vision does not look. Nothing else is to move the arm through the picture.
  void inhibit_vision() {
    if (inhibition_)
      return;
    const Address address{vision_, this->new_id()};
    this->add(address, vision::InhibitSceneProcessing{this->component_name()}, {.ephemeral = true});
    inhibition_ = address;
  }

  void release_vision() {
    if (!inhibition_)
      return;
    try {
      this->delete_entry(*inhibition_);
    } catch (const DoesNotExistOnWM&) {
      this->debug("somebody else has deleted the inhibition");
    }
    inhibition_.reset();
    released_ = this->now();
  }

  bool is_vision_inhibited() const { return inhibition_.has_value(); }

  /// Whether vision has looked at the table as it is now, and named what it sees. To be asked again
  /// and again.
  bool has_vision_looked() {
    const auto time = this->now();
    const auto scenes = this->template read_all_in<vision::SceneChanged>(vision_.get());
    bool is_settled = !scenes.empty();
    for (const auto& x : scenes)
      if (x->changing || (x->changed && !x->processed))
        is_settled = false;
    if (!is_settled)
      unsettled_ = time;
    const auto since = std::max(unsettled_, released_);
    if (time - since < settled_.get())
      return false;
    for (const auto& x : this->template read_all_in<vision::SceneObject>(vision_.get()))
      if (x->colour == vision::Hypothesis{} && time - since < unnamed_.get())
        return false;
    return true;
  }

  /// What vision sees now.
  /// @param arm its pose in the table's frame
  std::vector<SeenThing> look_at_table(const geometry::Pose& arm) {
    SeenEntries entries;
    for (const auto& x : this->template read_all_in<vision::SceneObject>(vision_.get()))
      entries.objects[x.address.id] = *x;
    for (const auto& x : this->template read_all_in<vision::ROI>(vision_.get()))
      entries.regions[x.address.id] = *x;
    for (const auto& x : this->template read_all_in<geometry::Camera>(vision_.get()))
      entries.camera = *x;
    return seen_things(entries, arm);
  }

  /// Nothing if it is not known where the camera is.
  std::optional<geometry::Camera> camera() {
    for (const auto& x : this->template read_all_in<geometry::Camera>(vision_.get()))
      if (!x->is_assumed)
        return *x;
    return {};
  }

  const std::string& vision() const { return vision_.get(); }

private:
  Option<SubarchitectureName> vision_{this, "vision", "vision",
                                      "subarchitecture that sees the table"};
  Option<std::chrono::milliseconds> settled_{
    this, "settled", std::chrono::milliseconds{1200},
    "vision has looked when it has found nothing to do for so long"};
  Option<std::chrono::milliseconds> unnamed_{
    this, "unnamed", std::chrono::seconds{4},
    "how long it waits for the names of things that vision has found"};

  std::optional<Address> inhibition_;
  Timestamp released_{0};
  Timestamp unsettled_{0};
};

} // namespace castor::manipulation
