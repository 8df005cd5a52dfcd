#include "castor/actors/system/local_endpoint.hpp"
#include "castor/tests/actors/component/scripted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

class Connections : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static constexpr auto server = "HOST localhost\nCOMPONENT CPP server Standalone\n";

  void run_client(std::function<void(UnmanagedScript&)> body) {
    UnmanagedScript::scripts()["client"].run = [body](auto& self) {
      body(self);
      self.end_system(0, "done");
    };
    System system{architecture(server + subarchitecture("a") + "CPP UM client Unmanaged\n"),
                  without_restarts()};
    EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
  }

  /// How many pushes of the server nobody got.
  static std::uint64_t dropped(System& system) {
    for (auto& x : system.summary().components)
      if (x.identity.name == "server")
        return x.pushes_dropped;
    return 0;
  }

  static std::string message_of(std::function<void()> f) {
    try {
      f();
    } catch (const ConnectionError& e) {
      return e.what();
    }
    return "no ConnectionError";
  }
};

TEST_F(Connections, AServerThatOutlivesTheSystemDoesNotKeepItFromEnding) {
  UnmanagedScript::scripts()["client"].run = [](auto& self) { self.end_system(0, "done"); };
  SystemRosterPtr roster;
  {
    auto options = without_restarts();
    options.on_change = [](const ChangeEvent&) {};
    options.on_task = [](const TaskEvent&) {};
    System system{architecture(server + subarchitecture("a") + "CPP UM client Unmanaged\n"),
                  options};
    EXPECT_EQ(run(system), 0);
    roster = system.roster();
  }
  // Here the threads of the coordinator and of the observer have ended.
  EXPECT_EQ(roster->providers.size(), 1U);
}

TEST_F(Connections, AClientPullsWhatAServerProvides) {
  StandaloneScript::scripts()["server"].start = [](auto& self) {
    self.template provide<Note>([n = 0]() mutable { return Note{++n, "pulled"}; });
  };
  run_client([](auto& self) {
    EXPECT_EQ(self.template pull<Note>("server")->number, 1);
    EXPECT_EQ(self.template pull<Note>("server")->number, 2);
  });
}

