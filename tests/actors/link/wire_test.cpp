#include "castor/actors/link/wire_table.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/node/component_wire.hpp"
#include "castor/actors/node/messages.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

namespace castor {

struct Letter {
  std::string text;
  std::vector<std::string> lines;
};
CASTOR_REFLECT(Letter, text, lines)

namespace {

using testing::HasSubstr;

/// Knows every type that was written, and no actors.
class Names : public WireNames {
public:
  std::uint64_t name_of(const caf::strong_actor_ptr&) override { return 0; }
  caf::strong_actor_ptr actor_of(std::uint64_t) override { return nullptr; }
  TypeDescriptorPtr type_of(std::uint64_t hash) override {
    auto i = types.find(hash);
    return i == types.end() ? nullptr : i->second;
  }

  std::map<std::uint64_t, TypeDescriptorPtr> types;
};

struct Written {
  Bytes head;
  std::vector<Bytes> contents;
};

class Wire : public testing::Test {
protected:
  template <class T>
  Written write(const T& x) {
    WireWriter out{names};
    EXPECT_TRUE(system_messages().write(caf::make_message(x).content(), out));
    Written result{out.take_head(), {}};
    for (auto& value : out.take_contents())
      result.contents.push_back(value.bytes());
    for (auto& type : out.take_types())
      names.types[type->hash] = type;
    return result;
  }

  caf::message read(const Written& x) {
    std::vector<ReceivedContentPtr> contents;
    for (auto& content : x.contents)
      contents.push_back(std::make_shared<ReceivedContent>(content));
    WireReader in{names, x.head, std::move(contents)};
    return system_messages().read(in);
  }

  template <class T>
  T there_and_back(const T& x) {
    auto message = read(write(x));
    EXPECT_TRUE(message.template match_elements<T>());
    return message.template get_as<T>(0);
  }

  std::string problem(const Written& x) {
    try {
      read(x);
    } catch (const DecodeError& e) {
      return e.what();
    }
    return "none";
  }

