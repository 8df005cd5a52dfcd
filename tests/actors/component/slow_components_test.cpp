#include "castor/actors/component/call_types.hpp"
#include "castor/tests/actors/component/bytes_in_use.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <string>
#include <thread>
#include <utility>

namespace castor::test {

namespace {

struct Question {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Question, number)

struct Answer {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Answer, number)

/// What somebody who hears of every change makes of it.
struct Story {
  void hear(const ChangeEvent& event) {
    ++events;
    coalesced += event.coalesced;
    auto i = versions.find(event.address.id);
    auto known = i != versions.end();
    switch (event.operation) {
      case Operation::add:
        faults += known || event.version < next_version(event.address.id);
        break;
      case Operation::overwrite:
        faults += !known || event.version < next_version(event.address.id);
        break;
      case Operation::remove:
        faults += !known || event.version + 1 < next_version(event.address.id);
        break;
    }
    last_version[event.address.id] = event.version;
    if (event.operation == Operation::remove)
      versions.erase(event.address.id);
    else
      versions[event.address.id] = event.version;
    faults += event.sequence <= last_sequence;
    last_sequence = event.sequence;
  }

  Version next_version(const std::string& id) const {
    auto i = last_version.find(id);
    return i == last_version.end() ? 0 : i->second + 1;
  }

  int events = 0;
  int coalesced = 0;
  int faults = 0;
  std::uint64_t last_sequence = 0;
  std::map<std::string, Version> last_version;
  /// What there is, as far as it knows.
  std::map<std::string, Version> versions;
};

/// Those who wait for it wait no longer than its life, which ends if the writer is stopped, too.
class SetAtEnd {
public:
  explicit SetAtEnd(std::atomic<bool>& flag) : flag_(flag) {}
  ~SetAtEnd() {
    flag_ = true;
    flag_.notify_all();
  }
  SetAtEnd(const SetAtEnd&) = delete;
  SetAtEnd& operator=(const SetAtEnd&) = delete;

private:
  std::atomic<bool>& flag_;
};

class SlowComponentsOfASystem : public testing::Test {
protected:
  static constexpr int overwrites = 10'000;
  static constexpr int entries = 5;
  static constexpr int comings_and_goings = 500;
  static constexpr int events = entries + overwrites + 2 * comings_and_goings + 1;

  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return UnmanagedScript::scripts()[name]; }

  /// Overwrites a few entries again and again, while others come and go; the last write adds one
  /// called "end".
  static void write(UnmanagedScript& self) {
    for (int i = 0; i < entries; ++i)
      self.add(self.here(std::to_string(i)), Note{});
    for (int i = 0; i < overwrites; ++i) {
      self.overwrite(self.here(std::to_string(i * i % entries)), Note{i, ""});
      if (i % (overwrites / comings_and_goings) != 0)
        continue;
      // Every other time under an id of its own.
      auto address = i % 3 == 0 ? self.here("guest") : self.here("guest" + std::to_string(i));
      self.add(address, Note{});
      self.delete_entry(address);
    }
    self.add(self.here("end"), Note{});
  }

  /// Listens to everything until the end; `pause` is called with every event.
  void listen(const std::string& name, std::function<void(UnmanagedScript&)> pause) {
    auto& story = stories[name];
    script(name).start = [this, &story, pause](auto& self) {
      self.on_change(changed<Note>().anywhere(),
                     [this, &self, &story, pause](const ChangeEvent& e) {
                       story.hear(e);
                       pause(self);
                       if (e.address.id == "end" && ++finished == static_cast<int>(stories.size()))
                         self.end_system(0, "all have heard of the end");
                     });
    };
  }

  static std::map<std::string, Version> versions_in(System& system) {
    std::map<std::string, Version> result;
    for (auto& entry : system.entries("a"))
      result[entry->address.id] = entry->version;
    return result;
  }

