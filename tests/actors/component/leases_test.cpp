#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

const Address x{"a", "x"};
const Address y{"b", "y"};

class Locks : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  /// Two subarchitectures, that may write to each other, with these components.
  static ArchitectureDescription with(const std::vector<std::string>& of_a,
                                      const std::vector<std::string>& of_b = {},
                                      const std::string& wm_options = "") {
    std::string text = "ACCESS a WRITES b\nACCESS b WRITES a\n";
    for (auto* list : {&of_a, &of_b}) {
      text += std::string{"SUBARCHITECTURE "} + (list == &of_a ? "a" : "b") +
              " localhost\nCPP WM SubarchitectureWorkingMemory " + wm_options +
              "\nCPP TM AlwaysPositiveTaskManager\n";
      for (auto& line : *list) {
        auto name = line.substr(0, line.find(' '));
        text += "CPP MG " + name + " Managed" + line.substr(name.size()) + "\n";
      }
    }
    return architecture(text);
  }

  static std::string message_of(const std::function<void()>& f) {
    try {
      f();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "nothing was thrown";
  }
};

TEST_F(Locks, KeepAComponentsReadAndWriteTogether) {
  constexpr int rounds = 200;
  std::atomic<int> done{0};
  script("first").start = [](auto& self) { self.add(x, Note{}); };
  std::vector<std::string> names{"first"};
  for (int i = 0; i < 4; ++i) {
    names.push_back("w" + std::to_string(i));
    script(names.back()).run = [&](auto& self) {
      for (int n = 0; n < rounds; ++n) {
        auto guard = self.lock(x, LockLevel::odr);
        auto note = *self.template read<Note>(x);
        ++note.number;
        self.overwrite(x, note);
      }
      if (++done == 4)
        self.end_system(static_cast<int>(self.template read<Note>(x)->number), "counted");
    };
  }
  System system{with({names[0], names[1], names[2]}, {names[3], names[4]})};
  EXPECT_EQ(run(system), 4 * rounds);
}