  Names names;
  ClientPtr client = std::make_shared<const Client>(Client{"reader", "vision", 3});
};

WriteRequest write_request(const ClientPtr& client, std::size_t size) {
  WriteRequest x;
  x.operation = Operation::overwrite;
  x.address = {"vision", "7"};
  x.value = Value::of(Letter{std::string(size, 'x'), {"a", "b"}});
  x.last_seen = 12;
  x.client = client;
  x.token = 99;
  x.life = EntryLife{Timestamp{5}, true, false};
  x.expected = true;
  return x;
}

enum class Colour : std::uint8_t { red, shade2 };

static_assert(detail::is_last_enumerator<Colour::shade2>);
static_assert(!detail::is_last_enumerator<Colour::red>);
static_assert(!detail::is_last_enumerator<Colour{2}>);
static_assert(!detail::is_last_enumerator<LockLevel::od>);

TEST_F(Wire, AWriteArrivesAsItWas) {
  for (std::size_t size : {10, 100'000}) {
    auto sent = write_request(client, size);
    auto x = there_and_back(sent);
    EXPECT_EQ(x.operation, sent.operation);
    EXPECT_EQ(x.address, sent.address);
    EXPECT_EQ(x.value, sent.value);
    EXPECT_EQ(x.value.as<Letter>()->lines, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(x.last_seen, sent.last_seen);
    EXPECT_EQ(*x.client, *client);
    EXPECT_EQ(x.client->subarchitecture, "vision");
    EXPECT_EQ(x.token, sent.token);
    EXPECT_EQ(x.life->time_to_live, Timestamp{5});
    EXPECT_TRUE(x.life->ephemeral);
    EXPECT_TRUE(x.expected);
  }
}

TEST_F(Wire, LargeContentsAreNotCopied) {
  auto x = write_request(client, 100'000);
  auto written = write(x);
  EXPECT_LT(written.head.size(), 200u);
  ASSERT_EQ(written.contents.size(), 1u);
  EXPECT_EQ(written.contents.front(), x.value.bytes());
}

TEST_F(Wire, APlanArrivesWithTheLivesAndTheRulesOfSupervision) {
  auto parsed =
    cast::parse_string("HOSTNAME spare 10.0.0.4\n"
                       "SUPERVISE vision rest_for_one RESTARTS 5 IN 30s DELAY 1s TO 2s\n"
                       "FAILOVER camera TO [spare]\n"
                       "SUBARCHITECTURE vision arm\nCPP WM W --journal full\nCPP TM T\n"
                       "CPP UM camera C --restart transient --isolate\n",
                       "test.cast");
  ASSERT_TRUE(parsed.ok()) << render(parsed.diagnostics);
  PartPlan plan;
  plan.architecture = *parsed.architecture;
  plan.processes = {{}, {"arm", "10.0.0.2", 7117, true}, {"spare", "10.0.0.4", 7200, false}};
  plan.placement = {{"vision_wm", 1}, {"camera", 2}};
  plan.incarnations = {{"camera", 3}, {"vision_wm", std::uint64_t{1} << 40}};
  plan.age = Timestamp{17};
  auto x = there_and_back(plan);
  EXPECT_EQ(x.incarnations, plan.incarnations);
  EXPECT_EQ(x.placement, plan.placement);
  ASSERT_EQ(x.processes.size(), 3u);
  EXPECT_TRUE(x.processes[1].lost);
  EXPECT_EQ(x.processes[2].name, "spare");
  EXPECT_EQ(x.processes[2].port, 7200);
  EXPECT_EQ(x.age, plan.age);
  EXPECT_EQ(x.architecture.supervision_of("vision"), plan.architecture.supervision_of("vision"));
  auto& camera = *x.architecture.component("camera");
  EXPECT_EQ(x.architecture.failover_of(camera), std::vector<std::string>{"10.0.0.4"});
  EXPECT_EQ(camera.option("restart")->value, "transient");
  EXPECT_EQ(x.architecture.component("vision_wm")->option("journal")->value, "full");
}

TEST_F(Wire, AnOutcomeIsEitherResultOrFailure) {
  auto good = there_and_back(Outcome<Version>{Version{7}});
  EXPECT_EQ(*good, 7u);
  auto bad = there_and_back(
    Outcome<Version>{Failure{FailureKind::inconsistent, "read it again", {"vision", "7"}}});
  EXPECT_EQ(bad.failure().kind, FailureKind::inconsistent);
  EXPECT_EQ(bad.failure().message, "read it again");
  EXPECT_EQ(bad.failure().address, (Address{"vision", "7"}));
}

TEST_F(Wire, AFilterKeepsItsCondition) {
  auto filter = overwritten<Letter>().anywhere().from("writer").where("text == \"x\"");
  auto x = there_and_back(Interest{"vision", 3, filter, true});
  EXPECT_EQ(x.filter, filter);
  EXPECT_EQ(x.id, 3u);
}

TEST_F(Wire, EventsArriveWithTheirReceivers) {
  ChangeEvent event;
  event.operation = Operation::overwrite;
  event.address = {"vision", "7"};
  event.source = "writer";
  event.type = descriptor_of<Letter>();
  event.version = 4;
  event.sequence = 5;
  event.changed = 1;
  event.coalesced = true;
  RoutedEvents sent{{{std::make_shared<const ChangeEvent>(event), {{"a", {1, 2}}, {"b", {3}}}}}};
  auto x = there_and_back(sent);
  ASSERT_EQ(x.events.size(), 1u);
  EXPECT_EQ(to_string(*x.events[0].event), to_string(event));
  EXPECT_TRUE(x.events[0].event->coalesced);
  EXPECT_EQ(x.events[0].receivers, sent.events[0].receivers);
}

TEST_F(Wire, PushesAreAskedForAndAcknowledged) {
  auto request = there_and_back(PushRequest{descriptor_of<Letter>(), 7, "a.reader"});
  EXPECT_EQ(request.type, descriptor_of<Letter>());
  EXPECT_EQ(request.limit, 7u);
  EXPECT_EQ(request.subscriber, "a.reader");
  auto taken = there_and_back(PushesTaken{"Letter", 3});
  EXPECT_EQ(taken.type, "Letter");
  EXPECT_EQ(taken.count, 3u);
}

TEST_F(Wire, AProbeKeepsItsWay) {
  DeadlockProbe sent;
  sent.path.push_back({WaitEdge::Kind::read, client, 5, Timestamp{6}, {"a", "x"}, "waits", 7});
  sent.round = 1;
  auto x = there_and_back(sent);
  ASSERT_EQ(x.path.size(), 1u);
  EXPECT_EQ(x.path[0], sent.path[0]);
  EXPECT_EQ(x.path[0].what, "waits");
  EXPECT_EQ(x.round, 1u);
}

TEST_F(Wire, FaultsArriveAsTheyWere) {
  auto journal = there_and_back(
    JournalFault{JournalFault::Kind::slowness, std::chrono::seconds{1}, Timestamp{20}});
  EXPECT_EQ(journal.kind, JournalFault::Kind::slowness);
  EXPECT_EQ(journal.duration, std::chrono::seconds{1});
  EXPECT_EQ(journal.by, Timestamp{20});
  EXPECT_EQ(there_and_back(JumpClock{Timestamp{-5}}).by, Timestamp{-5});
}

TEST_F(Wire, WhatIsNoMessageOfASystemDoesNotTravel) {
  WireWriter out{names};
  EXPECT_FALSE(system_messages().write(caf::make_message(std::string{"hello"}).content(), out));
  EXPECT_FALSE(
    system_messages().write(caf::make_message(StatusQuery{}, StatusQuery{}).content(), out));
}

TEST_F(Wire, WhatCannotBeIsRefused) {
  auto written = write(write_request(client, 100'000));
  auto unknown = written;
  unknown.head[0] = unknown.head[1] = 0xff;
  EXPECT_THAT(problem(unknown), HasSubstr("unknown kind 65535"));
  auto without_content = written;
  without_content.contents.clear();
  EXPECT_THAT(problem(without_content), HasSubstr("without its content"));
  auto too_much = written;
  too_much.contents.push_back({1});
  EXPECT_THAT(problem(too_much), HasSubstr("more contents than values"));
  auto other_content = written;
  other_content.contents.front().resize(3);
  EXPECT_NE(problem(other_content), "none");
  names.types.clear();
  EXPECT_THAT(problem(written), HasSubstr("was not introduced"));
}

TEST_F(Wire, NoiseIsAnErrorAndNothingWorse) {
  std::minstd_rand random{1};
  const std::vector<Written> good{write(write_request(client, 10)),
                                  write(Interest{"vision", 3, changed<Letter>(), true}),
                                  write(BatchRequest{"vision", {write_request(client, 10)}})};
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    auto x = good[static_cast<std::size_t>(i) % good.size()];
    for (auto n = 1 + random() % 4; n > 0; --n)
      x.head[random() % x.head.size()] = static_cast<std::uint8_t>(random());
    if (random() % 4 == 0)
      x.head.resize(random() % x.head.size());
    try {
      read(x);
    } catch (const DecodeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 5'000);
}

} // namespace

} // namespace castor
