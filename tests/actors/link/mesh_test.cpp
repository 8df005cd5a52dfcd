#include "castor/actors/link/mesh.hpp"

#include "castor/actors/link/link.hpp"
#include "castor/actors/link/listener.hpp"
#include "castor/actors/node/actor_system_config.hpp"
#include "castor/actors/node/component_wire.hpp"
#include "castor/actors/node/part_messages.hpp"
#include "castor/actors/node/well_known_actors.hpp"
#include "castor/tests/support/eventually.hpp"
#include "castor/tests/support/relay.hpp"
#include "castor/wm/memory/working_memory.hpp"
#include "castor/wm/values/reflect.hpp"

#include <caf/io/middleman.hpp>
#include <caf/scoped_actor.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace castor {

struct Box {
  std::string label;
  Bytes pixels;
};
CASTOR_REFLECT(Box, label, pixels)

struct Crate {
  Bytes pixels;
};
CASTOR_REFLECT(Crate, pixels)

namespace {

using namespace std::chrono_literals;
using test::eventually;
using testing::HasSubstr;

const WireTable& table() {
  static const auto result =
    WireTable::of<WriteRequest, BatchRequest, Outcome<std::vector<Version>>, ReadRequest,
                  QueryRequest, Outcome<Version>, Outcome<EntryPtr>, Outcome<std::vector<EntryPtr>>,
                  Subscribe, Outcome<Acknowledged>, ChangeNotice, StatusQuery,
                  WorkingMemoryStatus>();
  return result;
}

/// One process's part of a system, in a test that has two of them in one process.
struct Part {
  explicit Part(ProcessNumber number) : mesh(std::make_shared<Mesh>(system, messages, number)) {}

  ~Part() {
    caf::anon_send(link, CloseLink{"the test ends"});
    caf::anon_send_exit(listener, caf::exit_reason::user_shutdown);
    mesh->close();
    await_ends(system, {link, listener});
  }

  Hello hello() const {
    return {
      mesh->self() == 0 ? "run" : "robot", "test", 100u + mesh->self(), mesh->self(), 0, 0, 0};
  }

  LinkParts parts(ProcessNumber peer) {
    LinkParts x;
    x.mesh = mesh;
    x.peer = peer;
    x.peer_name = peer == 0 ? "run" : "robot";
    x.self = hello();
    x.options.patience = 3s;
    x.options.connecting = 500ms;
    // The coordinator says more at once than the robot takes.
    x.options.session.largest_message = mesh->self() == 0 ? 2'000'000 : 1'000'000;
    x.on_news = [this](const LinkNews& news) {
      if (news.state == LinkState::up)
        ++ups;
      else if (news.state == LinkState::lost)
        lost = true;
    };
    return x;
  }

  std::uint16_t listen() {
    auto socket = listen_at({"127.0.0.1", 0});
    auto port = port_of(socket);
    listener =
      spawn_listener(system, {socket, [this](const Hello& x) {
                                return std::variant<caf::actor, Refusal>{
                                  x.system == "test" ? std::variant<caf::actor, Refusal>{link}
                                                     : Refusal{"no system " + x.system, true}};
                              }});
    return port;
  }

  void connect(ProcessNumber peer, std::optional<Endpoint> to) {
    auto x = parts(peer);
    x.dial = std::move(to);
    // A relay is no node.
    x.trust = PeerTrust::anybody;
    link = spawn_link(std::move(x));
  }

  std::atomic<int> ups{0};
  std::atomic<bool> lost{false};
  ActorSystemConfig config{true};
  caf::actor_system system{config};
  std::shared_ptr<PartMessages> messages = std::make_shared<PartMessages>(table());
  std::shared_ptr<Mesh> mesh;
  caf::actor link;
  caf::actor listener;
};

/// A coordinator, and a robot with a working memory.
class TwoProcesses : public testing::Test {
protected:
  TwoProcesses() {
    WorkingMemoryOptions options;
    options.subarchitecture = "vision";
    options.writers = {"*"};
    options.epoch = std::chrono::steady_clock::now();
    wm = robot.system.spawn(working_memory, options);
    robot.mesh->set_well_known(part_agent_number, caf::actor_cast<caf::strong_actor_ptr>(wm));
    robot.connect(0, std::nullopt);
    relay = std::make_unique<test::Relay>(robot.listen());
    run.connect(1, Endpoint{"127.0.0.1", relay->port()});
    remote = caf::actor_cast<WorkingMemoryActor>(run.mesh->well_known(1, part_agent_number));
  }

  ~TwoProcesses() override { caf::anon_send_exit(wm, caf::exit_reason::user_shutdown); }

