#include "castor/tools/testing/test_system.hpp"

#include "castor/tests/actors/component/scripted.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class TestedSystem : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static UnmanagedScript::Script& script(const std::string& name) {
    return UnmanagedScript::scripts()[name];
  }

  /// A component that adds a note when it starts, and another one whenever `poke` is set.
  static void be_a_worker(const std::string& name, std::atomic<int>& poke) {
    script(name).start = [&](auto& self) { self.add(Note{1, "from " + self.component_name()}); };
    script(name).run = [&](auto& self) {
      while (self.sleep_for(1ms))
        if (auto number = poke.exchange(0); number > 0)
          self.add(Note{number, "poked"});
    };
  }

  static std::string workers(const std::string& head = {}) {
    return head + subarchitecture("a") + "CPP UM one Unmanaged\nCPP UM two Unmanaged\n";
  }

  /// What is said when an expectation is not met.
  static std::string complaint(const std::function<void()>& expectation) {
    try {
      expectation();
    } catch (const ExpectationFailed& e) {
      return e.what();
    }
    return "there was nothing to complain about";
  }

  static std::string refusal(const std::function<void()>& f) {
    try {
      f();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "it was not refused";
  }

  static constexpr auto soon = 20ms;
  std::atomic<int> poke{0};
};

TEST_F(TestedSystem, AComponentCrashesAndIsBackAndNobodyElseNotices) {
  be_a_worker("one", poke);
  be_a_worker("two", poke);
  TestSystem system{workers()};
  system.inject("crash one");
  auto up = system.expect_back("one");
  EXPECT_EQ(up.subarchitecture, "a");
  EXPECT_THAT(system.expect_down("one").reason, HasSubstr("injected crash"));
  system.expect_nobody_else_down({"one"});
  system.inject("crash one");
  system.expect_back("one", 3);
  system.expect_entry("Note in a from one where text == \"from one\"");
}

TEST_F(TestedSystem, AFaultIsTriggeredByAChangeThatIsOverAtOnce) {
  be_a_worker("one", poke);
  script("two").start = [](auto& self) { self.delete_entry(self.add(Note{7, "for a moment"})); };
  TestSystemOptions options;
  options.faults = "after added Note in a where number == 7: crash one\n";
  TestSystem system{workers(), options};
  system.expect_back("one");
  system.expect_nobody_else_down({"one"});
}

TEST_F(TestedSystem, FaultsOfOptionsThatNoChangeTriggersAreRefused) {
  TestSystemOptions options;
  options.faults = "\nat 1s crash one";
  EXPECT_THAT(refusal([&] { TestSystem{workers(), options}; }),
              HasSubstr("faults:2: \"at 1s crash one\" is not triggered by a change"));
  options.faults = "after added Note: crash three";
  EXPECT_THAT(refusal([&] { TestSystem{workers(), options}; }), HasSubstr("three"));
}

TEST_F(TestedSystem, ACrashThatComesWhileALeaseIsGivenBackIsOneLikeAnyOther) {
  std::atomic<bool> holds = false;
  std::atomic<bool> go = false;
  script("one").run = [&](auto& self) {
    if (go)
      return;
    auto guard = self.lock(self.add(Note{1, "mine"}), LockLevel::od);
    holds = true;
    while (!go)
      std::this_thread::yield();
  };
  TestSystem system{workers()};
  system.wait_until("one holds a lease", [&] { return holds.load(); });
  system.inject("crash one");
  go = true;
  system.expect_back("one");
}

TEST_F(TestedSystem, InSimulatedTimeAnHourIsOverAtOnce) {
  script("one").run = [](auto& self) {
    for (int hour = 1; self.sleep_for(1h); ++hour)
      self.add(Note{hour, "an hour is over"});
  };
  TestSystemOptions options;
  options.simulated_time = true;
  TestSystem system{workers(), options};
  EXPECT_EQ(system.system().now(), Timestamp{0});
  system.advance(1h);
  EXPECT_EQ(system.system().now(), Timestamp{1h});
  system.expect_entry("Note in a where number == 1");
  system.expect_entry("Note in a where number == 2", 2h);
  EXPECT_THAT(complaint([&] { system.expect_entry("Note in a where number == 9", 1s); }),
              HasSubstr("within 1000 ms, but there is none"));
  EXPECT_LT(system.system().now(), Timestamp{3h});
  EXPECT_GE(system.system().now(), Timestamp{2h + 1s});
}

