#include "cup.hpp"

#include <castor/castor.hpp>

#include <chrono>
#include <exception>
#include <thread>

using namespace std::chrono_literals;
using castor::LockLevel;

/// Goes on after a failure, and says what it was.
class Undeterred : public castor::UnmanagedComponent {
protected:
  template <class F>
  void attempt(F f) {
    try {
      f();
    } catch (const std::exception& e) {
      warning("{}", e.what());
    }
  }
};

/// Locks one entry, then another, which a second one of its kind does in the other order.
class Crossing : public Undeterred {
  castor::Option<std::string> first_{this, "first", "", "the entry that it adds and locks"};
  castor::Option<std::string> second_{this, "second", "", "the entry that it locks then"};
  castor::Option<std::chrono::milliseconds> pause_{this, "pause", 0ms, "time between the locks"};

  void start() override { add(here(first_), Cup{1, "mug"}); }

  void run() override {
    auto first = lock(here(first_), LockLevel::o);
    while (is_overwritable(here(second_)))
      sleep_for(1ms);
    sleep_for(pause_.get());
    attempt([&] { auto second = lock(here(second_), LockLevel::o); });
  }
};
CASTOR_COMPONENT(Crossing, "gets into a deadlock with its like")

class Careless : public Undeterred {
  void run() override {
    auto left = here("left");
    while (is_overwritable(left))
      sleep_for(1ms);
    attempt([&] { overwrite(left, Cup{}); });

    attempt([&] {
      auto guard = lock(left, LockLevel::o);
      overwrite(left, Cup{});
    });

    attempt([&] {
      auto guard = lock(left, LockLevel::o);
      auto cup = *read<Cup>(left);
      std::this_thread::sleep_for(1500ms);
      overwrite(left, cup);
    });

    attempt([&] { read_where<Cup>("colour == \"red\""); });
    attempt([&] { on_change(castor::changed<Cup>().where("distance == \"far\""), [](auto&) {}); });

    read<Cup>(here("middle"));
  }
};
CASTOR_COMPONENT(Careless, "does what one should not")
