#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/perception/vision/types.hpp"

#include <memory>
#include <string>

namespace castor::vision {

/// A component derived from `Base` that looks at the scene, unless others inhibit that with
/// InhibitSceneProcessing entries.
template <class Base>
class LooksAtScene : public Base {
protected:
  /// To be called in `start()`.
  void watch_inhibition() {
    this->on_change(deleted<InhibitSceneProcessing>(), [this](const ChangeEvent&) {
      end_of_inhibition_ = this->now();
      if (!is_inhibited())
        look_again();
    });
  }

  /// The newest picture of the scene; null while it is inhibited to look at it, and for a picture
  /// that may have been taken before the last inhibition ended.
  std::shared_ptr<const CameraFrame> picture_of_scene(const std::string& camera) {
    if (is_inhibited())
      return nullptr;
    auto result = this->template pull<CameraFrame>(camera);
    // Once more: the picture may be newer than the first answer.
    if (is_inhibited() || Timestamp{result->time} <= end_of_inhibition_)
      return nullptr;
    return result;
  }

  bool is_inhibited() {
    if (this->template read_all<InhibitSceneProcessing>(1).empty())
      return false;
    end_of_inhibition_ = this->now();
    return true;
  }

  /// Called when nobody inhibits any more.
  virtual void look_again() {}

private:
  /// When an inhibition was last seen, or seen to end.
  Timestamp end_of_inhibition_{-1};
};

} // namespace castor::vision