TEST_F(TestedSystem, InSimulatedTimeACrashIsNoticedAndLeasesExpire) {
  be_a_worker("one", poke);
  script("two").start = [](auto& self) {
    EntryLife life;
    life.time_to_live = 5s;
    self.add(Note{7, "for a while"}, life);
  };
  TestSystemOptions options;
  options.simulated_time = true;
  TestSystem system{workers(), options};
  system.expect_entry("Note in a where number == 7");
  system.inject("crash one");
  system.expect_back("one");
  system.expect_nobody_else_down({"one"});
  system.advance(5s);
  system.expect_no_entry("Note in a where number == 7");
}

TEST_F(TestedSystem, SaysWhoIsNotBackAndWhatThereWasInstead) {
  script("two").start = [](auto&) { throw std::runtime_error("no luck"); };
  TestSystem system{workers("SUPERVISE a DELAY 50s TO 50s\n")};
  EXPECT_THAT(complaint([&] { system.expect_back("one", 2, soon); }),
              HasSubstr("expected one to be back in life 2 within 20 ms, but it did not go down\n"
                        "until then:\n"));
  EXPECT_THAT(complaint([&] { system.expect_down("one", soon); }),
              HasSubstr("expected one to go down within 20 ms, but it did not go down"));
  system.inject("crash one");
  system.expect_back("one");
  EXPECT_THAT(complaint([&] { system.expect_back("one", 1, soon); }),
              HasSubstr("expected one to be back in life 1 within 20 ms, but it was last back in "
                        "life 2"));
  EXPECT_THAT(complaint([&] { system.expect_back("one", 3, soon); }),
              HasSubstr("but it was last back in life 2"));
  EXPECT_THAT(complaint([&] { system.expect_given_up("one", soon); }),
              HasSubstr("expected one to go down for good within 20 ms, but it was to be started "
                        "again"));
  EXPECT_THAT(complaint([&] { system.expect_back("two", 2, soon); }),
              AllOf(HasSubstr("but it was not back"),
                    ContainsRegex("one was back in life 2, after [0-9.]+ ms"),
                    ContainsRegex("two went down in life 1, to be started again: .*no luck")));
}

TEST_F(TestedSystem, SaysWhoElseWentDown) {
  TestSystem system{workers("SUPERVISE a one_for_all\n")};
  system.expect_nobody_else_down();
  system.inject("crash one");
  system.expect_back("two");
  EXPECT_THAT(complaint([&] { system.expect_nobody_else_down({"one"}); }),
              AllOf(HasSubstr("expected nobody but one to go down, but so did a_tm, a_wm, two"),
                    HasSubstr("two went down in life 1, to be started again: it is started again "
                              "because of one")));
  EXPECT_THAT(complaint([&] { system.expect_nobody_else_down(); }),
              HasSubstr("expected nobody to go down, but so did a_tm, a_wm, one, two"));
}

TEST_F(TestedSystem, AComponentIsGivenUp) {
  TestSystem system{subarchitecture("a") + "CPP UM one Unmanaged --restart temporary\n"
                                           "CPP UM two Unmanaged\n"};
  system.inject("crash one");
  EXPECT_FALSE(system.expect_given_up("one").will_restart);
  system.expect_nobody_else_down({"one"});
  // That is known at once.
  EXPECT_THAT(
    complaint([&] { system.expect_back("one", 2, 1h); }),
    AllOf(HasSubstr("but it was given up"), HasSubstr("one went down in life 1, for good")));
}

TEST_F(TestedSystem, TheSystemEndsAsItShould) {
  TestSystem system{
    workers("SUPERVISE * RESTARTS 0 IN 1min\nSUPERVISE SYSTEM RESTARTS 0 IN 1min\n")};
  EXPECT_THAT(
    complaint([&] { system.expect_end(1, "a has failed", soon); }),
    HasSubstr("expected the system to end with status 1 and \"a has failed\" within 20 ms, "
              "but it goes on"));
  system.inject("crash one");
  system.expect_end(1, "a has failed as a whole");
  EXPECT_THAT(complaint([&] { system.expect_end(0); }),
              HasSubstr("expected the system to end with status 0, but it ended with status 1: "
                        "the supervisor: one has failed"));
  EXPECT_THAT(complaint([&] { system.expect_end(1, "of old age"); }),
              HasSubstr("status 1 and \"of old age\", but it ended with status 1"));
  // Nothing is waited for any more.
  EXPECT_THAT(complaint([&] { system.expect_back("two", 2, 1h); }),
              HasSubstr("the system has ended with status 1"));
}

TEST_F(TestedSystem, ACallbackThrowsWhenItIsTo) {
  std::atomic<int> calls{0};
  script("two").start = [&](auto& self) {
    self.on_change(added<Note>().from("one").where(&Note::text, "poked"),
                   [&](const ChangeEvent&) { ++calls; });
  };
  be_a_worker("one", poke);
  TestSystem system{workers()};
  system.inject("throw in callback 2 of two");
  poke = 1;
  system.wait_until("the first note is heard of", [&] { return calls == 1; });
  system.expect_nobody_else_down();
  poke = 2;
  EXPECT_THAT(system.expect_down("two").reason, HasSubstr("injected failure"));
  EXPECT_EQ(calls, 1);
  system.expect_back("two");
}

