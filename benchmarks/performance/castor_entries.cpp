// What a working memory with many entries costs.
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/process_cost.hpp"

#include <unistd.h>

#include <functional>
#include <string>

namespace castor::benchmark {

namespace {

const Arguments* task = nullptr;

class Hoarder final : public UnmanagedComponent {
  void run() override {
    auto count = task->count("entries");
    auto memory_before = memory_bytes(getpid());
    auto memory_of_entry = [&] {
      return (memory_bytes(getpid()) - memory_before) / static_cast<double>(count);
    };
    measure("add", count, [&](std::size_t i) { add(address(i), payload_of(100)); });
    print_figure("bytes", memory_of_entry());
    measure("read", count, [&](std::size_t i) { read<Payload>(address(i)); });
    measure("delete", count, [&](std::size_t i) { delete_entry(address(i)); });
    // What the system gets back, it gets when few entries have been deleted between two looks of the
    // keeper, which are up to two seconds apart.
    sleep_for(std::chrono::seconds{6});
    print_figure("left", memory_of_entry());
    end_system(0, "done");
  }

  Address address(std::size_t i) const { return here(std::to_string(i)); }

  static void measure(const char* figure, std::size_t count,
                      const std::function<void(std::size_t)>& operation) {
    auto begin = Clock::now();
    for (std::size_t i = 0; i < count; ++i)
      operation(i);
    auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    print_figure(figure, static_cast<double>(count) / seconds);
  }
};
CASTOR_COMPONENT(Hoarder, "adds many entries")

} // namespace

void measure_entries(const Arguments& x) {
  task = &x;
  run_system(subarchitecture_text("a") + "CPP UM hoarder Hoarder --deadline 1h --budget 1h\n");
}

} // namespace castor::benchmark
