#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/communication/dialogue/pointing.hpp"
#include "castor/communication/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <optional>
#include <stdexcept>
#include <string>

namespace castor::communication {

namespace {

/// Points at a place on the table, from its start on, until somebody points elsewhere or it ends: a
/// journal keeps no gesture of an earlier run.
class PointingSource final : public UnmanagedComponent {
  void configure() override {
    if (at_->empty())
      return;
    place_ = place_of_text(at_.get());
    if (!place_)
      throw std::invalid_argument("--at \"" + at_.get() +
                                  "\" is no place; give X,Y in metres, such as 0.1,-0.2");
  }

  void start() override {
    while (place_ && is_running() && !point())
      debug("the earlier gesture is removed");
  }

  /// False if there was another gesture of this name, which is deleted.
  bool point() {
    const auto address = here("pointing");
    try {
      add(address, Pointing{place_->x, place_->y, now().count(), true}, {.ephemeral = true});
      return true;
    } catch (const AlreadyExistsOnWM&) {
      remove(address);
      return false;
    }
  }

  void remove(const Address& address) {
    try {
      delete_entry(address);
    } catch (const DoesNotExistOnWM&) {
      trace("{} is gone already", address.id);
    }
  }

  Option<std::string> at_{this, "at", "",
                          "place on the table that is pointed at: X,Y in metres; empty: nowhere"};

  std::optional<Place> place_;
};

CASTOR_COMPONENT(PointingSource, "points at a place on the table")

} // namespace

} // namespace castor::communication
