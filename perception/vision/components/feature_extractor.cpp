#include "castor/actors/component/registry.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <string>

namespace castor::vision {

namespace {

/// Measures new regions: colour, shape, and size on the table.
class FeatureExtractor final : public ManagedComponent {
  void start() override {
    on_change(added<ROI>(), [this](const ChangeEvent& event) { look(event.address); });
    on_change(overwritten<ROI>(), [this](const ChangeEvent& event) {
      if (event.source != component_name())
        look(event.address);
    });
    // What a predecessor did not get to.
    for (auto& roi : read_all<ROI>())
      if (!roi->has_features)
        look(roi.address);
  }

  void look(const Address& address) {
    propose_task("measure a region", [this, address] { measure(address); });
  }

  void measure(const Address& address) {
    try {
      auto roi = *read<ROI>(address);
      if (roi.has_features)
        return;
      auto camera = pull<CameraFrame>(camera_)->camera;
      roi.features = measure_region(roi, &camera);
      roi.has_features = true;
      overwrite(address, std::move(roi));
    } catch (const DoesNotExistOnWM&) {
      debug("{} is gone before it was measured", address.id);
    } catch (const ConsistencyException&) {
      debug("{} shows something else by now, and will be measured again", address.id);
    }
  }

  Option<StandaloneName> camera_{this, "camera", "camera", "the camera that the regions come from"};
};

CASTOR_COMPONENT(FeatureExtractor, "measures the colour, shape and size of regions of interest")

} // namespace

} // namespace castor::vision
