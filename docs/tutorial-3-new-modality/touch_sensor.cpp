#include "touch.hpp"

#include <castor/castor.hpp>

class TouchSensor : public castor::UnmanagedComponent {
  castor::Option<double> x_{this, "x", 0, "where it touches, metres to the right"};
  castor::Option<double> y_{this, "y", 0, "metres away from the viewer"};
  castor::Option<double> z_{this, "z", 0, "metres above the table"};
  castor::Option<std::string> material_{this, "material", "wood", "what it feels"};

  void run() override { add(Touch{x_, y_, z_, material_.get()}); }
};
CASTOR_COMPONENT(TouchSensor, "touches something once")