  std::map<std::string, Story> stories;
  std::atomic<int> finished{0};
};

TEST_F(SlowComponentsOfASystem, SeeAConsistentStoryOfWhatTheyMissed) {
  std::atomic<bool> written{false};
  listen("stuck", [&](auto&) { written.wait(false); });
  listen("slow", [](auto&) { std::this_thread::sleep_for(20us); });
  listen("distant", [](auto&) { std::this_thread::sleep_for(20us); });
  listen("fast", [](auto&) {});
  script("writer").run = [&](auto& self) {
    const SetAtEnd end{written};
    write(self);
  };
  System system{
    architecture(subarchitecture("a") +
                 "CPP UM stuck Unmanaged --queue-limit 64\nCPP UM slow Unmanaged --queue-limit 64\n"
                 "CPP UM fast Unmanaged\nCPP UM writer Unmanaged\n" +
                 subarchitecture("b") + "CPP UM distant Unmanaged --queue-limit 64\n")};
  ASSERT_EQ(run(system), 0);
  auto expected = versions_in(system);
  for (auto& [name, story] : stories) {
    EXPECT_EQ(story.faults, 0) << name;
    EXPECT_EQ(story.versions, expected) << name;
  }
  EXPECT_EQ(stories["fast"].events, events);
  EXPECT_EQ(stories["fast"].coalesced, 0);
  auto& stuck = stories["stuck"];
  EXPECT_GT(stuck.coalesced, 0);
  // What it had already been sent, and of each entry that it knew or that is there two more.
  EXPECT_LE(stuck.events, 64 + 2 * (entries + 3));
  auto of_a = system.summary().working_memories.at(0);
  EXPECT_GT(of_a.suppressed, 0u);
  EXPECT_GT(of_a.coalesced, 0u);
}

TEST_F(SlowComponentsOfASystem, TakeNoMemoryWhileTheyHang) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "660,000 operations take minutes under sanitizers";
#endif
  std::atomic<bool> hangs{true};
  script("hung").start = [&](auto& self) {
    for (auto& filter : {any_change(), ChangeFilter{added<Note>()}, ChangeFilter{deleted<Note>()},
                         ChangeFilter{overwritten<Note>()}})
      self.on_change(filter, [&](const ChangeEvent&) {
        while (hangs)
          std::this_thread::yield();
      });
  };
  std::size_t before = 0;
  std::size_t after = 0;
  script("writer").run = [&](auto& self) {
    // More than there are deleted ids whose versions are remembered.
    auto some_entries = [&] {
      for (int i = 0; i < 110'000; ++i) {
        auto address = self.add(Note{});
        self.overwrite(address, Note{1, ""});
        self.delete_entry(address);
      }
    };
    some_entries();
    before = bytes_in_use();
    some_entries();
    after = bytes_in_use();
    hangs = false;
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") +
                             "CPP UM hung Unmanaged --queue-limit 64\nCPP UM writer Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_LT(after, before + 200'000);
}

TEST_F(SlowComponentsOfASystem, MayMakeCallsWhileTheirQueueIsFull) {
  std::atomic<bool> written{false};
  script("server").start = [](auto& self) {
    self.template on_call<Question>([](const Question& x) { return Answer{2 * x.number}; });
  };
  script("caller").start = [&](auto& self) {
    self.on_change(changed<Note>(), [&, called = false](const ChangeEvent&) mutable {
      if (std::exchange(called, true))
        return;
      written.wait(false);
      for (int i = 0; i < 30; ++i)
        EXPECT_EQ((self.template call<Question, Answer>("b", Question{i})).number, 2 * i);
      self.end_system(0, "done");
    });
  };
  script("writer").run = [&](auto& self) {
    const SetAtEnd end{written};
    write(self);
  };
  System system{architecture(subarchitecture("a") +
                             "CPP UM caller Unmanaged --queue-limit 16\nCPP UM writer Unmanaged\n" +
                             subarchitecture("b") + "CPP UM server Unmanaged --queue-limit 16\n")};
  EXPECT_EQ(run(system), 0);
}

TEST_F(SlowComponentsOfASystem, HearOfCancelledCallsHoweverManyThereWere) {
  bool cancelled = false;
  script("server").start = [&](auto& self) {
    self.template on_call<Question>([&](const Question&) {
      while (!self.call_cancelled())
        if (!self.sleep_for(1ms))
          return Answer{};
      cancelled = true;
      self.end_system(0, "done");
      return Answer{};
    });
  };
  script("caller").run = [](auto& self) {
    for (int i = 0; i < 4000; ++i)
      self.delete_entry(self.add(Call{"b", "Errand", "Answer", {}, "somebody"}));
    // Until the server has taken one in time.
    for (;;) {
      try {
        self.template call<Question, Answer>("b", Question{}, CallOptions{.timeout = 50ms});
      } catch (const DeadlineException&) {
        self.sleep_for(50ms);
      }
    }
  };
  System system{architecture(subarchitecture("a") + "CPP UM caller Unmanaged\n" +
                             subarchitecture("b") +
                             "CPP UM server Unmanaged --queue-limit 3000\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_TRUE(cancelled);
}

/// Whatever becomes of an event in the component, the working memory learns that it is taken:
/// otherwise none would come any more.
TEST_F(SlowComponentsOfASystem, AreSentMoreWhateverBecomesOfWhatTheyWereSent) {
  for (std::string mode : {"all", "newest"}) {
    script("c").run = [](auto& self) {
      Version seen = 0;
      auto note = [&](const ChangeEvent& e) { seen = e.version; };
      auto address = self.add(Note{});
      for (int round = 0; round < 20; ++round) {
        // Dropped on arrival.
        self.on_change(any_change(), note);
        self.receive_changes(false);
        for (int i = 0; i < 50; ++i)
          self.overwrite(address, Note{});
        self.sleep_for(1us);
        self.receive_changes(true);
        // Wanted no more when they are delivered.
        auto former = self.on_change(any_change(), [](const ChangeEvent&) {});
        for (int i = 0; i < 50; ++i)
          self.overwrite(address, Note{});
        self.remove_receiver(former);
        // Delivered, or discarded for newer ones.
        Version last = 0;
        for (int i = 0; i < 50; ++i)
          last = self.overwrite(address, Note{});
        while (seen != last)
          ASSERT_TRUE(self.wait_for_changes(10s)) << "nothing came after version " << seen;
      }
      self.end_system(0, "done");
    };
    System system{architecture(subarchitecture("a") +
                               "CPP UM c Unmanaged --queue-limit 16 --queue " + mode + "\n")};
    EXPECT_EQ(run(system), 0) << mode;
  }
}

TEST_F(SlowComponentsOfASystem, NeedRoomForAFewEvents) {
  script("writer").run = [](auto& self) { self.end_system(0, "done"); };
  System good{architecture(subarchitecture("a") + "CPP UM writer Unmanaged --queue-limit 16\n")};
  EXPECT_EQ(run(good), 0);
  System cramped{
    architecture(subarchitecture("a") + "CPP UM cramped Unmanaged --queue-limit 15\n")};
  EXPECT_THROW(cramped.start(), SystemError);
  EXPECT_EQ(cramped.summary().components.at(1).failure,
            "failed in configure(): --queue-limit is 15, but the least is 16");
}

TEST_F(SlowComponentsOfASystem, AreNotTheOnlyOnesWhoMayFallBehind) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "150,000 operations take minutes under ThreadSanitizer";
#endif
  constexpr int flood = static_cast<int>(standard_queue_limit) * 3 / 2;
  std::atomic<bool> written{false};
  Story story;
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& e) {
    written.wait(false);
    if (e.coalesced)
      std::this_thread::sleep_for(50ms);
    story.hear(e);
  };
  script("writer").run = [&](auto& self) {
    {
      const SetAtEnd end{written};
      auto address = self.add(Note{});
      for (int i = 0; i < flood; ++i)
        self.overwrite(address, Note{i, ""});
    }
    self.add(self.here("end"), Note{});
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") + "CPP UM writer Unmanaged\n"), options};
  ASSERT_EQ(run(system), 0);
  EXPECT_EQ(story.faults, 0);
  EXPECT_EQ(story.versions, versions_in(system)) << "stopping waits until all is told";
  EXPECT_GT(story.coalesced, 0);
  EXPECT_LT(story.events, flood);
}

TEST_F(SlowComponentsOfASystem, AnOutsideObserverThatKeepsUpMissesNothing) {
  constexpr int rounds = 2;
  // Together more than its queue holds.
  constexpr int flood = static_cast<int>(standard_queue_limit) * 6 / 10;
  Story story;
  std::atomic<int> told{0};
  SystemOptions options;
  options.on_change = [&](const ChangeEvent& e) {
    story.hear(e);
    ++told;
  };
  script("writer").run = [&](auto& self) {
    auto address = self.add(Note{});
    for (int round = 1; round <= rounds; ++round) {
      for (int i = 0; i < flood; ++i)
        self.overwrite(address, Note{i, ""});
      EXPECT_TRUE(eventually([&] { return told == 1 + round * flood; }));
    }
    self.end_system(0, "done");
  };
  System system{architecture(subarchitecture("a") + "CPP UM writer Unmanaged\n"), options};
  ASSERT_EQ(run(system), 0);
  EXPECT_EQ(story.faults, 0);
  EXPECT_EQ(story.coalesced, 0);
}

} // namespace

} // namespace castor::test
