#include <castor/castor.hpp>
#include <cup.hpp>

class Guesser : public castor::UnmanagedComponent {
  void run() override { add({"vision", new_id()}, Cup{3, "teapot"}); }
};
CASTOR_COMPONENT(Guesser, "tells vision of a cup that it has not seen")
