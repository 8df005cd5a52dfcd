#include "castor/tests/actors/component/scripted.hpp"

#include "castor/wm/entries/failure.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

namespace castor::test {

namespace {

class Operations : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  /// Runs one component of subarchitecture a, beside an empty subarchitecture b; the body ends the
  /// system by returning.
  void run_component(std::function<void(UnmanagedScript&)> body, const std::string& head = {},
                     const std::string& others = {}) {
    UnmanagedScript::scripts()["c"].run = [body](auto& self) {
      body(self);
      self.end_system(0, "done");
    };
    System system{
      architecture(head + subarchitecture("b") + subarchitecture("a") + "CPP UM c Unmanaged\n" + others)};
    ASSERT_TRUE(system.start());
    ASSERT_EQ(system.wait({30s, {}}), EndReason::ended_by_component)
      << system.summary().components.back().failure;
    system.stop();
  }

  template <class E, class F>
  static std::string message_of(F&& f) {
    try {
      f();
    } catch (const E& e) {
      return e.what();
    } catch (const std::exception& e) {
      return std::string{"another exception: "} + e.what();
    }
    return "no exception";
  }
};

TEST_F(Operations, WhatIsWrittenCanBeRead) {
  run_component([](auto& self) {
    auto address = self.add(Note{1, "one"});
    EXPECT_EQ(address.subarchitecture, "a");
    auto entry = self.template read<Note>(address);
    EXPECT_EQ(*entry, (Note{1, "one"}));
    EXPECT_EQ(entry.version, 0u);
    EXPECT_EQ(entry.writer, "c");
    EXPECT_EQ(self.overwrite(address, Note{2, "two"}), 1u);
    EXPECT_EQ(self.template read<Note>(address)->number, 2);
    EXPECT_EQ(self.version(address), 1u);
    self.delete_entry(address);
    EXPECT_FALSE(self.exists(address));
    EXPECT_EQ(self.version(address), 1u);
    self.add(address, Note{3, "three"});
    EXPECT_EQ(self.version(address), 2u);
  });
}

TEST_F(Operations, ReadsDoNotOvertakeWritesWhoseAnswersNobodyWaitsFor) {
  // Keeps both working memories busy, so that the requests of others wait.
  UnmanagedScript::scripts()["busy"].run = [](auto& self) {
    for (std::string where : {"a", "b"})
      self.add(Address{where, "busy"}, Note{0});
    while (self.is_running())
      for (std::string where : {"a", "b"})
        self.overwrite(Address{where, "busy"}, Note{1});
  };
  run_component(
    [](auto& self) {
      for (std::string where : {"a", "b"}) {
        Address address{where, "x"};
        self.add(address, Note{0});
        for (int i = 1; i <= 2000; ++i) {
          self.overwrite_async(address, Note{i});
          ASSERT_EQ(self.template read<Note>(address)->number, i) << where;
        }
      }
    },
    "ACCESS a WRITES b\n", "CPP UM busy Unmanaged\n");
}

TEST_F(Operations, AStopIsSeenInAnEndlessLoopOfReads) {
  UnmanagedScript::scripts()["c"].run = [](auto& self) {
    auto address = self.add(Note{1});
    self.end_system(0, "done");
    for (;;)
      self.template read<Note>(address);
  };
  System system{architecture(subarchitecture("a") + "CPP UM c Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_TRUE(system.summary().stuck.empty());
}

TEST_F(Operations, NewIdsAreAllDifferent) {
  run_component([](auto& self) {
    std::set<std::string> ids;
    for (int i = 0; i < 1000; ++i)
      EXPECT_TRUE(ids.insert(self.new_id()).second);
  });
}

TEST_F(Operations, ReadingByTypeGivesTheNewestFirst) {
  run_component([](auto& self) {
    auto first = self.add(Note{1, ""});
    self.add(Note{2, ""});
    self.add(Note{3, ""});
    self.add(Remark{{4, ""}, true});
    self.overwrite(first, Note{10, ""});
    std::vector<std::int64_t> numbers;
    for (auto& note : self.template read_all<Note>())
      numbers.push_back(note->number);
    EXPECT_EQ(numbers, (std::vector<std::int64_t>{10, 3, 2}));
    EXPECT_EQ(self.template read_all<Note>(2).size(), 2u);
    EXPECT_EQ(self.template read_all_derived<Note>("a").size(), 4u);
    EXPECT_TRUE(self.template read_all<Other>().empty());
    EXPECT_TRUE(self.template read_all_in<Note>("b").empty());
  });
}

TEST_F(Operations, FailuresAreThePapersExceptionsAndSaySo) {
  run_component([](auto& self) {
    auto address = self.here("x");
    EXPECT_NE(message_of<DoesNotExistOnWM>([&] { self.template read<Note>(address); }).find("a/x"),
              std::string::npos);
    EXPECT_NE(message_of<DoesNotExistOnWM>([&] { self.overwrite(address, Note{}); }).find("Add it"),
              std::string::npos);
    self.add(address, Note{});
    EXPECT_NE(
      message_of<AlreadyExistsOnWM>([&] { self.add(address, Note{}); }).find("c put a Note"),
      std::string::npos);
    EXPECT_NE(message_of<TypeMismatchException>([&] {
                self.template read<Other>(address);
              }).find("put a Note"),
              std::string::npos);
    EXPECT_NE(message_of<UnknownSubarchitectureException>([&] {
                self.template read<Note>(Address{"c", "x"});
              }).find("there are: a, b"),
              std::string::npos);
    EXPECT_NE(message_of<PermissionException>([&] {
                self.add(Address{"b", "y"}, Note{});
              }).find("ACCESS a WRITES b"),
              std::string::npos);
  });
}

TEST_F(Operations, AccessRulesOpenAnotherWorkingMemory) {
  run_component(
    [](auto& self) {
      Address there{"b", "y"};
      self.add(there, Note{5, ""});
      EXPECT_EQ(self.template read<Note>(there)->number, 5);
      EXPECT_EQ(self.overwrite(there, Note{6, ""}), 1u);
    },
    "ACCESS a WRITES b\n");
}

TEST_F(Operations, PipelinedWritesAllTakeEffectInOrder) {
  run_component([](auto& self) {
    auto address = self.add(Note{0, ""});
    std::vector<Pending<Version>> pending;
    for (int i = 1; i <= 100; ++i)
      pending.push_back(self.overwrite_async(address, Note{i, ""}));
    auto read = self.template read_async<Note>(address);
    EXPECT_EQ(read.get()->number, 100);
    for (std::size_t i = 0; i < pending.size(); ++i)
      EXPECT_EQ(pending[i].get(), i + 1);
    // Results that nobody takes are no trouble.
    for (int i = 0; i < 100; ++i)
      self.add_async(self.here("dropped" + std::to_string(i)), Note{});
    EXPECT_EQ(self.template read_all<Note>().size(), 101u);
  });
}

TEST_F(Operations, AStaleOverwriteIsRefusedAndARereadCuresIt) {
  std::atomic<int> step{0};
  UnmanagedScript::scripts()["other"] = {{},
                                         [&](auto& self) {
                                           self.on_change(added<Note>(), [&](const ChangeEvent& e) {
                                             self.template read<Note>(e.address);
                                             self.overwrite(e.address, Note{2, "other"});
                                             step = 1;
                                           });
                                         },
                                         {},
                                         {}};
  UnmanagedScript::scripts()["c"].run = [&](auto& self) {
    auto address = self.add(Note{1, "mine"});
    while (step == 0 && self.is_running())
      self.sleep_for(1ms);
    auto message = message_of<ConsistencyException>([&] {
      self.overwrite(address, Note{3, "mine"});
    });
    EXPECT_NE(message.find("version 0"), std::string::npos) << message;
    EXPECT_NE(message.find("other has since written version 1"), std::string::npos) << message;
    EXPECT_EQ(self.template read<Note>(address)->text, "other");
    EXPECT_EQ(self.overwrite(address, Note{3, "mine"}), 2u);
    self.end_system(0, "done");
  };
  System system{
    architecture(subarchitecture("a") + "CPP UM other Unmanaged\nCPP UM c Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Operations, AWriteThatCountsOnAFailedOneFailsToo) {
  std::atomic<int> step{0};
  UnmanagedScript::scripts()["other"] = {{},
                                         [&](auto& self) {
                                           self.on_change(added<Note>(), [&](const ChangeEvent& e) {
                                             self.template read<Note>(e.address);
                                             self.overwrite(e.address, Note{2, "other"});
                                             step = 1;
                                           });
                                         },
                                         {},
                                         {}};
  UnmanagedScript::scripts()["c"].run = [&](auto& self) {
    auto address = self.add(Note{1, "mine"});
    while (step == 0 && self.is_running())
      self.sleep_for(1ms);
    auto first = self.overwrite_async(address, Note{3, "mine"});
    auto second = self.overwrite_async(address, Note{4, "mine"});
    EXPECT_NE(message_of<ConsistencyException>([&] { first.get(); }).find("seen version 0"),
              std::string::npos);
    EXPECT_NE(message_of<ConsistencyException>([&] { second.get(); }).find("this one depends on"),
              std::string::npos);
    EXPECT_NE(message_of<ConsistencyException>([&] {
                self.overwrite(address, Note{5, "mine"});
              }).find("seen version 0"),
              std::string::npos);
    EXPECT_EQ(self.template read<Note>(address)->text, "other");
    EXPECT_EQ(self.overwrite(address, Note{6, "mine"}), 2u);
    self.end_system(0, "done");
  };
  System system{
    architecture(subarchitecture("a") + "CPP UM other Unmanaged\nCPP UM c Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Operations, PuttingAddsOrOverwritesWhateverIsThere) {
  UnmanagedScript::scripts()["writer"].start = [](auto& self) {
    self.add(self.here("theirs"), Note{1, "theirs"});
    self.add(self.here("locked"), Note{1, "theirs"});
    self.lock_entry(self.here("locked"), LockLevel::o);
  };
  UnmanagedScript::scripts()["c"].run = [](auto& self) {
    self.put(self.here("mine"), Note{2, "mine"});
    EXPECT_EQ(*self.template read<Note>(self.here("mine")), (Note{2, "mine"}));
    self.put(self.here("theirs"), Note{2, "mine"});
    EXPECT_EQ(*self.template read<Note>(self.here("theirs")), (Note{2, "mine"}));
    self.put(self.here("theirs"), Note{3, "mine"});
    EXPECT_EQ(self.version(self.here("theirs")), 2u);
    EXPECT_THROW(self.put(self.here("locked"), Note{2, "mine"}), PermissionException);
    self.end_system(0, "done");
  };
  System system{
    architecture(subarchitecture("a") + "CPP UM writer Unmanaged\nCPP UM c Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Operations, AnEmptyHandedOverwriteIsRefused) {
  UnmanagedScript::scripts()["writer"].start = [](auto& self) { self.add(self.here("x"), Note{}); };
  UnmanagedScript::scripts()["c"].run = [](auto& self) {
    EXPECT_NE(message_of<ConsistencyException>([&] {
                self.overwrite(self.here("x"), Note{});
              }).find("never read"),
              std::string::npos);
    self.end_system(0, "done");
  };
  System system{
    architecture(subarchitecture("a") + "CPP UM writer Unmanaged\nCPP UM c Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
}

} // namespace

} // namespace castor::test
