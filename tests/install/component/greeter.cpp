#include <castor/actors/registry.hpp>

struct Greeting {
  std::string text;
};
CASTOR_REFLECT(Greeting, text)

class Greeter : public castor::UnmanagedComponent {
  void run() override { add(Greeting{"hello"}); }
};
CASTOR_COMPONENT(Greeter, "says hello once")
