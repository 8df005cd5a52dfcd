// What it costs to bind one more proxy, by how many there are: what is seen, half of it described
// by somebody, with a relation for every tenth thing. As a yardstick: one comparison of two
// features' words for every proxy.
//
//   binding_benchmark [MOST_PROXIES]
//
// Then the same through working memory: from a monitor's writing of a proxy to its being bound, by
// the scorer, the judge and the binder of configs/playmate.cast. As a yardstick: writing an entry
// there and reading it back.
#include "castor/actors/component/registry.hpp"
#include "castor/binding/binding_core.hpp"
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

/// Keeps results from being optimised away.
volatile std::size_t sink = 0;

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

BindingProxy related(std::size_t i) {
  BindingProxy result;
  result.type = ProxyType::relation;
  result.source = "spatial";
  result.features = {feature(relation_label, word("relation", i / 10, 5)), not_from("spatial")};
  result.out_ports = {{"from", "seen " + std::to_string(i), {}},
                      {"to", "seen " + std::to_string(i / 2), {}}};
  return result;
}

void fill(BindingCore& core, std::size_t proxies) {
  for (std::size_t i = 0; core.size() < proxies; ++i) {
    core.set("seen " + std::to_string(i), seen(i));
    if (i % 2 == 0)
      core.set("described " + std::to_string(i), described(i));
    if (i % 10 == 9)
      core.set("related " + std::to_string(i), related(i));
  }
}

struct Costs {
  double median = 0;
  double highest = 0;
};

/// Of adding proxies one by one and of taking each out again.
template <class Make>
Costs cost(BindingCore& core, const std::string& id, Make&& make) {
  std::vector<double> costs;
  for (std::size_t i = 0; i < 40; ++i) {
    const auto proxy = make(i * 37);
    const auto begin = Clock::now();
    core.set(id, proxy);
    costs.push_back(milliseconds(Clock::now() - begin));
    core.remove(id);
  }
  std::sort(costs.begin(), costs.end());
  return {costs[costs.size() / 2], costs.back()};
}

double yardstick(std::size_t proxies) {
  const FeatureComparator comparator;
  const auto a = feature(colour, "colour 1");
  const auto b = feature(colour, "colour 2");
  double least = 1e9;
  for (int run = 0; run < 10; ++run) {
    const auto begin = Clock::now();
    std::size_t same = 0;
    for (std::size_t i = 0; i < proxies; ++i)
      same += comparator.compare(a, b) == Truth::yes ? 1 : 0;
    sink = same;
    least = std::min(least, milliseconds(Clock::now() - begin));
  }
  return least;
}

void measure(std::size_t proxies) {
  BindingCore core;
  const auto begin = Clock::now();
  fill(core, proxies);
  const double all = milliseconds(Clock::now() - begin);
  const double unit = yardstick(proxies);
  fmt::print("{:>8} {:>8} {:>10.1f}", core.size(), core.unions().size(), all);
  const auto print = [&](const Costs& x) {
    fmt::print(" {:>9.3f} ({:>5.0f}) {:>8.3f}", x.median, x.median / unit, x.highest);
  };
  // The first in binding order, which all others may have to do with; the last; a relation.
  print(cost(core, "a first", [](std::size_t i) { return seen(i); }));
  print(cost(core, "z last", [](std::size_t i) { return described(i); }));
  print(cost(core, "z relation", [](std::size_t i) { return related(i); }));
  fmt::print("\n");
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

void measure_components(std::size_t proxies) {
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
  fmt::print(
    "ms: of adding all of them; of adding one more, as a median, its ratio to comparing as "
    "many pairs of words, and the highest\n");
  fmt::print("{:>8} {:>8} {:>10} {:>26} {:>26} {:>26}\n", "proxies", "unions", "all", "first",
             "last", "relation");
  for (const std::size_t proxies : {10, 30, 100, 300, 1000, 3000}) {
    if (proxies <= most)
      measure(proxies);
  }
  fmt::print(
    "\nms, with components: of one more, as a median, its ratio to writing and reading one "
    "entry, and the highest\n{:>8} {:>17} {:>9}\n",
    "proxies", "one more", "highest");
  for (const std::size_t proxies : {10, 100, 1000}) {
    if (proxies <= most)
      measure_components(proxies);
  }
}
