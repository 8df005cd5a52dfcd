#include "castor/actors/node/node.hpp"
#include "castor/actors/link/credentials.hpp"
#include "castor/actors/link/dial.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/base/log.hpp"
#include "castor/tools/cli/child_processes.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/signals.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;

struct NodeArguments {
  std::string name;
  std::string listen = "127.0.0.1";
  std::string tls;
  bool insecure = false;
  bool end_with_input = false;
  int announce = STDOUT_FILENO;
  std::int64_t memory_limit = 0;
  bool verbose = false;
  bool json = false;
};

/// To people, or to the program that started the node.
void announce(const NodeArguments& arguments, const std::string& name, const Endpoint& at) {
  auto text = arguments.announce == STDOUT_FILENO
                ? fmt::format("node {} listens at {}\n", name, to_string(at))
                : to_string(at) + '\n';
  // Who does not listen does not want to know.
  [[maybe_unused]] auto written = write(arguments.announce, text.data(), text.size());
}

nlohmann::ordered_json to_json(const MembershipNews& x) {
  nlohmann::ordered_json result{{"event", x.takes_part ? "system joined" : "system left"},
                                {"system", x.system}};
  if (x.takes_part)
    result["coordinator"] = x.coordinator;
  else
    result["reason"] = x.reason;
  return result;
}

/// So many MB more than there are now; what asks for more does not get it.
void limit_memory(std::int64_t megabytes) {
  std::ifstream status{"/proc/self/status"};
  std::uint64_t present = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmData:"))
      present = std::stoull(line.substr(7)) * 1024;
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = present + (static_cast<std::uint64_t>(megabytes) << 20);
  setrlimit(RLIMIT_DATA, &limit);
}

/// Whoever has started the node may show progress on the same terminal.
std::shared_ptr<void> erase_progress() {
  constexpr std::string_view erase_line = "\r\x1b[K";
  [[maybe_unused]] auto written = write(STDERR_FILENO, erase_line.data(), erase_line.size());
  return nullptr;
}

int node(NodeArguments arguments) {
  // Components that do not come back from their own code must not keep the process.
  Signals signals{{arguments.end_with_input, 5s}};
  // Whoever has started the node may be gone, and looks after nobody.
  const AtForcedEnd at_forced_end{kill_own_descendants};
  std::optional<JsonOutput> json;
  if (arguments.json)
    json.emplace();
  if (arguments.announce != STDOUT_FILENO && Progress::is_shown_on(STDERR_FILENO))
    guard_log_lines(erase_progress);
  if (arguments.memory_limit > 0)
    limit_memory(arguments.memory_limit);
  if (arguments.verbose)
    set_log_level(LogLevel::debug);
  auto name = arguments.name.empty() ? name_of_machine() : arguments.name;
  auto at = parse_endpoint(arguments.listen, default_node_port);
  if (auto problem = why_unknown(at.host); !problem.empty())
    throw std::invalid_argument("--listen takes HOST:PORT, with an address or a name of this "
                                "machine such as 127.0.0.1:7117; " +
                                arguments.listen + " is none: " + problem);
  NodeOptions options;
  options.name = name;
  if (!arguments.tls.empty())
    options.credentials = Credentials::load(arguments.tls);
  if (options.credentials) {
    auto& names = options.credentials->names();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      fmt::print(stderr,
                 "castor: the certificate in {} is not for the name {}: give the node the name {} "
                 "with --name, or make another certificate with scripts/make-certs\n",
                 arguments.tls, name, fmt::join(names, " or "));
      return bad_input;
    }
  } else if (arguments.insecure && !is_socket_path(at.host)) {
    log_runtime(LogLevel::warning, "INSECURE: whoever reaches " + to_string(at) +
                                     (is_loopback(at.host) ? ", every user of this machine," : "") +
                                     " can run what they like on this machine");
  } else if (!is_loopback(at.host)) {
    fmt::print(stderr,
               "castor: whoever reaches {} could run what they like on this machine: give the "
               "node a certificate with --tls DIR (scripts/make-certs makes some), or say "
               "--insecure\n",
               to_string(at));
    return bad_input;
  }
  options.insecure = arguments.insecure;
  options.socket = listen_at(at);
  if (!is_socket_path(at.host))
    at.port = port_of(options.socket);
  if (json) {
    options.on_system = [&](const MembershipNews& x) { json->print(to_json(x)); };
    // Before any system can come.
    json->print(nlohmann::ordered_json{{"event", "listening"},
                                       {"name", name},
                                       {"address", at.host},
                                       {"port", at.port},
                                       {"pid", getpid()},
                                       {"tls", options.credentials.has_value()}});
  }
  auto result = std::make_unique<Node>(options);
  if (!json)
    announce(arguments, name, at);
  while (signals.count() == 0)
    poll(nullptr, 0, 50);
  result.reset();
  kill_own_descendants();
  return success;
}

} // namespace

void add_node(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
    "node", "offer this process as a node that systems started elsewhere run components in");
  auto arguments = std::make_shared<NodeArguments>();
  command
    ->add_option("--name", arguments->name,
                 "name of the node in .cast files; by default that of the machine")
    ->type_name("NAME");
  command
    ->add_option("--listen", arguments->listen,
                 fmt::format("address to listen on; by default 127.0.0.1:{}, which only this "
                             "machine can reach. Port 0: any free port. unix:PATH: a Unix socket",
                             default_node_port))
    ->type_name("HOST:PORT");
  command
    ->add_option(
      "--tls", arguments->tls,
      "encrypt connections, and accept only peers whose certificates are signed by the same CA: "
      "the folder has ca.pem, node.pem and node.key (scripts/make-certs makes them)")
    ->type_name("DIR");
  command->add_flag("--insecure", arguments->insecure,
                    "without --tls, accept systems of other users, and listen beyond this machine "
                    "if --listen says so");
  command->add_flag("--end-with-input", arguments->end_with_input,
                    "end at the end of standard input, for programs that start nodes");
  auto* announce_option =
    command
      ->add_option("--announce", arguments->announce,
                   "write nothing but the address to this file descriptor once the node is ready")
      ->type_name("FD");
  command
    ->add_option("--memory-limit", arguments->memory_limit,
                 "MB that its components may allocate; allocations beyond that fail")
    ->type_name("MB")
    ->check(CLI::PositiveNumber);
  command
    ->add_flag(
      "--json", arguments->json,
      "print JSON, one object on a line: where the node listens, and the systems that come "
      "and go; what components print goes to standard error")
    ->excludes(announce_option);
  command->add_flag("-v,--verbose", arguments->verbose, "log more");
  command->footer(
    "A system finds the node where its .cast file says HOST NAME and HOSTNAME NAME HOST:PORT.\n"
    "Without --tls the node accepts systems of its own user only.\n"
    "Ctrl-C ends the node; systems with components on it continue without it.\n"
    "Example: castor node --name arm --listen 0.0.0.0:7117 --tls certs/arm");
  on_call(*command, chosen, arguments, node);
}

} // namespace castor::cli
