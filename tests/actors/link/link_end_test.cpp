#include "castor/actors/link/link_end.hpp"

#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/part_messages.hpp"
#include "castor/actors/node/well_known_actors.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/tools/simulation/testing_system.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

/// One end of a link, with the world around it in the test's hands.
struct End : LinkDriver {
  End(caf::actor_system& system, ProcessNumber self, ProcessNumber peer, Clock::time_point& clock)
    : time(clock), mesh(std::make_shared<Mesh>(
                     system, std::make_shared<PartMessages>(system_messages()), self)) {
    receiver = system.spawn([this](caf::event_based_actor* actor) -> caf::behavior {
      return {[this](const RetractTask& x) { heard.push_back(x.id); },
              [this, actor](const LockQuery& x) {
                asked.push_back(x.address.id);
                auto promise = actor->make_response_promise<Outcome<LockStatus>>();
                if (x.address.id == "later")
                  unanswered.push_back(promise);
                else
                  promise.deliver(Outcome<LockStatus>{LockStatus{}});
                return promise;
              }};
    });
    mesh->set_well_known(part_agent_number, caf::actor_cast<caf::strong_actor_ptr>(receiver));
    outlet = system.spawn(
      [this]() -> caf::behavior { return {[this](LinkMessage& x) { end->send(std::move(x)); }}; });
    LinkParts parts;
    parts.mesh = mesh;
    parts.peer = peer;
    parts.self = {std::to_string(self), "s", 100u + self, self, peer, 0, 0, 0};
    if (self < peer)
      parts.dial = Endpoint{"there", 1};
    auto record = std::make_shared<LinkRecord>(peer);
    mesh->add_link(outlet, record);
    end.emplace(*this, std::move(parts), record, 1);
    end->begin();
  }

  Clock::time_point now() const override { return time; }
  void remind(LinkReminder of, std::chrono::milliseconds after) override {
    reminders.emplace(time + after, of);
  }
  void dial() override { ++dials; }
  void listen_to(Connection) override {}
  void close(Connection x) override { closed.push_back(x); }
  std::vector<char>& output(Connection) override { return out; }
  void flush(Connection) override {}
  void quit() override {}
  caf::execution_unit* context() override { return nullptr; }

  Clock::time_point& time;
  std::shared_ptr<Mesh> mesh;
  caf::actor receiver;
  caf::actor outlet;
  std::vector<std::string> heard;
  std::vector<std::string> asked;
  /// Requests that the test answers.
  std::vector<caf::typed_response_promise<Outcome<LockStatus>>> unanswered;
  std::vector<char> out;
  std::vector<Connection> closed;
  int dials = 0;
  int writes = 0;
  std::multimap<Clock::time_point, LinkReminder> reminders;
  std::optional<LinkEnd> end;
};

class LinkEndTest : public testing::Test, protected simulation::TestingSystem {
protected:
  /// Between the coordinator and another process, or between two others.
  explicit LinkEndTest(ProcessNumber first = 0, ProcessNumber second = 1)
    : first_(first), second_(second) {
    connect(1);
  }

  ~LinkEndTest() override {
    for (auto* x : {&a, &b}) {
      x->mesh->close();
      caf::anon_send_exit(x->receiver, caf::exit_reason::user_shutdown);
      caf::anon_send_exit(x->outlet, caf::exit_reason::user_shutdown);
    }
    run();
  }

  void run() {
    while (scheduler.try_run_once()) {
    }
  }

  void carry(LinkDriver::Connection x) {
    auto move = [&](End& from, End& to) {
      auto words = std::exchange(from.out, {});
      from.writes += words.empty() ? 0 : 1;
      if (!words.empty())
        to.end->receive(x, {reinterpret_cast<const std::uint8_t*>(words.data()), words.size()});
      return !words.empty();
    };
    while (move(a, b) || move(b, a))
      run();
  }

  /// As a listener does: what dialled says who it is first.
  void connect(LinkDriver::Connection x) {
    a.end->dialled(x);
    Bytes said{a.out.begin(), a.out.end()};
    a.out.clear();
    auto hello = std::get<Hello>(*read_greeting(said));
    b.end->adopt(x, std::make_shared<Channel>(std::nullopt, SecureChannel::Role::accepts), hello,
                 std::move(said));
    carry(x);
  }

