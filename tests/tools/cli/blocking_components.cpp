// Components that do not give their thread or their process back.
#include "castor/tests/tools/cli/tick.hpp"

#include "castor/actors/component/registry.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

void wait_for_ever() {
  for (;;)
    pause();
}

void close_all_descriptors() {
  for (int i = 0; i < 1024; ++i)
    close(i);
}

/// A process that is no child of this one, and in a session of its own.
void start_daemon(const char* seconds) {
  if (fork() != 0)
    return;
  setsid();
  if (fork() == 0)
    execlp("sleep", "sleep", seconds, nullptr);
  _exit(0);
}

/// Does something unkind in one phase of its life.
class Blocker final : public UnmanagedComponent {
public:
  Blocker() = default;
  ~Blocker() override { reach("destructor"); }

private:
  void configure() override { reach("configure"); }
  void start() override { reach("start"); }

  void run() override {
    info("runs");
    reach("run");
    if (sleep_for(300ms))
      reach("late");
  }

  void stop() override { reach("stop"); }

  void reach(const std::string& phase) {
    if (phase != phase_.get())
      return;
    const std::map<std::string, std::function<void()>> ways{
      {"wait", wait_for_ever},
      {"stop", [] { std::raise(SIGSTOP); }},
      {"close", close_all_descriptors},
      {"exit", [] { std::exit(0); }},
      {"quick_exit", [] { std::quick_exit(0); }},
      {"_exit", [] { ::_exit(0); }},
      {"throw", [] { throw std::runtime_error("on purpose"); }},
      {"daemon", [this] { start_daemon(seconds_->c_str()); }},
    };
    ways.at(how_)();
  }

  Option<std::string> phase_{this, "phase", "run",
                             "configure, start, run, late, stop or destructor"};
  Option<std::string> how_{this, "how", "wait", "what it does then"};
  Option<std::string> seconds_{this, "seconds", "1000", "how long a daemon lives"};
};
CASTOR_COMPONENT(Blocker, "does not give its thread or its process back")

class Provider final : public StandaloneComponent {
  void start() override {
    provide<Tick>([] { return Tick{1}; });
    info("provides");
  }
};
CASTOR_COMPONENT(Provider, "provides ticks")

class Puller final : public UnmanagedComponent {
  void run() override {
    for (int i = 0; i < count_; ++i) {
      pull<Tick>(from_);
      sleep_for(10ms);
    }
    end_system(0, "has pulled enough");
  }

  Option<std::string> from_{this, "from", "provider", "the stand-alone component that it asks"};
  Option<int> count_{this, "count", 100, "how often"};
};
CASTOR_COMPONENT(Puller, "pulls ticks, and fails if it does not get one")

} // namespace

} // namespace castor::test
