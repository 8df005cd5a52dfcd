// How fast simulated time goes on: a body is simulated and controlled at 100 Hz, the one pushes
// what it measures, the other commands it, for some simulated time, as fast as possible.
//
//   clock_benchmark [SECONDS [TIMES]]
//
// In one process, one after the other (`reproducible`), over three processes (body, controller and
// coordinator), and, for comparison, the same loop as a function that calls another.
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto period = 10ms;

/// A cart on a line, with friction.
struct Cart {
  double position = 1;
  double speed = 0;

  void step(double force) {
    speed += (force - 0.5 * speed) * 0.01;
    position += speed * 0.01;
  }
};
CASTOR_REFLECT(Cart, position, speed)

struct Force {
  double newton = 0;
};
CASTOR_REFLECT(Force, newton)

double controlled(const Cart& x) {
  return -4 * x.position - 2 * x.speed;
}

class Body final : public StandaloneComponent {
  void start() override {
    on_command<Force>([this](const Force& x) { force_ = x.newton; }, [this] { force_ = 0; });
    every(period, [this] {
      cart_.step(force_);
      push(cart_);
    });
  }

  Cart cart_;
  double force_ = 0;
};
CASTOR_COMPONENT(Body, "is simulated at 100 Hz")

class Controller final : public UnmanagedComponent {
  void start() override {
    on_push<Cart>("body", [this](const std::shared_ptr<const Cart>& x) {
      stream_command("body", Force{controlled(*x)});
    });
  }
};
CASTOR_COMPONENT(Controller, "commands the body")

ArchitectureDescription architecture(const std::string& body, const std::string& controller) {
  auto result = cast::parse_string(
    "HOST localhost\nCOMPONENT " + body + " CPP body Body\nSUBARCHITECTURE control " + controller +
      "\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n"
      "CPP UM controller Controller\n",
    "clock_benchmark.cast");
  if (!result.architecture)
    throw std::runtime_error(render(result.diagnostics));
  return *std::move(result.architecture);
}

/// Real seconds that the simulated time takes.
double measure(const ArchitectureDescription& x, SystemOptions options, std::chrono::seconds time) {
  options.clock.pace = Pace{};
  System system{x, options};
  system.start();
  auto begin = Clock::now();
  system.wait({time, std::nullopt});
  auto took = Clock::now() - begin;
  system.stop();
  return std::chrono::duration<double>(took).count();
}

double measure_function(std::chrono::seconds time) {
  auto begin = Clock::now();
  Cart cart;
  for (auto i = time / period; i > 0; --i)
    cart.step(controlled(cart));
  volatile double result = cart.position;
  (void)result;
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void print(const char* name, std::vector<double> seconds, std::chrono::seconds time) {
  std::sort(seconds.begin(), seconds.end());
  auto median = seconds[seconds.size() / 2];
  auto simulated = std::chrono::duration<double>(time).count();
  fmt::print("{:22} {:10.4f} {:10.4f} {:10.4f} {:12.1f} {:10.0f}\n", name, seconds.front(), median,
             seconds.back(), 1e6 * median / (simulated * 100), simulated / median);
}

int run(std::chrono::seconds time, int times) {
  set_log_level(LogLevel::warning);
  NodeProcess one{"one", 10s};
  NodeProcess two{"two", 10s};
  SystemOptions over_nodes;
  over_nodes.nodes = {{"one", one.endpoint()}, {"two", two.endpoint()}};
  SystemOptions in_turn;
  in_turn.clock.reproducible = true;
  std::vector<double> function;
  std::vector<double> parallel;
  std::vector<double> turns;
  std::vector<double> nodes;
  for (int i = 0; i < times; ++i) {
    function.push_back(measure_function(time));
    parallel.push_back(measure(architecture("[localhost]", "localhost"), {}, time));
    turns.push_back(measure(architecture("[localhost]", "localhost"), in_turn, time));
    nodes.push_back(measure(architecture("[one]", "two"), over_nodes, time));
  }
  fmt::print("{} simulated seconds at 100 Hz, {} times\n", time.count(), times);
  fmt::print("{:22} {:>10} {:>10} {:>10} {:>12} {:>10}\n", "seconds", "least", "median", "most",
             "us per step", "speed");
  print("a function", function, time);
  print("one process", parallel, time);
  print("reproducible", turns, time);
  print("three processes", nodes, time);
  return 0;
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  return run(std::chrono::seconds{argc > 1 ? std::atoi(argv[1]) : 600},
             argc > 2 ? std::atoi(argv[2]) : 3);
}