  template <class Reply, class Request>
  Reply ask(const Request& request) {
    Reply result;
    self->request(remote, 10s, request)
      .receive([&](const Reply& x) { result = x; },
               [&](const caf::error& e) {
                 ADD_FAILURE() << run.system.render(e);
                 throw std::runtime_error("no reply");
               });
    return result;
  }

  Outcome<Version> add(const std::string& id, Box box) {
    WriteRequest x;
    x.address = {"vision", id};
    x.value = Value::of(std::move(box));
    x.client = client;
    return ask<Outcome<Version>>(x);
  }

  Outcome<EntryPtr> read(const std::string& id) {
    return ask<Outcome<EntryPtr>>(ReadRequest{{"vision", id}, {client, ++number, 1s}});
  }

  Part robot{1};
  Part run{0};
  WorkingMemoryActor wm;
  std::unique_ptr<test::Relay> relay;
  caf::scoped_actor self{run.system};
  WorkingMemoryActor remote;
  ClientPtr client = std::make_shared<const Client>(Client{"tester", "vision", 1});
  WaitNumber number = 0;
};

TEST_F(TwoProcesses, AWorkingMemoryIsUsedFromAfar) {
  EXPECT_EQ(*add("x", {"box", Bytes(100'000, 7)}), 0u);
  auto entry = read("x");
  ASSERT_TRUE(entry);
  EXPECT_EQ((*entry)->value.as<Box>()->label, "box");
  EXPECT_EQ((*entry)->value.as<Box>()->pixels, Bytes(100'000, 7));
  EXPECT_EQ((*entry)->writer, "tester");
  auto again = add("x", {});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.failure().kind, FailureKind::already_exists);
}

TEST_F(TwoProcesses, EventsArriveInOrder) {
  ASSERT_TRUE(ask<Outcome<Acknowledged>>(Subscribe{5, any_change()}));
  for (int i = 0; i < 100; ++i)
    add(std::to_string(i), {});
  for (int i = 0; i < 100; ++i)
    self->receive([&](const ChangeNotice& x) {
      EXPECT_EQ(x.event->address.id, std::to_string(i));
      EXPECT_EQ(x.event->type_name(), "Box");
      EXPECT_EQ(x.filters, FilterIds{5});
    });
}

TEST_F(TwoProcesses, NothingIsLostWithAConnection) {
  ASSERT_TRUE(ask<Outcome<Acknowledged>>(Subscribe{5, any_change()}));
  for (int i = 0; i < 50; ++i) {
    if (i % 5 == 0)
      relay->cut();
    EXPECT_EQ(*add(std::to_string(i), {"x", Bytes(static_cast<std::size_t>(i) * 5000)}), 0u);
  }
  for (int i = 0; i < 50; ++i)
    self->receive(
      [&](const ChangeNotice& x) { EXPECT_EQ(x.event->address.id, std::to_string(i)); });
  EXPECT_GT(run.ups, 5);
  EXPECT_FALSE(run.lost);
}

TEST_F(TwoProcesses, ALargeValueOfANewTypeIsReadHoweverMuchWaitsBeforeIt) {
  add("x", {});
  relay->freeze(true);
  const int waiting = 10'000;
  for (int i = 0; i < waiting; ++i) {
    WriteRequest x;
    x.address = {"vision", std::to_string(i)};
    x.value = Value::of(Box{"", Bytes(1000)});
    x.client = client;
    self->send(remote, x);
  }
  WriteRequest large;
  large.address = {"vision", "large"};
  large.value = Value::of(Crate{Bytes(200'000)});
  large.client = client;
  caf::scoped_actor other{run.system};
  auto answer = other->request(remote, 20s, large);
  relay->freeze(false);
  answer.receive([](const Outcome<Version>& x) { EXPECT_TRUE(x); },
                 [&](const caf::error& e) { ADD_FAILURE() << run.system.render(e); });
  EXPECT_TRUE(read(std::to_string(waiting - 1)));
}

TEST_F(TwoProcesses, AValueComesOnceForAllWhoReadIt) {
  const std::size_t size = 500'000;
  for (Version version = 0; version < 5; ++version) {
    WriteRequest x;
    x.operation = version == 0 ? Operation::add : Operation::overwrite;
    x.address = {"vision", "x"};
    x.value = Value::of(Box{std::to_string(version), Bytes(size, 7)});
    x.client = client;
    if (version > 0)
      x.last_seen = version - 1;
    ASSERT_EQ(*ask<Outcome<Version>>(x), version);
    auto before = run.mesh->links().at(0).bytes_in;
    // All at once, and one afterwards.
    std::vector<std::unique_ptr<caf::scoped_actor>> readers;
    auto request = [&] {
      readers.push_back(std::make_unique<caf::scoped_actor>(run.system));
      return (*readers.back())
        ->request(remote, 10s, ReadRequest{x.address, {client, ++number, 10s}});
    };
    std::vector<decltype(request())> answers;
    for (int i = 0; i < 8; ++i)
      answers.push_back(request());
    std::vector<std::shared_ptr<const Box>> found;
    for (auto& answer : answers)
      answer.receive(
        [&](const Outcome<EntryPtr>& y) {
          EXPECT_EQ((*y)->version, version);
          found.push_back((*y)->value.as<Box>());
        },
        [&](const caf::error& e) { ADD_FAILURE() << run.system.render(e); });
    found.push_back((*read("x"))->value.as<Box>());
    ASSERT_EQ(found.size(), 9u);
    for (auto& box : found)
      EXPECT_EQ(box, found[0]);
    EXPECT_EQ(found[0]->label, std::to_string(version));
    EXPECT_LT(run.mesh->links().at(0).bytes_in - before, size + 10'000);
  }
}

TEST_F(TwoProcesses, TheEndOfAnActorIsNoticed) {
  add("x", {});
  self->monitor(remote);
  caf::anon_send_exit(wm, caf::exit_reason::user_shutdown);
  bool down = false;
  self->receive([&](const caf::down_msg& x) { down = x.source == remote.address(); },
                caf::after(10s) >> [] {});
  EXPECT_TRUE(down);
  bool failed = false;
  self->request(remote, 10s, StatusQuery{})
    .receive([](const WorkingMemoryStatus&) {}, [&](const caf::error&) { failed = true; });
  EXPECT_TRUE(failed);
}

TEST_F(TwoProcesses, AnActorCanBeEndedFromAfar) {
  caf::scoped_actor there{robot.system};
  there->monitor(wm);
  self->send_exit(remote, caf::exit_reason::user_shutdown);
  bool down = false;
  there->receive([&](const caf::down_msg&) { down = true; }, caf::after(10s) >> [] {});
  EXPECT_TRUE(down);
}

TEST_F(TwoProcesses, WhoeverIsOutOfReachForTooLongIsLostAndWillNotAnswer) {
  add("x", {});
  self->monitor(remote);
  relay->freeze(true);
  auto open = self->request(remote, 30s, StatusQuery{});
  relay->stop();
  bool down = false;
  self->receive([&](const caf::down_msg&) { down = true; }, caf::after(20s) >> [] {});
  EXPECT_TRUE(down);
  EXPECT_TRUE(eventually([&] { return run.lost.load(); }));
  caf::error problem;
  open.receive([](const WorkingMemoryStatus&) {}, [&](const caf::error& e) { problem = e; });
  EXPECT_EQ(problem, caf::sec::request_receiver_down);
}

TEST_F(TwoProcesses, WhatIsTooLargeForALinkFailsAloneInTheWritersProcess) {
  auto refused = add("x", {"", Bytes(3'000'000)});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().kind, FailureKind::too_large);
  for (auto part : {"vision/x", "tester", "3000", "2000000"})
    EXPECT_THAT(refused.failure().message, HasSubstr(part));
  BatchRequest batch{"vision", {}};
  for (auto id : {"a", "b"}) {
    WriteRequest x;
    x.address = {"vision", id};
    x.value = Value::of(Box{"", Bytes(1'500'000)});
    x.client = client;
    batch.writes.push_back(x);
  }
  auto none = ask<Outcome<std::vector<Version>>>(batch);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.failure().kind, FailureKind::too_large);
  EXPECT_EQ(*add("y", {"", Bytes(900'000)}), 0u);
  EXPECT_FALSE(run.lost);
  EXPECT_EQ(run.ups, 1);
}

TEST_F(TwoProcesses, WhatALinkDoesNotTakeIsAnErrorForItsSenderAlone) {
  WriteRequest x;
  x.address = {"vision", "x"};
  x.value = Value::of(Box{"", Bytes(1'500'000)});
  x.client = client;
  std::string problem;
  self->request(remote, 10s, x)
    .receive([](const Outcome<Version>&) {},
             [&](const caf::error& e) { problem = run.system.render(e); });
  EXPECT_THAT(problem, HasSubstr("more than a link takes"));
  EXPECT_EQ(*add("y", {}), 0u);
  EXPECT_FALSE(run.lost);
  EXPECT_EQ(run.ups, 1);
}

TEST_F(TwoProcesses, AnEntryThatIsTooLargeToBeReadFromAfarFailsAlone) {
  WriteRequest x;
  x.address = {"vision", "x"};
  x.value = Value::of(Box{"", Bytes(1'500'000)});
  x.client = client;
  caf::scoped_actor here{robot.system};
  here->request(wm, 10s, x)
    .receive([](const Outcome<Version>& y) { EXPECT_TRUE(y); },
             [](const caf::error&) { ADD_FAILURE(); });
  auto refused = read("x");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().kind, FailureKind::too_large);
  EXPECT_THAT(refused.failure().message, HasSubstr("vision/x"));
  EXPECT_FALSE(run.lost);
}

TEST_F(TwoProcesses, WhatItsWorkingMemoryDoesNotTakeIsNotSent) {
  run.messages->set_largest_value(make_actor_name(1, part_agent_number), "vision", 1000);
  auto refused = add("x", {"", Bytes(2000)});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.failure().message, HasSubstr("--largest-entry"));
  EXPECT_EQ(*add("y", {"", Bytes(500)}), 0u);
  // It has not reached the other process.
  EXPECT_LT(run.mesh->links().at(0).bytes_out, 2000u);
}

TEST_F(TwoProcesses, DamagedMessagesAreRefusedOrUnderstoodAndHarmNoActor) {
  ASSERT_EQ(*add("x", {"label", Bytes(20)}), 0u);
  WriteRequest write;
  write.address = {"vision", "y"};
  write.value = Value::of(Box{"other", Bytes(10)});
  write.client = client;
  Subscribe subscription;
  subscription.id = 1;
  auto requests = {
    caf::make_message(write),
    caf::make_message(BatchRequest{"vision", {write, write}}),
    caf::make_message(ReadRequest{{"vision", "x"}, {client, ++number, 1s}}),
    caf::make_message(QueryRequest{}),
    caf::make_message(subscription),
    caf::make_message(StatusQuery{}),
  };
  std::vector<IncomingMessage> sound;
  for (auto& x : requests)
    // Asynchronous, as a request, and as an answer.
    for (std::uint64_t id : {0x1000000000000000u, 0x1000000000000007u, 0x9000000000000007u}) {
      WireWriter out{run.mesh->names()};
      // As LinkPort::send begins a message for an actor.
      out(std::uint8_t{0}, run.mesh->names().name_of(caf::actor_cast<caf::strong_actor_ptr>(self)),
          static_cast<std::uint32_t>(part_agent_number), id);
      ASSERT_TRUE(table().write(x.content(), out));
      IncomingMessage message{out.take_head(), {}};
      for (auto& value : out.take_contents())
        message.contents.push_back(std::make_shared<ReceivedContent>(value.bytes()));
      sound.push_back(std::move(message));
    }
  std::mt19937 random{1};
  auto up_to = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>{0, n}(random);
  };
  std::size_t refused = 0;
  constexpr std::size_t count = 20'000;
  for (std::size_t i = 0; i < count; ++i) {
    auto message = sound[up_to(sound.size() - 1)];
    // But for what it is: an actor may be ended from afar.
    for (auto changes = up_to(2) + 1; changes > 0; --changes)
      message.head[1 + up_to(message.head.size() - 2)] = static_cast<std::uint8_t>(up_to(255));
    try {
      robot.mesh->receive(0, std::move(message), nullptr);
    } catch (const DecodeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, count / 10);
  EXPECT_LT(refused, count);
  // Answers to what was asked in its name may have come to the tester.
  caf::scoped_actor neighbour{robot.system};
  neighbour->request(wm, 10s, ReadRequest{{"vision", "x"}, {client, ++number, 1s}})
    .receive([](const Outcome<EntryPtr>& x) { EXPECT_EQ((*x)->address.id, "x"); },
             [&](const caf::error& e) { ADD_FAILURE() << robot.system.render(e); });
}

TEST_F(TwoProcesses, SilenceIsNoticedAndOvercome) {
  add("x", {});
  relay->freeze(true);
  EXPECT_TRUE(eventually([&] { return relay->connections() > 1; }));
  relay->freeze(false);
  EXPECT_TRUE(read("x"));
}

TEST_F(TwoProcesses, AConnectionThatArrivesLateDisturbsNobody) {
  add("x", {});
  relay->freeze(true);
  relay->cut();
  auto before = relay->connections();
  ASSERT_TRUE(eventually([&] { return relay->connections() > before; }));
  // What was said over that connection is still on its way when the next one is there.
  relay->freeze_present();
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(*add(std::to_string(i), {}), 0u);
  ASSERT_TRUE(eventually([&] { return robot.mesh->links().at(0).unacknowledged == 0; }));
  int ups = run.ups;
  relay->freeze(false);
  ASSERT_TRUE(eventually([&] { return relay->open() == 1; }));
  for (int i = 50; i < 100; ++i)
    EXPECT_EQ(*add(std::to_string(i), {}), 0u);
  EXPECT_FALSE(run.lost);
  EXPECT_EQ(run.ups, ups);
}

} // namespace

} // namespace castor
