#pragma once

#include "castor/actors/link/endpoint.hpp"
#include "castor/actors/link/link_parts.hpp"
#include "castor/benchmarks/own_process.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace castor::benchmark {

/// Links that are lost after that much time without a connection.
LinkOptions link_options(std::chrono::milliseconds patience);

/// A process of this program that serves as a node, on 127.0.0.1.
class NodeProcess {
public:
  NodeProcess(std::string name, std::chrono::milliseconds patience);

  const std::string& name() const { return name_; }
  Endpoint endpoint() const { return {"127.0.0.1", port_}; }

  pid_t id() const { return process_->id(); }

  /// Sends a signal; thread-safe.
  void signal(int number) const { process_->signal(number); }
  void kill() const { process_->kill(); }

  /// Where it was, once the former process has ended.
  void start();

private:
  std::string name_;
  std::chrono::milliseconds patience_;
  std::uint16_t port_ = 0;
  std::unique_ptr<OwnProcess> process_;
};

/// Whether this process is one that a NodeProcess has started; then main returns serve_as_node().
bool is_node_process(int argc, char** argv);
int serve_as_node(char** argv);

double milliseconds(std::chrono::steady_clock::duration x);

/// @param x not empty
double percentile(std::vector<double> x, int percent);

} // namespace castor::benchmark