  void say(const std::string& what) { say(a, second_, what); }

  void say(const End& from, ProcessNumber to, const std::string& what) {
    caf::anon_send(caf::actor_cast<caf::actor>(from.mesh->well_known(to, part_agent_number)),
                   RetractTask{what});
    run();
  }

  /// A request of `a` that is not answered until `answer`.
  void ask() {
    a.mesh->well_known(second_, part_agent_number)
      ->enqueue(caf::actor_cast<caf::strong_actor_ptr>(a.receiver),
                caf::make_message_id(caf::message_id::default_async_value + 1),
                caf::make_message(LockQuery{{"s", "later"}}), nullptr);
    run();
    carry(1);
    ASSERT_EQ(b.unanswered.size(), 1u);
  }

  void answer() {
    std::exchange(b.unanswered, {}).front().deliver(Outcome<LockStatus>{LockStatus{}});
    run();
    carry(1);
  }

  /// Lets time pass, with what both ends want to be reminded of, and what they say to each other
  /// unless they are apart.
  void pass(std::chrono::milliseconds duration, bool apart = false) {
    for (auto end = time + duration; time < end; time += 1ms) {
      for (auto* x : {&a, &b})
        while (!x->reminders.empty() && x->reminders.begin()->first <= time)
          x->end->remind(x->reminders.extract(x->reminders.begin()).mapped());
      if (!apart)
        carry(1);
    }
  }

  const ProcessNumber first_, second_;
  LinkDriver::Clock::time_point time = LinkDriver::Clock::time_point{} + 1h;
  End a{system, first_, second_, time};
  End b{system, second_, first_, time};
};

/// A link that the loss of a process is not noticed by.
class LinkAtRest : public LinkEndTest {
protected:
  LinkAtRest() : LinkEndTest(1, 2) { pass(10s); }
};

TEST_F(LinkEndTest, HearsWhatIsSaid) {
  say("one");
  carry(1);
  EXPECT_THAT(b.heard, ElementsAre("one"));
}

TEST_F(LinkEndTest, AfterAGapNothingIsHeardBeforeThereIsAnotherConnection) {
  b.end->inject({LinkFault::Kind::silence, 100ms});
  say("lost");
  carry(1);
  time += 200ms;
  say("after the gap");
  carry(1);
  EXPECT_THAT(b.heard, IsEmpty());
  b.end->remind(LinkReminder::tick);
  EXPECT_THAT(b.closed, ElementsAre(1));
  a.end->closed(1);
  connect(2);
  EXPECT_THAT(b.heard, ElementsAre("lost", "after the gap"));
}

TEST_F(LinkEndTest, AtRestTheCoordinatorHearsOften) {
  pass(10s);
  a.writes = b.writes = 0;
  pass(10s);
  EXPECT_NEAR(b.writes, 20, 2);
  EXPECT_NEAR(a.writes, 2, 1);
  EXPECT_THAT(a.closed, IsEmpty());
  EXPECT_THAT(b.closed, IsEmpty());
}

TEST_F(LinkEndTest, AtRestTheCoordinatorNoticesSoonThatNobodyIsThere) {
  pass(10s);
  pass(1500ms, true);
  EXPECT_THAT(a.closed, ElementsAre(1));
  EXPECT_THAT(b.closed, IsEmpty());
  pass(4700ms, true);
  EXPECT_THAT(b.closed, ElementsAre(1));
}

TEST_F(LinkEndTest, AtRestTheCoordinatorsAbsenceIsNoticedSoonByWhoWantsSomethingOfIt) {
  pass(10s);
  caf::anon_send(caf::actor_cast<caf::actor>(b.mesh->well_known(first_, part_agent_number)),
                 RetractTask{"lost"});
  run();
  pass(1300ms, true);
  EXPECT_THAT(b.closed, ElementsAre(1));
}

