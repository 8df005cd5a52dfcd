#include <castor/castor.hpp>

namespace outdated {

struct Cup {
  double distance = 0;
};
CASTOR_REFLECT(Cup, distance)

} // namespace outdated

class OutdatedReader : public castor::UnmanagedComponent {
  void stop() override { read_all_in<outdated::Cup>("vision"); }
};
CASTOR_COMPONENT(OutdatedReader, "takes a cup for what it once was")
