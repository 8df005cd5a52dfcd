#pragma once

#include "castor/actors/node/system_options.hpp"
#include "castor/benchmarks/node_process.hpp"

#include <chrono>

namespace castor::benchmark {

/// Another process, that a .cast file knows as the host `far`.
class FarNode {
public:
  SystemOptions options() const {
    SystemOptions result;
    result.nodes["far"] = process_.endpoint();
    return result;
  }

private:
  NodeProcess process_{"far", std::chrono::seconds{10}};
};

} // namespace castor::benchmark
