// What Castor costs; one measurement of scripts/bench at a time.
#include "castor/base/log.hpp"
#include "castor/benchmarks/node_process.hpp"
#include "castor/benchmarks/performance/castor_measurements.hpp"

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  castor::set_log_level(castor::LogLevel::warning);
  if (is_node_process(argc, argv))
    return serve_as_node(argv);
  return run_measurement(argc, argv,
                         {{"readers", measure_readers},
                          {"writers", measure_writers},
                          {"operations", measure_operations},
                          {"contended_lock", measure_contended_lock},
                          {"events", measure_events},
                          {"fan_out", measure_fan_out},
                          {"entries", measure_entries},
                          {"link_writes", measure_link_writes},
                          {"link_events", measure_link_events},
                          {"link_readers", measure_link_readers},
                          {"durable_writes", measure_durable_writes},
                          {"mesh", measure_mesh},
                          {"idle_mesh", measure_idle_mesh},
                          {"idle_components", measure_idle_components}});
}
