// What operations on a working memory in the same process cost.
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/pipeline.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t batch = 5000;
/// Operations between two looks at the clock.
constexpr std::size_t chunk = 500;

void nothing() {
  // nop
}

class Reader final : public MeasuringComponent {
  void start() override {
    for (int i = 0; i < 100; ++i) {
      addresses_.push_back(here("e" + std::to_string(i)));
      if (is_first())
        add(addresses_.back(), payload_of(arguments().count("bytes")));
    }
  }

  void run() override {
    measure_freely("rate", chunk, [&] {
      for (std::size_t i = 0; i < chunk; ++i)
        read<Payload>(addresses_[i % addresses_.size()]);
    });
    if (is_first())
      end_system(0, "done");
  }

  std::vector<Address> addresses_;
};
CASTOR_COMPONENT(Reader, "measures reads")

class Writer final : public MeasuringComponent {
  void run() override {
    auto address = here("w" + std::to_string(index()));
    add(address, Payload{});
    auto bytes = arguments().count("bytes");
    auto in_flight = arguments().count("in_flight");
    auto one_at_a_time = [&] {
      for (std::size_t i = 0; i < chunk; ++i)
        overwrite(address, payload_of(bytes));
    };
    auto many_in_flight = [&] {
      payloads_.assign(chunk, payload_of(bytes));
      pipelined(
        payloads_, in_flight, [&](Payload& x) { return overwrite_async(address, std::move(x)); },
        [](Pending<Version>& x) { x.get(); });
    };
    measure_freely("rate", chunk,
                   in_flight == 1 ? std::function<void()>{one_at_a_time} : many_in_flight);
    if (is_first())
      end_system(0, "done");
  }
};
CASTOR_COMPONENT(Writer, "measures overwrites")

class Operator final : public MeasuringComponent {
  void run() override {
    auto address = here("o");
    add(address, payload_of(arguments().count("bytes")));
    measure("read", batch, nothing, [&] {
      for (std::size_t i = 0; i < batch; ++i)
        read<Payload>(address);
    });
    measure(
      "overwrite", batch, [&] { prepare_payloads(); },
      [&] {
        for (auto& x : payloads_)
          overwrite(address, std::move(x));
      });
    measure(
      "add", batch,
      [&] {
        delete_added();
        prepare_payloads();
        prepare_addresses();
      },
      [&] { add_all(); });
    measure(
      "delete", batch,
      [&] {
        delete_added();
        prepare_payloads();
        prepare_addresses();
        add_all();
      },
      [&] { delete_added(); });
    measure("lock", batch, nothing, [&] {
      for (std::size_t i = 0; i < batch; ++i)
        lock(address, LockLevel::odr).unlock();
    });
    end_system(0, "done");
  }

  void prepare_addresses() {
    for (std::size_t i = 0; i < batch; ++i)
      addresses_.push_back(here("a" + std::to_string(made_++)));
  }

  void add_all() {
    for (std::size_t i = 0; i < batch; ++i)
      add(addresses_[i], std::move(payloads_[i]));
  }

  void delete_added() {
    for (auto& x : addresses_)
      delete_entry(x);
    addresses_.clear();
  }

  std::vector<Address> addresses_;
  std::size_t made_ = 0;
};
CASTOR_COMPONENT(Operator, "measures operations")

class Locker final : public MeasuringComponent {
  void start() override {
    if (is_first())
      add(here("contended"), Payload{});
  }

  void run() override {
    measure_freely("rate", chunk, [&] {
      for (std::size_t i = 0; i < chunk; ++i)
        lock(here("contended"), LockLevel::odr, 1h).unlock();
    });
    if (is_first())
      end_system(0, "done");
  }
};
CASTOR_COMPONENT(Locker, "measures locks of one entry")

int components_of(const Arguments& x) {
  return static_cast<int>(x.count("components"));
}

} // namespace

void measure_readers(const Arguments& x) {
  MeasuringComponent::run_components(x, "Reader", components_of(x));
}

void measure_writers(const Arguments& x) {
  MeasuringComponent::run_components(x, "Writer", components_of(x));
}

void measure_operations(const Arguments& x) {
  MeasuringComponent::run_components(x, "Operator", 1);
}

void measure_contended_lock(const Arguments& x) {
  MeasuringComponent::run_components(x, "Locker", components_of(x));
}

} // namespace castor::benchmark
