#include <castor/castor.hpp>

#include <chrono>

using namespace std::chrono_literals;

class Worker : public castor::ManagedComponent {
  void start() override {
    propose_task("tidy up", [this] { sleep_for(200ms); });
    auto look = propose_task("look", [this] { sleep_for(50ms); }, {.priority = 1});
    propose_task("grasp", [this] { sleep_for(50ms); }, {.priority = 5, .after = {look}});
    propose_task("stop the arm", [this] { sleep_for(50ms); }, {.priority = 9});
  }
};
CASTOR_COMPONENT(Worker, "proposes four tasks")
