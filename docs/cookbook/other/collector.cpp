#include <castor/castor.hpp>
#include <cup.hpp>

class Collector : public castor::UnmanagedComponent {
  void stop() override { info("collected {} cups", read_all_in<Cup>("vision").size()); }
};
CASTOR_COMPONENT(Collector, "reads cups that another library adds")