TEST_F(Connections, AClientPullsInStartBecauseServersStartFirst) {
  StandaloneScript::scripts()["server"].start = [](auto& self) {
    self.template provide<Note>([] { return Note{7, ""}; });
  };
  std::atomic<std::int64_t> got{0};
  UnmanagedScript::scripts()["client"].start = [&](auto& self) {
    got = self.template pull<Note>("server")->number;
    self.end_system(0, "done");
  };
  System system{architecture(server + subarchitecture("a") + "CPP UM client Unmanaged\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(got, 7);
}

TEST_F(Connections, AReceiverMayStartBeforeWhoPushes) {
  std::atomic<bool> has_started{false};
  StandaloneScript::scripts()["early"].start = [&](auto& self) {
    self.template on_push<Note>("server", [&](const std::shared_ptr<const Note>& x) {
      EXPECT_TRUE(has_started);
      self.end_system(0, x->text);
    });
    EXPECT_FALSE(has_started);
  };
  StandaloneScript::scripts()["server"].start = [&](auto& self) {
    has_started = true;
    self.push(Note{1, "pushed"});
  };
  // Much less than the deadline of ten seconds.
  System system{architecture("HOST localhost\nCOMPONENT CPP early Standalone\n"
                             "COMPONENT CPP server Standalone\n"),
                without_restarts()};
  EXPECT_EQ(run(system), 0);
}

TEST_F(Connections, WhoPullsFromOneThatStartsLaterIsToldTheRemedy) {
  std::string failure;
  StandaloneScript::scripts()["early"].start = [&](auto& self) {
    failure = message_of([&] { self.template pull<Note>("server"); });
    self.end_system(0, "done");
  };
  System system{architecture("HOST localhost\nCOMPONENT CPP early Standalone --deadline 20ms\n"
                             "COMPONENT CPP server Standalone\n"),
                without_restarts()};
  EXPECT_EQ(run(system), 0);
  EXPECT_NE(failure.find("early got no answer within 20ms"), std::string::npos) << failure;
  EXPECT_NE(failure.find("if server starts after early, put its COMPONENT line before that of early"),
            std::string::npos)
    << failure;
}

TEST_F(Connections, PushesArriveInOrder) {
  StandaloneScript::scripts()["server"].run = [](auto& self) {
    for (int i = 0; self.sleep_for(1ms); ++i)
      self.push(Note{i, ""});
  };
  // Pushes may still arrive after the client's run().
  std::int64_t last = -1;
  int count = 0;
  run_client([&](auto& self) {
    self.template on_push<Note>("server", [&](const std::shared_ptr<const Note>& x) {
      EXPECT_TRUE(last < 0 || x->number == last + 1);
      last = x->number;
      ++count;
    });
    while (count < 20)
      ASSERT_TRUE(self.sleep_for(1ms));
  });
}

TEST_F(Connections, ASlowReceiverMissesTheOldestOfWhatIsTooMuch) {
  constexpr int pushes = 10'000;
  std::atomic<bool> subscribed{false};
  std::atomic<bool> pushed{false};
  StandaloneScript::scripts()["server"].run = [&](auto& self) {
    while (!subscribed)
      ASSERT_TRUE(self.sleep_for(1ms));
    for (int i = 1; i <= pushes; ++i)
      self.push(Note{i, ""});
    pushed = true;
  };
  std::vector<std::int64_t> got;
  UnmanagedScript::scripts()["client"].start = [&](auto& self) {
    self.template on_push<Note>("server", [&](const std::shared_ptr<const Note>& x) {
      EXPECT_TRUE(eventually([&] { return pushed.load(); }));
      got.push_back(x->number);
      if (x->number == pushes)
        self.end_system(0, "done");
    });
    subscribed = true;
  };
  System system{
    architecture(server + subarchitecture("a") + "CPP UM client Unmanaged --push-limit 8\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(got, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, pushes - 1, pushes}));
  EXPECT_EQ(dropped(system), pushes - got.size());
}

TEST_F(Connections, AReceiverThatKeepsUpGetsAllFromAServerThatNeverWaits) {
  constexpr int pushes = 1000;
  std::atomic<int> taken{-1};
  StandaloneScript::scripts()["server"].run = [&](auto& self) {
    while (taken < 0)
      ASSERT_TRUE(self.sleep_for(1ms));
    for (int i = 1; i <= pushes; ++i) {
      self.push(Note{i, ""});
      ASSERT_TRUE(eventually([&] { return taken == i; }));
    }
  };
  UnmanagedScript::scripts()["client"].start = [&](auto& self) {
    self.template on_push<Note>("server", [&](const std::shared_ptr<const Note>& x) {
      EXPECT_EQ(x->number, taken + 1);
      if (++taken == pushes)
        self.end_system(0, "done");
    });
    taken = 0;
  };
  System system{
    architecture(server + subarchitecture("a") + "CPP UM client Unmanaged --push-limit 4\n")};
  EXPECT_EQ(run(system), 0);
  EXPECT_EQ(dropped(system), 0u);
}

TEST_F(Connections, EveryCallbackOfAReceiverGetsAPushOnce) {
  StandaloneScript::scripts()["server"].run = [](auto& self) {
    for (int i = 0; self.sleep_for(1ms); ++i)
      self.push(Note{i, ""});
  };
  std::vector<std::int64_t> first;
  std::vector<std::int64_t> second;
  run_client([&](auto& self) {
    for (auto* got : {&first, &second})
      self.template on_push<Note>(
        "server", [got](const std::shared_ptr<const Note>& x) { got->push_back(x->number); });
    while (second.size() < 20)
      ASSERT_TRUE(self.sleep_for(1ms));
  });
  first.erase(first.begin(), std::find(first.begin(), first.end(), second.front()));
  EXPECT_EQ(first, second);
  EXPECT_EQ(std::adjacent_find(second.begin(), second.end(), std::greater_equal{}), second.end());
}

TEST_F(Connections, NothingIsKeptForAReceiverThatHasEnded) {
  std::atomic<int> rounds{0};
  StandaloneScript::scripts()["server"].run = [&](auto& self) {
    for (; self.sleep_for(1ms); ++rounds)
      for (int i = 0; i < 20; ++i)
        self.push(Note{i, ""});
  };
  std::atomic<bool> got{false};
  UnmanagedScript::scripts()["client"].start = [&](auto& self) {
    self.template on_push<Note>("server", [&](const std::shared_ptr<const Note>&) {
      got = true;
      throw std::runtime_error("enough");
    });
  };
  System system{
    architecture(server + subarchitecture("a") + "CPP UM client Unmanaged --push-limit 8\n"),
    without_restarts()};
  ASSERT_TRUE(system.start());
  EXPECT_TRUE(eventually([&] { return got.load(); }));
  // The server goes on pushing, but not to somebody who takes nothing.
  EXPECT_TRUE(eventually([&] {
    auto before = dropped(system);
    auto begin = rounds.load();
    return eventually([&] { return rounds > begin + 3; }) && dropped(system) == before;
  }));
  system.stop();
}

TEST_F(Connections, APushLimitHasToBeOneAtLeast) {
  System system{
    architecture(server + subarchitecture("a") + "CPP UM client Unmanaged --push-limit 0\n")};
  try {
    system.start();
    FAIL() << "it was started";
  } catch (const SystemError& e) {
    EXPECT_NE(std::string{e.what()}.find("--push-limit is 0"), std::string::npos);
  }
}

TEST_F(Connections, MistakesAreNamed) {
  StandaloneScript::scripts()["server"].start = [](auto& self) {
    self.template provide<Note>([] { return Note{}; });
  };
  run_client([](auto& self) {
    auto wrong_type = message_of([&] { self.template pull<Other>("server"); });
    EXPECT_NE(wrong_type.find("server provides Note"), std::string::npos) << wrong_type;
    auto misspelt = message_of([&] { self.template pull<Note>("sever"); });
    EXPECT_NE(misspelt.find("server"), std::string::npos) << misspelt;
    auto unknown = message_of([&] { self.template pull<Note>("zzzzzzzz"); });
    EXPECT_NE(unknown.find("COMPONENT line"), std::string::npos) << unknown;
  });
}

TEST_F(Connections, AServersExceptionReachesItsClient) {
  StandaloneScript::scripts()["server"].start = [](auto& self) {
    self.template provide<Note>([]() -> Note { throw std::runtime_error("lens cap on"); });
  };
  run_client([](auto& self) {
    auto first = message_of([&] { self.template pull<Note>("server"); });
    EXPECT_NE(first.find("lens cap on"), std::string::npos) << first;
    auto second = message_of([&] { self.template pull<Note>("server"); });
    EXPECT_NE(second.find("no result"), std::string::npos) << second;
  });
}

} // namespace

} // namespace castor::test