TEST_F(LinkAtRest, HardlyWritesAndStays) {
  a.writes = b.writes = 0;
  pass(60s);
  EXPECT_NEAR(a.writes, 3, 1);
  EXPECT_NEAR(b.writes, 3, 1);
  EXPECT_THAT(a.closed, IsEmpty());
  EXPECT_THAT(b.closed, IsEmpty());
}

TEST_F(LinkAtRest, IsWokenByAMessage) {
  for (int i = 0; i < 50; ++i) {
    pass(std::chrono::milliseconds{3000 + 77 * i});
    say(std::to_string(i));
    carry(1);
    ASSERT_EQ(b.heard.back(), std::to_string(i));
    a.writes = b.writes = 0;
    pass(1000ms);
    EXPECT_NEAR(a.writes, 10, 2);
    EXPECT_NEAR(b.writes, 10, 2) << "acknowledgements, and signs of life";
  }
  EXPECT_THAT(a.closed, IsEmpty());
  EXPECT_THAT(b.closed, IsEmpty());
}

TEST_F(LinkAtRest, NoticesSoonThatAMessageIsNotHeard) {
  say("lost");
  pass(900ms, true);
  EXPECT_THAT(a.closed, IsEmpty());
  pass(300ms, true);
  EXPECT_THAT(a.closed, ElementsAre(1));
}

TEST_F(LinkAtRest, NoticesLaterThatNobodyIsThere) {
  pass(11s, true);
  EXPECT_THAT(a.closed, IsEmpty());
  pass(10s, true);
  EXPECT_THAT(a.closed, ElementsAre(1));
  EXPECT_THAT(b.closed, ElementsAre(1));
}

TEST_F(LinkAtRest, WritesMoreOftenWhileAnAnswerIsAwaited) {
  ask();
  pass(10s);
  a.writes = b.writes = 0;
  pass(60s);
  EXPECT_NEAR(a.writes, 12, 1);
  EXPECT_NEAR(b.writes, 12, 1);
  answer();
  pass(10s);
  a.writes = b.writes = 0;
  pass(60s);
  EXPECT_NEAR(a.writes, 3, 1);
  EXPECT_NEAR(b.writes, 3, 1);
  EXPECT_THAT(a.closed, IsEmpty());
  EXPECT_THAT(b.closed, IsEmpty());
}

TEST_F(LinkAtRest, NoticesWithinSixSecondsThatNobodyIsThereToAnswer) {
  ask();
  // Just after both have begun to rest.
  pass(3s);
  pass(6s, true);
  EXPECT_THAT(a.closed, ElementsAre(1));
  EXPECT_THAT(b.closed, ElementsAre(1));
}

TEST_F(LinkAtRest, NoticesWithin21SecondsAConnectionThatIsNoMoreThePeers) {
  // As if the peer's machine had no power for a moment: nothing tells this side.
  b.end->closed(1);
  say(b, first_, "said meanwhile");
  pass(21s, true);
  EXPECT_THAT(a.closed, ElementsAre(1));
  EXPECT_GT(a.dials, 1);
  // What was written to nobody.
  a.out.clear();
  connect(2);
  carry(2);
  EXPECT_THAT(a.heard, ElementsAre("said meanwhile"));
}

TEST_F(LinkAtRest, NoticesAnInjectedSilenceSoon) {
  b.end->inject({LinkFault::Kind::silence, 3s});
  pass(1300ms);
  EXPECT_THAT(b.closed, ElementsAre(1));
}

TEST_F(LinkEndTest, ARequestOfSomebodyUnknownHereIsNotDelivered) {
  // What a working memory passes on for a component in a process that `b` has lost.
  a.mesh->add_link(a.outlet, std::make_shared<LinkRecord>(2));
  auto lost = a.mesh->names().actor_of(make_actor_name(2, 20));
  auto to = a.mesh->well_known(1, part_agent_number);
  auto send = [&](caf::message_id id, const std::string& what) {
    to->enqueue(lost, id, caf::make_message(LockQuery{{"s", what}}), nullptr);
  };
  send(caf::make_message_id(), "message");
  send(caf::make_message_id(caf::message_id::default_async_value + 1), "request");
  run();
  carry(1);
  EXPECT_THAT(b.asked, ElementsAre("message"));
}

} // namespace

} // namespace castor::test
