// What it costs to bind one more proxy, by how many there are: from a monitor's writing of a proxy
// to its being bound, by the scorer, the judge and the binder of configs/playmate.cast. As a
// baseline: writing an entry there and reading it back.
//
//   binding_benchmark [MOST_PROXIES]
#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_monitor.hpp"
#include "castor/binding/features.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace castor::binding {

namespace {

using Clock = std::chrono::steady_clock;
using enum FeatureKind;

double milliseconds(Clock::duration x) {
  return std::chrono::duration<double, std::milli>(x).count();
}

std::string word(const char* stem, std::size_t i, std::size_t many) {
  return stem + std::to_string(i % many);
}

/// All of it unlike all else in some way.
BindingProxy seen(std::size_t i) {
  BindingProxy result;
  result.source = "vision";
  result.features = {
    feature(concept_name, "thing"),           feature(colour, word("colour", i, 11)),
    feature(shape, word("shape", i / 11, 7)), feature(material, word("material", i / 77, 300)),
    feature(temporal_frame, "perceived"),     not_from("vision")};
  return result;
}

/// What somebody says of the i-th.
BindingProxy described(std::size_t i) {
  BindingProxy result;
  result.source = "comsys";
  result.precedence = 1;
  result.features = {feature(concept_name, word("kind", i, 50)),
                     feature(colour, word("colour", i, 11)),
                     feature(material, word("material", i / 77, 300)), not_from("comsys")};
  return result;
}

/// Tells of many things, and then of one more, again and again.
class Crowd final : public BindingMonitor {
  void start() override {
    BindingMonitor::start();
    on_change(changed(&BindingProxy::state).in(binding()), [](const ChangeEvent&) {});
  }

  void run() override {
    while (!exists({binding(), binder_status}))
      sleep_for(std::chrono::milliseconds{1});
    for (std::size_t i = 0; i < proxies_; ++i) {
      tell("seen " + std::to_string(i), seen(i));
      if (i % 100 == 99 || i + 1 == proxies_) {
        publish();
        wait_for("seen " + std::to_string(i));
      }
    }
    std::vector<double> costs;
    for (std::size_t i = 0; i < 40; ++i) {
      const auto id = "more " + std::to_string(i);
      const auto begin = Clock::now();
      tell(id, described(i * 37));
      publish();
      wait_for(id);
      costs.push_back(milliseconds(Clock::now() - begin));
      withdraw(id);
      publish();
      while (exists({binding(), id}) && wait_for_changes(std::chrono::milliseconds{5}))
        continue;
    }
    std::sort(costs.begin(), costs.end());
    const double unit = round_trip();
    fmt::print("{:>8} {:>10.2f} ({:>4.0f}) {:>9.2f}\n", proxies_.get(), costs[costs.size() / 2],
               costs[costs.size() / 2] / unit, costs.back());
    end_system(0, "measured");
  }

  void wait_for(const std::string& id) {
    while (read<BindingProxy>({binding(), id})->state != ProxyState::bound)
      wait_for_changes(std::chrono::milliseconds{100});
  }

  double round_trip() {
    std::vector<double> costs;
    for (std::size_t i = 0; i < 100; ++i) {
      const auto begin = Clock::now();
      const Address address{binding(), new_id()};
      add(address, BinderStatus{});
      read<BinderStatus>(address);
      costs.push_back(milliseconds(Clock::now() - begin));
    }
    std::sort(costs.begin(), costs.end());
    return costs[costs.size() / 2];
  }

  Option<std::uint32_t> proxies_{this, "proxies", 100, "how many there are before one more comes"};
};

CASTOR_COMPONENT(Crowd, "tells binding of many things")

void measure(std::size_t proxies) {
  TestSystem system{"HOST localhost\n"
                    "SUBARCHITECTURE binding\n"
                    "CPP WM SubarchitectureWorkingMemory\n"
                    "CPP TM AlwaysPositiveTaskManager\n"
                    "CPP UM scorer BindingScorer\n"
                    "CPP UM judge BindingJudge\n"
                    "CPP UM binder Binder\n"
                    "SUBARCHITECTURE crowd\n"
                    "CPP WM SubarchitectureWorkingMemory\n"
                    "CPP TM AlwaysPositiveTaskManager\n"
                    "CPP UM crowd Crowd --proxies " +
                    std::to_string(proxies) + "\nACCESS crowd WRITES binding\n"};
  system.expect_end(0, "measured", std::chrono::minutes{5});
}

} // namespace

} // namespace castor::binding

int main(int argc, char** argv) {
  using namespace castor::binding;
  const auto most = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 3000;
  fmt::print("ms: of one more, as a median, its ratio to writing and reading one "
             "entry, and the highest\n{:>8} {:>17} {:>9}\n",
             "proxies", "one more", "highest");
  for (const std::size_t proxies : {10, 100, 1000}) {
    if (proxies <= most)
      measure(proxies);
  }
}
