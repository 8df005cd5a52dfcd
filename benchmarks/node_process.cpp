#include "castor/benchmarks/node_process.hpp"

#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/node.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace castor::benchmark {

LinkOptions link_options(std::chrono::milliseconds patience) {
  LinkOptions result;
  result.patience = patience;
  return result;
}

NodeProcess::NodeProcess(std::string name, std::chrono::milliseconds patience)
  : name_(std::move(name)), patience_(patience) {
  start();
}

void NodeProcess::start() {
  process_.reset();
  process_ = std::make_unique<OwnProcess>(std::vector<std::string>{
    "--serve", name_, std::to_string(port_), std::to_string(patience_.count())});
  port_ = static_cast<std::uint16_t>(std::stoi(process_->first_line()));
}

bool is_node_process(int argc, char** argv) {
  return argc == 5 && argv[1] == std::string{"--serve"};
}

int serve_as_node(char** argv) {
  NodeOptions options;
  options.name = argv[2];
  options.socket = listen_at({"127.0.0.1", static_cast<std::uint16_t>(std::stoi(argv[3]))});
  options.link = link_options(std::chrono::milliseconds{std::stoi(argv[4])});
  Node node{options};
  std::printf("%d\n", port_of(options.socket));
  std::fflush(stdout);
  await_end_of_input();
  std::_Exit(0);
}

double milliseconds(std::chrono::steady_clock::duration x) {
  return std::chrono::duration<double, std::milli>(x).count();
}

double percentile(std::vector<double> x, int percent) {
  std::sort(x.begin(), x.end());
  return x[(x.size() - 1) * static_cast<std::size_t>(percent) / 100];
}

} // namespace castor::benchmark
