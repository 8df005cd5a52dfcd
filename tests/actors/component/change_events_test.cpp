#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

namespace castor::test {

namespace {

class ChangeEvents : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  /// Runs one component of subarchitecture a; the body ends the system by returning.
  void run_component(std::function<void(UnmanagedScript&)> body, const std::string& options = {}) {
    UnmanagedScript::scripts()["c"].run = [body](auto& self) {
      body(self);
      self.end_system(0, "done");
    };
    System system{architecture(subarchitecture("a") + "CPP UM c Unmanaged " + options + "\n")};
    EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
  }
};

TEST_F(ChangeEvents, EveryChangeIsToldOnceAndInOrder) {
  run_component([](auto& self) {
    std::vector<std::string> seen;
    self.on_change(changed<Note>(), [&](const ChangeEvent& e) {
      seen.push_back(std::string{to_string(e.operation)} + std::to_string(e.version));
      EXPECT_EQ(e.source, "c");
      EXPECT_EQ(e.sequence, seen.size());
    });
    auto address = self.add(Note{});
    self.overwrite(address, Note{1, ""});
    self.overwrite(address, Note{2, ""});
    self.delete_entry(address);
    self.add(address, Note{});
    EXPECT_TRUE(seen.empty()) << "callbacks run when the component lets them, not before";
    while (seen.size() < 5)
      ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(seen,
              (std::vector<std::string>{"ADD0", "OVERWRITE1", "OVERWRITE2", "DELETE2", "ADD3"}));
  });
}

TEST_F(ChangeEvents, AnAtomicWriteIsObservedFromOutsideInAllItsParts) {
  std::vector<std::string> seen;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& e) { seen.push_back(e.address.id); };
  UnmanagedScript::scripts()["c"].run = [](auto& self) {
    self.write(WriteBatch{}.add(self.here("1"), Note{}).add(self.here("2"), Note{}));
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") + "CPP UM c Unmanaged\n"), options};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(seen, (std::vector<std::string>{"1", "2"}));
}

TEST_F(ChangeEvents, AreToldWithTheirEntriesInOrderToWhoeverLooksOn) {
  std::vector<std::string> seen;
  SystemOptions options;
  options.on_entry = [&](const ChangeEvent& e, const EntryPtr& entry) {
    seen.push_back(std::string{to_string(e.operation)} + ' ' + e.address.id +
                   (entry ? ' ' + std::to_string(entry->value.as<Note>()->number) : ""));
  };
  UnmanagedScript::scripts()["c"].run = [](auto& self) {
    self.add(self.here("1"), Note{1, ""});
    self.add(self.here("2"), Note{2, ""});
    self.add(self.here("3"), Note{3, ""});
    self.delete_entry(self.here("3"));
    self.add(self.here("4"), Note{4, ""});
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") + "CPP UM c Unmanaged\n"), options};
  EXPECT_EQ(run(system), 0);
  ASSERT_EQ(seen.size(), 5u);
  EXPECT_EQ(seen[0], "ADD 1 1");
  EXPECT_EQ(seen[1], "ADD 2 2");
  EXPECT_EQ(seen[2].substr(0, 5), "ADD 3") << "it may be gone before it is read";
  EXPECT_EQ(seen[3], "DELETE 3");
  EXPECT_EQ(seen[4], "ADD 4 4");
}

TEST_F(ChangeEvents, AnEventThatCameBeforeTheWaitIsNotMissed) {
  run_component([](auto& self) {
    int calls = 0;
    self.on_change(added<Note>(), [&](const ChangeEvent&) { ++calls; });
    self.add(Note{});
    EXPECT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(calls, 1);
    EXPECT_FALSE(self.wait_for_changes(20ms));
    EXPECT_EQ(calls, 1);
  });
}

TEST_F(ChangeEvents, SeveralReceiversAreCalledByPriority) {
  run_component([](auto& self) {
    std::string order;
    self.on_change(
      added<Note>(), [&](const ChangeEvent&) { order += "l"; }, Priority::low);
    self.on_change(added<Note>(), [&](const ChangeEvent&) { order += "m"; });
    self.on_change(
      changed<Note>(), [&](const ChangeEvent&) { order += "h"; }, Priority::high);
    self.on_change(any_change(), [&](const ChangeEvent&) { order += "n"; });
    self.add(Note{});
    ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(order, "hmnl");
  });
}

TEST_F(ChangeEvents, ReceiversMayComeAndGoInsideACallback) {
  run_component([](auto& self) {
    int first = 0;
    int second = 0;
    ReceiverId once = 0;
    ReceiverId never = 0;
    once = self.on_change(
      added<Note>(),
      [&](const ChangeEvent&) {
        ++first;
        self.remove_receiver(once);
        self.remove_receiver(never);
        self.on_change(added<Note>(), [&](const ChangeEvent&) { ++second; });
      },
      Priority::high);
    never = self.on_change(added<Note>(), [&](const ChangeEvent&) {
      ADD_FAILURE() << "removed by a receiver of higher priority on the same event";
    });
    self.add(Note{});
    ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(self.receiver_count(), 1u);
    self.add(Note{});
    ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
  });
}

TEST_F(ChangeEvents, ACallbackMayUseWorkingMemoryAndIsNotInterruptedByFurtherEvents) {
  run_component([](auto& self) {
    int depth = 0;
    int calls = 0;
    self.on_change(added<Note>(), [&](const ChangeEvent& e) {
      EXPECT_EQ(depth++, 0);
      if (++calls < 200) {
        auto note = *self.template read<Note>(e.address);
        self.add(Note{note.number + 1, ""});
        self.overwrite(e.address, Note{note.number, "seen"});
      }
      --depth;
    });
    self.add(Note{0, ""});
    while (calls < 200)
      ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(self.template read_all<Note>().size(), 200u);
  });
}

TEST_F(ChangeEvents, FiltersOfEveryKind) {
  run_component([](auto& self) {
    std::map<std::string, int> hits;
    auto count = [&](const std::string& name) {
      return [&hits, name](const ChangeEvent&) { ++hits[name]; };
    };
    auto special = self.here("special");
    self.on_change(added<Note>(), count("added"));
    self.on_change(overwritten<Note>(), count("overwritten"));
    self.on_change(deleted<Note>(), count("deleted"));
    self.on_change(changed<Remark>(), count("remark"));
    self.on_change(changes_of(special), count("special"));
    self.on_change(any_change().from("c"), count("from c"));
    self.on_change(any_change().from("d"), count("from d"));
    EXPECT_THROW(self.on_change(any_change().in("elsewhere"), count("elsewhere")),
                 UnknownSubarchitectureException);
    self.on_change(any_change().anywhere(), count("anywhere"));
    int all = 0;
    self.on_change(
      any_change(), [&](const ChangeEvent&) { ++all; }, Priority::low);
    self.add(special, Note{});
    self.add(Remark{});
    self.overwrite(special, Note{});
    self.delete_entry(special);
    while (all < 4)
      ASSERT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(hits, (std::map<std::string, int>{{"added", 2},
                                                {"overwritten", 1},
                                                {"deleted", 1},
                                                {"remark", 1},
                                                {"special", 3},
                                                {"from c", 4},
                                                {"anywhere", 4}}));
  });
}

TEST_F(ChangeEvents, OnlyTheNewestIsKeptIfTheComponentWantsItSo) {
  run_component(
    [](auto& self) {
      std::vector<Version> seen;
      self.on_change(changed<Note>(), [&](const ChangeEvent& e) { seen.push_back(e.version); });
      auto address = self.add(Note{});
      for (int i = 1; i <= 10; ++i)
        self.overwrite(address, Note{i, ""});
      ASSERT_TRUE(self.wait_for_changes(10s));
      EXPECT_FALSE(self.wait_for_changes(20ms));
      EXPECT_EQ(seen, std::vector<Version>{10});
    },
    "--queue newest");
}

TEST_F(ChangeEvents, ReceptionCanBeSwitchedOff) {
  run_component([](auto& self) {
    int calls = 0;
    self.on_change(added<Note>(), [&](const ChangeEvent&) { ++calls; });
    self.receive_changes(false);
    self.add(Note{});
    EXPECT_FALSE(self.wait_for_changes(20ms));
    self.receive_changes(true);
    self.add(Note{});
    EXPECT_TRUE(self.wait_for_changes(10s));
    EXPECT_EQ(calls, 1);
  });
}

TEST_F(ChangeEvents, OtherSubarchitecturesHearThroughTheirWorkingMemory) {
  std::atomic<int> local{0};
  std::atomic<int> remote{0};
  std::atomic<int> unwanted{0};
  UnmanagedScript::scripts()["far"].start = [&](auto& self) {
    self.on_change(added<Note>().in("a"), [&](const ChangeEvent& e) {
      EXPECT_EQ(e.address.subarchitecture, "a");
      // An entry can be read from anywhere.
      EXPECT_EQ(self.template read<Note>(e.address)->number, 42);
      ++remote;
    });
    self.on_change(changed<Note>(), [&](const ChangeEvent&) { ++unwanted; });
  };
  UnmanagedScript::scripts()["near"].start = [&](auto& self) {
    self.on_change(added<Note>(), [&](const ChangeEvent&) { ++local; });
  };
  UnmanagedScript::scripts()["writer"].run = [](auto& self) { self.add(Note{42, ""}); };
  System system{
    architecture(subarchitecture("a") + "CPP UM near Unmanaged\nCPP UM writer Unmanaged\n" +
                 subarchitecture("b") + "CPP UM far Unmanaged\n" + subarchitecture("c"))};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return local == 1 && remote == 1; }));
  auto wms = system.summary().working_memories;
  EXPECT_EQ(wms.at(0).forwarded, 1u) << "to b, and not to c, where nobody wants it";
  EXPECT_EQ(wms.at(1).delivered, 1u);
  system.stop();
  EXPECT_EQ(unwanted, 0);
}

} // namespace

} // namespace castor::test
