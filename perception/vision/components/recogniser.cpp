#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/learning/word_learner.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/size_on_table.hpp"
#include "castor/perception/vision/scene_object_changes.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor::vision {

namespace {

/// Names the colour, shape and size of scene objects by the features of their regions.
class Recogniser final : public ManagedComponent {
  void start() override {
    on_change(overwritten<ROI>(), [this](const ChangeEvent& event) { look(event.address); });
    on_change(changed<LearnedWords>(), [this](const ChangeEvent&) { look_at_all(); });
    // What a predecessor may not have got to.
    look_at_all();
  }

  /// With the words that are known by now.
  void look_at_all() {
    words_ = WordLearner{};
    for (auto& x : read_all<LearnedWords>())
      words_ = WordLearner{x->words};
    for (auto& roi : read_all<ROI>())
      look(roi.address);
  }

  void look(const Address& address) {
    propose_task("recognise an object", [this, address] { recognise(address); });
  }

  void recognise(const Address& address) {
    try {
      // Others refine the object too, and what they wrote meanwhile must not be lost.
      while (!name(here(read<ROI>(address)->object_id), address))
        debug("{} was changed meanwhile; once more", address.id);
    } catch (const DoesNotExistOnWM&) {
      debug("{} is gone before it was recognised", address.id);
    }
  }

  /// False if somebody else wrote the object at the same time.
  bool name(const Address& address, const Address& roi_address) {
    auto before = read<SceneObject>(address);
    // In this order: a tracker moves both at once, and the object not back to where it was.
    auto roi = read<ROI>(roi_address);
    if (!roi->has_features)
      return true;
    auto& features = roi->features;
    auto after = *before;
    after.colour = judge("colour", features.colours, features);
    after.shape = judge("shape", features.shapes, features);
    SizeOptions size;
    size.large_from = large_from_;
    after.size = best_of(judge_size(features.extent, features.is_extent_assumed, size));
    after.label = {after.colour.value + ' ' + after.shape.value,
                   after.colour.confidence * after.shape.confidence};
    if (features.extent != AlignedBox{})
      place_at(features.extent, after);
    if (features.lengths != Point3{})
      after.lengths = features.lengths;
    auto update = changes(address.id, *before, after);
    if (!is_change(update))
      return true;
    WriteBatch batch;
    batch.overwrite(address, std::move(after));
    batch.add(here(new_id()), std::move(update), update_life);
    try {
      write(batch);
    } catch (const ConsistencyException&) {
      return false;
    }
    return true;
  }

  /// What was learned comes before what was known beforehand.
  Hypothesis judge(const std::string& kind, const std::vector<Hypothesis>& beforehand,
                   const RegionFeatures& features) const {
    auto learned = best_of(words_.name(kind, WordLearner::evidence(kind, features)));
    return learned.value != Hypothesis{}.value ? learned : best_of(beforehand);
  }

  Option<double> large_from_{this, "large-from", SizeOptions{}.large_from,
                             "longest side from which on an object is called large, metres"};

  WordLearner words_;
};

CASTOR_COMPONENT(Recogniser, "names the colour, shape and size of scene objects")

} // namespace

} // namespace castor::vision
