// What operations on the working memory of another process cost.
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/far_node.hpp"
#include "castor/benchmarks/performance/pipeline.hpp"

#include <fmt/core.h>

#include <barrier>
#include <latch>
#include <memory>
#include <utility>

namespace castor::benchmark {

namespace {

class FarWriter final : public MeasuringComponent {
  void run() override {
    const Address address{"far", "x"};
    add(address, Payload{});
    auto in_flight = arguments().count("in_flight");
    measure(
      "rate", batch_of(arguments().count("bytes")), [&] { prepare_payloads(); },
      [&] {
        pipelined(
          payloads_, in_flight, [&](Payload& x) { return overwrite_async(address, std::move(x)); },
          [](Pending<Version>& x) { x.get(); });
      });
    end_system(0, "done");
  }
};
CASTOR_COMPONENT(FarWriter, "measures overwrites of an entry in another process")

/// Meeting of the readers of one entry.
struct Round {
  explicit Round(int readers) : gate(readers) {}

  /// Opens when the bytes so far have been counted.
  std::latch begin{1};
  std::barrier<> gate;
  bool goes_on = true;
  std::size_t count = 0;
  double seconds = 0;
};

const Arguments* task = nullptr;
std::unique_ptr<Round> round;

/// The first of them overwrites the entry, then all read it.
class FarReader final : public UnmanagedComponent {
  void run() override {
    const Address address{"far", "x"};
    auto is_first = index_.get() == 0;
    auto bytes = task->count("bytes");
    if (is_first)
      add(address, Payload{});
    round->begin.wait();
    auto begin = Clock::now();
    while (round->goes_on) {
      if (is_first)
        overwrite(address, payload_of(bytes));
      round->gate.arrive_and_wait();
      auto before = Clock::now();
      read<Payload>(address);
      round->gate.arrive_and_wait();
      if (!is_first) {
        round->gate.arrive_and_wait();
        continue;
      }
      round->seconds += std::chrono::duration<double>(Clock::now() - before).count();
      ++round->count;
      round->goes_on = Clock::now() - begin < task->duration();
      round->gate.arrive_and_wait();
    }
    if (is_first)
      end_system(0, "done");
  }

  Option<std::int64_t> index_{this, "index", 0, "which of the readers this is"};
};
CASTOR_COMPONENT(FarReader, "reads an entry in another process")

std::uint64_t bytes_received(System& system) {
  std::uint64_t result = 0;
  // Those of this process, which is the first.
  for (auto& link : system.summary().processes.front().links)
    result += link.bytes_in;
  return result;
}

} // namespace

void measure_link_writes(const Arguments& x) {
  FarNode far;
  MeasuringComponent::run_components(x, "FarWriter", 1, subarchitecture_text("far", "far"),
                                     far.options());
}

void measure_link_readers(const Arguments& x) {
  FarNode far;
  auto readers = static_cast<int>(x.count("readers"));
  task = &x;
  round = std::make_unique<Round>(readers);
  auto text = subarchitecture_text("far", "far") + subarchitecture_text("near");
  for (int i = 0; i < readers; ++i)
    text += fmt::format("CPP UM reader{} FarReader --index {} --deadline 1h\n", i, i);
  run_system(text, far.options(), [&](System& system) {
    auto before = bytes_received(system);
    round->begin.count_down();
    system.wait({});
    auto received = static_cast<double>(bytes_received(system) - before);
    print_figure("bytes", received / static_cast<double>(round->count) / readers);
    print_figure("rate", static_cast<double>(round->count) * readers / round->seconds);
  });
}

} // namespace castor::benchmark