TEST_F(TestedSystem, ARestartLastsAsLongAsItsStartIsBlocked) {
  be_a_worker("one", poke);
  TestSystem system{workers()};
  for (auto phase : {"start", "configure"}) {
    system.inject("block " + std::string{phase} + " of one for 300ms");
    system.inject("crash one");
    auto life = phase == std::string{"start"} ? 2U : 3U;
    EXPECT_GE(system.expect_back("one", life).down_us, 300'000) << phase;
  }
  system.expect_nobody_else_down({"one"});
  EXPECT_EQ(system.system().entries("a").size(), 3U);
}

TEST_F(TestedSystem, WaitsForWhatATestThinksOf) {
  TestSystem system{workers()};
  EXPECT_THAT(complaint([&] {
                system.wait_until(
                  "pigs fly", [] { return false; }, soon);
              }),
              HasSubstr("expected pigs fly within 20 ms, but that did not happen"));
}

TEST_F(TestedSystem, EntriesAreFoundByTheirContent) {
  be_a_worker("one", poke);
  TestSystem system{workers() + subarchitecture("b")};
  EXPECT_EQ(system.expect_entry("Note in a where number == 1")->value.as<Note>()->text, "from one");
  poke = 7;
  EXPECT_EQ(system.expect_entry("Note where number > 1")->value.as<Note>()->number, 7);
  EXPECT_THAT(
    complaint([&] { system.expect_entry("Note in a where number == 2", soon); }),
    AllOf(HasSubstr("expected an entry Note in a where number == 2 within 20 ms, but there "
                    "is none; there are\n"),
          ContainsRegex("Note of a/.*, version 0, by one: .*\"number\":7.*\"poked\""),
          ContainsRegex("Note of a/.*, version 0, by one: .*\"from one\"")));
  EXPECT_THAT(complaint([&] { system.expect_entry("Note in b", soon); }),
              HasSubstr("there is none, nor any other of that kind"));
  EXPECT_THAT(complaint([&] { system.expect_no_entry("Note where number == 7", soon); }),
              AllOf(HasSubstr("expected no entry Note where number == 7 within 20 ms, but there is "
                              "one\n"),
                    HasSubstr("poked")));
  system.expect_no_entry("Note where number == 8");
}

TEST_F(TestedSystem, LeasesAndEntriesEndWhenTimeJumps) {
  script("one").start = [&](auto& self) {
    self.add(Note{1, "short"}, EntryLife{.time_to_live = 1h});
    self.add(Note{2, "long"}, EntryLife{.time_to_live = 3h});
  };
  TestSystem system{workers()};
  system.expect_entry("Note where text == \"short\"");
  system.advance(2h);
  system.expect_no_entry("Note where text == \"short\"");
  system.expect_entry("Note where text == \"long\"");
}

TEST_F(TestedSystem, AWorkingMemoryIsBackFromItsJournalWhenThatHasFailed) {
  TemporaryFolder folder;
  std::atomic<int> life{0};
  script("one").start = [&](auto& self) {
    ++life;
    self.add(Note{0, "from one"});
  };
  script("one").run = [&](auto& self) {
    while (self.sleep_for(1ms))
      if (poke.exchange(0) > 0)
        self.add(Note{life, "poked"});
  };
  TestSystem system{"SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory --journal full "
                    "--journal-dir " +
                    (folder / "journals").string() +
                    "\nCPP TM AlwaysPositiveTaskManager\nCPP UM one Unmanaged\n"};
  system.expect_entry("Note where text == \"from one\"");
  system.inject("fail journal of a");
  poke = 1;
  EXPECT_THAT(system.expect_down("a_wm").reason, HasSubstr("injected failure"));
  system.expect_back("a_wm");
  system.expect_back("one");
  system.expect_entry("Note where text == \"from one\"");
  // What could not be written was not acknowledged, and so is not there. If the journal's failure
  // was noticed earlier, it is written by the next life.
  system.expect_no_entry("Note where text == \"poked\" && number == 1");
  system.inject("slow journal of a by 1ms for 1s");
  poke = 1;
  system.expect_entry("Note where text == \"poked\"");
}

/// A subarchitecture with a journal, whose component adds a note whenever `poke` is set.
class JournalsOfTestedSystems : public TestedSystem {
protected:
  std::string journaled(const std::string& working_memory_options) {
    be_a_worker("one", poke);
    return "SUBARCHITECTURE a\nCPP WM SubarchitectureWorkingMemory --journal full --journal-dir " +
           folder.path().string() + ' ' + working_memory_options +
           "\nCPP TM AlwaysPositiveTaskManager\nCPP UM one Unmanaged\n";
  }

  TemporaryFolder folder;
};

TEST_F(JournalsOfTestedSystems, ARemovedJournalEndsTheSystemAndStaysAsItWas) {
  const std::string at_once =
    "SUPERVISE * RESTARTS 0 IN 1min\nSUPERVISE SYSTEM RESTARTS 0 IN 1min\n";
  for (auto& [head, reason] :
       {std::pair{at_once, "a.castor-journal was removed or moved while it was in use"},
        // No working memory comes back that would hold less than was acknowledged.
        std::pair{std::string{}, "a_wm it could not be made anew"}}) {
    std::filesystem::remove_all(folder.path());
    TestSystem system{head + journaled("")};
    system.expect_entry("Note where number == 1");
    system.inject("remove journal of a");
    poke = 7;
    system.expect_end(1, reason);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.castor-journal"));
    EXPECT_TRUE(std::filesystem::exists(folder / "a.castor-journal.removed-1"));
  }
}

TEST_F(JournalsOfTestedSystems, OneThatGoesOnWithoutItsRemovedJournalDoesNotPretendToHaveIt) {
  TestSystem system{journaled("--journal-failure continue")};
  system.expect_entry("Note where number == 1");
  system.inject("remove journal of any");
  poke = 7;
  system.expect_entry("Note where number == 7");
  system.expect_nobody_else_down();
  auto failure = [&] { return system.system().summary().working_memories.at(0).journal.failure; };
  EXPECT_THAT(failure(), HasSubstr("was removed or moved while it was in use"));
  system.inject("crash a_wm");
  system.expect_back("a_wm");
  system.expect_back("one");
  system.expect_no_entry("Note where number == 7");
  EXPECT_THAT(failure(), HasSubstr("it has been removed or moved since the system began"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.castor-journal"));
  EXPECT_THROW(system.inject("remove journal of a"), std::runtime_error);
}

TEST_F(JournalsOfTestedSystems, AreRefusedToAnotherSystemAndGoOnUndisturbed) {
  TestSystem system{journaled("")};
  system.expect_entry("Note where number == 1");
  for (auto fault : {"claim journal of a", "claim journal of any"})
    system.inject(fault);
  poke = 7;
  system.expect_entry("Note where number == 7");
  system.inject("crash a_wm");
  system.expect_back("one");
  system.expect_entry("Note where number == 7");
}

TEST_F(TestedSystem, AnIsolatedComponentDoesNotTakeTheTestAlong) {
  TestSystem system{subarchitecture("a") + "CPP UM one Unmanaged --isolate\n"};
  system.inject("crash one");
  system.expect_back("one");
}

TEST_F(TestedSystem, WhatCannotBeIsRefused) {
  EXPECT_THAT(refusal([] { TestSystem system{"SUBARCHITECTUR a\n"}; }),
              HasSubstr("SUBARCHITECTUR"));
  TestSystem system{workers()};
  EXPECT_THAT(refusal([&] { system.inject("crash three"); }),
              HasSubstr("there is no component 'three'"));
  EXPECT_THAT(refusal([&] { system.inject("tickle one"); }), HasSubstr("is not a fault"));
  EXPECT_THAT(refusal([&] { system.inject("kill one"); }), HasSubstr("has no process of its own"));
  EXPECT_THAT(refusal([&] { system.inject("fail journal of a"); }), HasSubstr("has no journal"));
  EXPECT_THAT(refusal([&] { system.inject("hang one"); }), HasSubstr("write for how long"));
  EXPECT_THAT(refusal([&] { system.inject("block start of one"); }),
              HasSubstr("write for how long"));
  EXPECT_THAT(refusal([&] { system.inject("crash one\nat 1s crash two"); }),
              HasSubstr("is not one fault"));
  EXPECT_THAT(refusal([&] { system.expect_back("three"); }), HasSubstr("no component three"));
  EXPECT_THAT(refusal([&] { system.expect_entry("added Note"); }), HasSubstr("asks for a change"));
  EXPECT_THAT(refusal([&] { system.expect_entry("Note in"); }), Not(HasSubstr("not refused")));
  system.expect_nobody_else_down();
}

TEST_F(TestedSystem, WhatAFaultLeavesOpenIsDrawn) {
  TestSystem system{subarchitecture("a") + "CPP UM one Unmanaged\n" + subarchitecture("b") +
                    "CPP UM two Unmanaged\n"};
  system.inject("crash any component of b");
  system.expect_back("two");
  system.inject("crash one or crash any component of a");
  system.expect_back("one");
}

} // namespace

} // namespace castor::test
