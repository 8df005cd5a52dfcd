// What SQLite costs; one measurement of scripts/bench at a time.
#include "castor/benchmarks/journal_rates.hpp"
#include "castor/benchmarks/performance/measurement.hpp"

namespace castor::benchmark {

namespace {

/// Rows that are written to `folder` in synced transactions of as many as `clients` have
/// `in_flight` together: figure `rate`.
void measure_durable_writes(const Arguments& x) {
  print_figure("rate", sqlite_rate({x.duration(), x.text("folder")}, x.count("bytes"),
                                   x.count("clients") * x.count("in_flight")));
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  return run_measurement(argc, argv, {{"durable_writes", measure_durable_writes}});
}
