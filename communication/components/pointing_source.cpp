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

/// Points at a place on the table, from the beginning on and as long as nobody points elsewhere.
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
    if (!place_)
      return;
    try {
      add(here("pointing"), Pointing{place_->x, place_->y, now().count(), true},
          {.only_once = true});
    } catch (const AlreadyExistsOnWM&) {
      trace("it was pointed there before");
    }
  }

  Option<std::string> at_{this, "at", "",
                          "place on the table that is pointed at: X,Y in metres; empty: nowhere"};

  std::optional<Place> place_;
};

CASTOR_COMPONENT(PointingSource, "points at a place on the table")

} // namespace

} // namespace castor::communication
