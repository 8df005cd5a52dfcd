// What durable writes cost.
#include "castor/benchmarks/journal_rates.hpp"
#include "castor/benchmarks/performance/castor_measurements.hpp"

namespace castor::benchmark {

void measure_durable_writes(const Arguments& x) {
  print_figure("rate", journal_rate({x.duration(), x.text("folder")}, JournalMode::full,
                                    x.count("bytes"), static_cast<int>(x.count("clients")),
                                    static_cast<int>(x.count("in_flight"))));
}

} // namespace castor::benchmark
