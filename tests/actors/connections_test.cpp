#include "castor/tests/actors/scripted.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

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
    System system{architecture(server + subarchitecture("a") + "CPP UM client Unmanaged\n")};
    EXPECT_EQ(run(system), 0) << system.summary().components.back().failure;
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