TEST_F(Locks, AGuardGivesTheLeaseBack) {
  script("m").run = [](auto& self) {
    self.add(x, Note{});
    {
      auto guard = self.lock(x, LockLevel::o);
      EXPECT_TRUE(guard.held());
      EXPECT_TRUE(self.is_overwritable(x)) << "by the holder itself";
    }
    auto again = self.try_lock(x, LockLevel::o);
    ASSERT_TRUE(again);
    again->unlock();
    EXPECT_FALSE(again->held());
    self.unlock_entry(x); // not locked: nothing happens
    self.end_system(0, "done");
  };
  System system{with({"m"})};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, AreReEntrant) {
  std::atomic<int> step{0};
  script("m").run = [&](auto& self) {
    self.add(x, Note{});
    self.lock_entry(x, LockLevel::o);
    self.lock_entry(x, LockLevel::odr);
    self.unlock_entry(x);
    step = 1;
    while (step < 2)
      ASSERT_TRUE(self.sleep_for(1ms));
    self.overwrite(x, Note{7});
    self.unlock_entry(x);
    step = 3;
  };
  script("other").run = [&](auto& self) {
    while (step < 1)
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_FALSE(self.try_lock(x, LockLevel::o)) << "one unlock is not enough for two locks";
    EXPECT_FALSE(self.is_overwritable(x));
    EXPECT_TRUE(self.is_deletable(x));
    EXPECT_TRUE(self.is_readable(x));
    step = 2;
    while (step < 3)
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_TRUE(self.try_lock(x, LockLevel::o));
    self.end_system(0, "done");
  };
  System system{with({"m"}, {"other"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Locks, AreRenewedWhileTheHolderComputes) {
  script("m").run = [](auto& self) {
    self.add(x, Note{});
    auto guard = self.lock(x, LockLevel::o);
    std::this_thread::sleep_for(1500ms); // three leases long, and within the budget
    self.overwrite(x, Note{1});
    EXPECT_TRUE(guard.held());
    self.end_system(0, "done");
  };
  System system{with({"m"}, {}, "--lease 500ms")};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, AHolderThatHangsLosesItsLease) {
  std::atomic<bool> locked{false}, taken{false};
  script("hanging").run = [&](auto& self) {
    self.add(x, Note{});
    auto guard = self.lock(x, LockLevel::o);
    locked = true;
    while (!taken)
      std::this_thread::sleep_for(1ms);
    EXPECT_THAT(message_of([&] { self.overwrite(x, Note{1}); }),
                AllOf(HasSubstr("the lease it locked it with has ended"),
                      HasSubstr("waiting of b holds a lease of level O")));
    EXPECT_THROW(self.overwrite(x, Note{1}), LeaseLostException);
    EXPECT_THROW(guard.unlock(), LeaseLostException);
    self.end_system(0, "done");
  };
  script("waiting").run = [&](auto& self) {
    while (!locked)
      ASSERT_TRUE(self.sleep_for(1ms));
    auto guard = self.lock(x, LockLevel::o);
    taken = true;
    self.sleep_for(1h);
  };
  System system{with({"hanging --budget 300ms"}, {"waiting"}, "--lease 500ms")};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, EndWithTheirHolder) {
  script("doomed").run = [](auto& self) {
    self.add(x, Note{});
    self.lock_entry(x, LockLevel::odr);
    throw std::runtime_error("doomed");
  };
  script("heir").run = [](auto& self) {
    while (!self.exists(x))
      ASSERT_TRUE(self.sleep_for(1ms));
    EXPECT_EQ(self.template read<Note>(x)->number, 0);
    auto guard = self.lock(x, LockLevel::odr);
    self.end_system(0, "done");
  };
  System system{with({"doomed --restart temporary"}, {"heir"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Locks, AreFreeAgainWhenTheOneWhoWaitedIsStopped) {
  std::atomic<bool> locked{false}, waiting{false};
  script("holder").run = [&](auto& self) {
    self.add(x, Note{});
    auto guard = self.lock(x, LockLevel::odr);
    locked = true;
    while (!waiting)
      ASSERT_TRUE(self.sleep_for(1ms));
    self.end_system(0, "done");
    self.sleep_for(1h);
  };
  bool reached = false;
  script("waiter").run = [&](auto& self) {
    while (!locked)
      ASSERT_TRUE(self.sleep_for(1ms));
    waiting = true;
    auto guard = self.lock(x, LockLevel::o);
    reached = true;
  };
  System system{with({"holder"}, {"waiter"})};
  auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run(system), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
  EXPECT_FALSE(reached);
}

TEST_F(Locks, AWaitHasADeadline) {
  script("holder").start = [](auto& self) {
    self.add(x, Note{});
    self.lock_entry(x, LockLevel::odr);
  };
  script("waiter").run = [](auto& self) {
    auto begin = std::chrono::steady_clock::now();
    EXPECT_THROW(self.lock_entry(x, LockLevel::o, 100ms), DeadlineException);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
    self.end_system(0, "done");
  };
  System system{with({"holder"}, {"waiter"})};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Locks, ACycleOfWaitsIsBrokenAndShown) {
  std::atomic<int> locked{0}, victims{0};
  std::string cycle;
  auto cross = [&](const Address& own, const Address& other) {
    return [&, own, other](auto& self) {
      auto guard = self.lock(own, LockLevel::o);
      ++locked;
      while (locked < 2)
        ASSERT_TRUE(self.sleep_for(1ms));
      auto begin = std::chrono::steady_clock::now();
      try {
        auto second = self.lock(other, LockLevel::o);
      } catch (const DeadlockException& e) {
        ++victims;
        cycle = e.what();
        EXPECT_LT(std::chrono::steady_clock::now() - begin, 1s);
      }
      guard.unlock();
      if (--locked == 0)
        self.end_system(victims, "done");
    };
  };
  script("ann").start = [](auto& self) { self.add(x, Note{}); };
  script("bob").start = [](auto& self) { self.add(y, Note{}); };
  script("ann").run = cross(x, y);
  script("bob").run = cross(y, x);
  System system{with({"ann"}, {"bob"})};
  EXPECT_EQ(run(system), 1) << "one of the two gives way";
  EXPECT_THAT(cycle, AllOf(HasSubstr("ann of a waits to lock b/y, leased by bob of b"),
                           HasSubstr("bob of b waits to lock a/x, leased by ann of a")));
}

TEST_F(Locks, ReadsTakePartInCycles) {
  std::atomic<int> locked{0}, victims{0}, over{0};
  auto cross = [&](const Address& own, const Address& other) {
    return [&, own, other](auto& self) {
      auto guard = self.lock(own, LockLevel::odr);
      ++locked;
      while (locked < 3)
        ASSERT_TRUE(self.sleep_for(1ms));
      try {
        self.template read_all_in<Note>(other.subarchitecture);
      } catch (const DeadlockException&) {
        ++victims;
      }
      guard.unlock();
      if (++over == 3)
        self.end_system(victims, "done");
    };
  };
  const Address third{"b", "z"};
  script("ann").start = [](auto& self) { self.add(x, Note{}); };
  script("bob").start = [](auto& self) { self.add(y, Note{}); };
  script("ann").run = cross(x, y);
  script("bob").run = cross(y, x);
  script("cid").run = [&](auto& self) {
    // Waits too, but for nobody's sake.
    ++locked;
    self.template read<Note>(x);
    if (++over == 3)
      self.end_system(victims, "done");
  };
  System system{with({"ann", "cid"}, {"bob"})};
  EXPECT_EQ(run(system), 1);
}

TEST_F(Locks, LongWaitsThatAreNoCycleGoOn) {
  script("slow").start = [](auto& self) { self.add(x, Note{}); };
  script("slow").run = [](auto& self) {
    auto guard = self.lock(x, LockLevel::odr);
    self.sleep_for(1200ms);
  };
  script("patient").run = [](auto& self) {
    self.sleep_for(50ms);
    self.add(y, Note{});
    auto own = self.lock(y, LockLevel::odr);
    self.template read<Note>(x);
    self.end_system(0, "done");
  };
  script("third").run = [](auto& self) {
    while (!self.exists(y))
      ASSERT_TRUE(self.sleep_for(1ms));
    self.template read<Note>(y);
  };
  System system{with({"slow", "third"}, {"patient"})};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, SeveralWritesAreOne) {
  script("m").run = [](auto& self) {
    std::vector<std::string> told;
    self.on_change(changed<Note>(), [&](const ChangeEvent& e) {
      told.push_back(e.address.id);
      EXPECT_EQ(self.template read_all<Note>().size(), 2u) << "never one without the other";
    });
    auto first = self.here("1"), second = self.here("2");
    self.write(WriteBatch{}.add(first, Note{1}).add(second, Note{2}));
    EXPECT_EQ(self.write(WriteBatch{}.overwrite(first, Note{3}).overwrite(second, Note{4})),
              (std::vector<Version>{1, 1}));
    EXPECT_THROW(self.write(WriteBatch{}.overwrite(first, Note{5}).add(second, Note{6})),
                 AlreadyExistsOnWM);
    EXPECT_EQ(self.template read<Note>(first)->number, 3);
    EXPECT_THROW(
      self.write(WriteBatch{}.add(self.here("3"), Note{}).add(Address{"b", "4"}, Note{})),
      NotAtomicException);
    while (told.size() < 4)
      ASSERT_TRUE(self.wait_for_changes(5s));
    self.end_system(0, "done");
  };
  System system{with({"m"})};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, EntriesMayEndOfThemselves) {
  script("m").run = [](auto& self) {
    std::string source;
    self.on_change(deleted<Note>(), [&](const ChangeEvent& e) { source = e.source; });
    self.add(Note{}, EntryLife{.time_to_live = 50ms});
    while (source.empty())
      ASSERT_TRUE(self.wait_for_changes(5s));
    EXPECT_EQ(source, expiry_source);
    self.end_system(0, "done");
  };
  System system{with({"m"})};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

TEST_F(Locks, BadInputIsNamedAndHarmsNobody) {
  script("m").run = [](auto& self) {
    EXPECT_THROW(self.add(self.here(""), Note{}), BadAddressException);
    EXPECT_THROW(self.add(Address{"", "1"}, Note{}), BadAddressException);
    EXPECT_THROW(self.add(Address{"nowhere", "1"}, Note{}), UnknownSubarchitectureException);
    EXPECT_THROW(self.on_change(any_change().in("nowhere"), [](auto&) {}),
                 UnknownSubarchitectureException);
    EXPECT_THROW(self.lock_entry(Address{"nowhere", "1"}, LockLevel::o),
                 UnknownSubarchitectureException);
    EXPECT_THROW(self.lock_entry(self.here("none"), LockLevel::o), DoesNotExistOnWM);
    EXPECT_THROW(self.is_readable(self.here("none")), DoesNotExistOnWM);
    EXPECT_THAT(message_of([&] {
                  self.add(self.here("big"), Note{0, std::string(2 << 20, 'x')});
                }),
                AllOf(HasSubstr("m of a cannot add a/big"), HasSubstr("takes at most 1048576"),
                      HasSubstr("--largest-entry")));
    self.add(self.here("1"), Note{});
    EXPECT_THROW(self.template read<Other>(self.here("1")), TypeMismatchException);
    EXPECT_THROW(self.follow(EntryPointer<Note>{}), BadAddressException);
    EXPECT_EQ(self.follow(EntryPointer<Note>{self.here("1")})->number, 0);
    EXPECT_THROW(self.follow(AnyEntryPointer{EntryPointer<Note>{self.here("1")}}.as<Other>()),
                 TypeMismatchException);
    EXPECT_THROW(self.template read_where<Note>("colour == 1"), PredicateException);
    EXPECT_THROW(self.template read_where<Note>("number =="), PredicateException);
    EXPECT_EQ(self.template read_all<Note>().size(), 1u);
    self.end_system(0, "done");
  };
  System system{with({"m"}, {}, "--largest-entry 1")};
  EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
}

} // namespace

} // namespace castor::test
