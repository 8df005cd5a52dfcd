// Components that end their process, from different places in different ways.
#include "castor/tests/tools/cli/follow_null.hpp"
#include "castor/tests/tools/cli/tick.hpp"

#include "castor/actors/component/registry.hpp"

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>

namespace castor::test {

namespace {

void follow_dangling() {
  volatile auto address = std::uintptr_t{0x123456789000};
  *reinterpret_cast<volatile int*>(address) = 1;
}

/// Without end, which the compiler must not see.
volatile int deepest = -1;

int recurse(int depth) {
  if (depth == deepest)
    return 0;
  volatile char frame[256] = {};
  frame[0] = static_cast<char>(depth);
  return recurse(depth + 1) + frame[0];
}

void divide_by_zero() {
  volatile int zero = 0;
  volatile int some = 17;
  volatile int result = some / zero;
  static_cast<void>(result);
}

[[noreturn]] void throw_something() {
  throw std::runtime_error("nobody catches this");
}

void throw_without_catch() noexcept {
  throw_something();
}

/// Crashes.
class Crasher final : public ManagedComponent {
  void configure() override { crash_in("configure"); }

  void start() override {
    on_change(added<Tick>(), [this](const ChangeEvent&) { crash_in("callback"); });
    crash_in("start");
  }

  void run() override {
    crash_in("run");
    if (place_.get() == "thread")
      std::thread{[this] { ways().at(how_)(); }}.join();
    if (place_.get() == "callback")
      add(here("tick"), Tick{1});
  }

  void crash_in(const std::string& place) {
    if (place_.get() == place)
      ways().at(how_)();
  }

  static const std::map<std::string, std::function<void()>>& ways() {
    static const std::map<std::string, std::function<void()>> result{
      {"null", follow_null},
      {"dangling", follow_dangling},
      {"overflow", [] { recurse(0); }},
      {"abort", [] { std::abort(); }},
      {"divide", divide_by_zero},
      {"terminate", throw_without_catch},
    };
    return result;
  }

  Option<std::string> place_{this, "place", "run", "configure, start, run, callback or thread"};
  Option<std::string> how_{this, "how", "null",
                           "null, dangling, overflow, abort, divide or terminate"};
};
CASTOR_COMPONENT(Crasher, "ends its process")

/// Does not let itself be configured.
class Misconfigured final : public UnmanagedComponent {
  void configure() override { throw std::runtime_error(message_.get()); }

  Option<std::string> message_{this, "message", "there is no such thing", "why"};
};
CASTOR_COMPONENT(Misconfigured, "cannot be configured")

/// Says what it goes through.
class Talker final : public UnmanagedComponent {
  void configure() override { info("is configured"); }
  void start() override { info("is started"); }
  void run() override { info("runs"); }
  void stop() override { info("is stopped"); }
};
CASTOR_COMPONENT(Talker, "says what it goes through")

} // namespace

} // namespace castor::test
