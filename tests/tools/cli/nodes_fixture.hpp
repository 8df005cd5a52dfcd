#pragma once

#include "castor/tests/support/eventually.hpp"
#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <regex>
#include <string>
#include <vector>

namespace castor::test {

/// Systems over several processes: nodes, and `castor run`.
class Nodes : public Castor {
protected:
  struct Node {
    std::string name;
    std::unique_ptr<Process> process;
    std::string address;

    std::uint16_t port() const {
      return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
    }
  };

  /// From now on all that is started is encrypted; certificates are made for these nodes.
  void encrypt(const std::vector<std::string>& nodes) {
    std::vector<std::string> arguments{CASTOR_MAKE_CERTS, (folder / "certs").string(), "run"};
    arguments.insert(arguments.end(), nodes.begin(), nodes.end());
    Process certs{std::move(arguments)};
    ASSERT_EQ(certs.wait(), 0) << certs.errors();
    encrypted_ = true;
  }

  /// Starts a node and waits until it listens.
  Node start_node(const std::string& name, const std::vector<std::string>& more = {}) const {
    return start_node(name, command({"node"}), more);
  }

  /// The same, of another executable or with other plug-ins.
  Node start_node(const std::string& name, std::vector<std::string> arguments,
                  const std::vector<std::string>& more) const {
    append(arguments, {"--name", name, "--listen", "127.0.0.1:0"});
    append(arguments, tls(name));
    append(arguments, more);
    Node result{name, std::make_unique<Process>(std::move(arguments)), {}};
    EXPECT_TRUE(result.process->wait_for_output("listens at ")) << result.process->errors();
    EXPECT_TRUE(eventually([&] {
      std::smatch found;
      auto output = result.process->output();
      if (!std::regex_search(output, found, std::regex{"listens at (.*)\n"}))
        return false;
      result.address = found[1];
      return true;
    }));
    return result;
  }

  /// `castor run` of a system whose hosts are these nodes. It ends after a while even if the system
  /// does not do what the test waits for.
  std::vector<std::string> run_on(const std::vector<const Node*>& nodes, const std::string& system,
                                  const std::vector<std::string>& more = {}) {
    std::string text;
    auto file = "system-" + std::to_string(++systems_) + ".cast";
    std::vector<std::string> arguments{"run", (folder / file).string()};
    for (auto* x : nodes) {
      text += "HOSTNAME " + x->name + ' ' + x->name + ".test\n";
      append(arguments, {"--node", x->name + ".test=" + x->address});
    }
    write(file, text + system);
    append(arguments, tls("run"));
    if (std::find(more.begin(), more.end(), "--for") == more.end())
      append(arguments, {"--for", "100s"});
    append(arguments, more);
    // What a component finds out by failing is not to be lost with it.
    arguments.push_back("--no-restarts");
    return command(arguments);
  }

  /// A subarchitecture on a node, or on `localhost`, to be followed by its components.
  static std::string subarchitecture(const std::string& name, const std::string& host,
                                     const std::string& working_memory_options = {}) {
    return "SUBARCHITECTURE " + name + " [" + host +
           "]\n"
           "CPP WM SubarchitectureWorkingMemory " +
           working_memory_options +
           "\n"
           "CPP TM AlwaysPositiveTaskManager\n";
  }

  /// A ticker in a subarchitecture on the node `one`, and somebody on the node `two` who hears of
  /// so many ticks.
  static std::string ticks(int count) {
    return subarchitecture("a", "one") + "CPP UM ticker Ticker --deadline 1s\n" +
           subarchitecture("b", "two") + "CPP UM listener Listener --count " +
           std::to_string(count) + "\n";
  }

private:
  static void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  std::vector<std::string> tls(const std::string& name) const {
    if (!encrypted_)
      return {};
    return {"--tls", (folder / "certs" / name).string()};
  }

  bool encrypted_ = false;
  int systems_ = 0;
};

/// The same with and without encryption: NodesEitherWay.X/plain and NodesEitherWay.X/encrypted.
class NodesEitherWay : public Nodes, public testing::WithParamInterface<bool> {
protected:
  void SetUp() override {
    Nodes::SetUp();
    if (GetParam())
      encrypt({"one", "two", "three", "four"});
  }
};

inline std::string encryption(const testing::TestParamInfo<bool>& x) {
  return x.param ? "encrypted" : "plain";
}

} // namespace castor::test
