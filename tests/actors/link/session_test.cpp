#include "castor/actors/link/session.hpp"

#include "castor/actors/link/link_bytes.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <string>

namespace castor {

struct Picture {
  Bytes pixels;
};
CASTOR_REFLECT(Picture, pixels)

namespace {

using namespace std::chrono_literals;

using testing::ElementsAre;
using testing::HasSubstr;

Bytes bytes(std::string_view text) {
  return {text.begin(), text.end()};
}

std::string text(const Bytes& x) {
  return {x.begin(), x.end()};
}

std::string everything(LinkSession& session) {
  std::vector<char> out;
  session.produce(out, 1 << 30);
  return {out.begin(), out.end()};
}

std::span<const std::uint8_t> as_bytes(std::string_view x) {
  return {reinterpret_cast<const std::uint8_t*>(x.data()), x.size()};
}

/// Takes heads in the order of their arrival.
std::vector<std::string> heads(LinkSession& to, std::string_view data) {
  std::vector<std::string> result;
  to.receive(as_bytes(data), [&](IncomingMessage x) { result.push_back(text(x.head)); });
  return result;
}

Value picture(std::size_t size, std::uint8_t colour = 0) {
  return Value::of(Picture{Bytes(size, colour)});
}

TEST(LinkSession, MessagesArriveWithTheirContents) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("first")});
  a.send({bytes(""), {picture(5000, 1), picture(0), picture(200'000, 2)}});
  std::vector<IncomingMessage> got;
  b.receive(as_bytes(everything(a)), [&](IncomingMessage x) { got.push_back(std::move(x)); });
  ASSERT_EQ(got.size(), 2u);
  EXPECT_EQ(text(got[0].head), "first");
  EXPECT_TRUE(got[0].contents.empty());
  EXPECT_TRUE(got[1].head.empty());
  ASSERT_EQ(got[1].contents.size(), 3u);
  EXPECT_EQ(got[1].contents[0]->bytes(), picture(5000, 1).bytes());
  EXPECT_EQ(got[1].contents[1]->bytes(), picture(0).bytes());
  EXPECT_EQ(got[1].contents[2]->bytes(), picture(200'000, 2).bytes());
}

TEST(LinkSession, ShortMessagesPassLongOnes) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("long"), {picture(1'000'000)}});
  a.send({bytes("short")});
  EXPECT_THAT(heads(b, everything(a)), ElementsAre("short", "long"));
}

TEST(LinkSession, MessagesOfOneLaneKeepTheirOrder) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("long"), {picture(1'000'000)}, 7});
  a.send({bytes("short"), {}, 7});
  a.send({bytes("other"), {}, 8});
  EXPECT_THAT(heads(b, everything(a)), ElementsAre("other", "long", "short"));
}

TEST(LinkSession, WhatOthersNeedComesFirst) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("long"), {picture(100'000)}, 7});
  for (int i = 0; i < 1000; ++i)
    a.send({Bytes(1000, 'x')});
  a.send({.head = bytes("small"), .comes_first = true});
  a.send({.head = Bytes(200'000, 'y'), .comes_first = true});
  a.send({bytes("other"), {}, 7});
  EXPECT_EQ(a.waiting(), 1004u);
  auto order = heads(b, everything(a));
  ASSERT_EQ(order.size(), 1004u);
  EXPECT_EQ(order[0], "small");
  EXPECT_EQ(order[1], std::string(200'000, 'y'));
  EXPECT_EQ(a.waiting(), 0u);
}

TEST(LinkSession, LongMessagesTakeTurns) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("ten chunks"), {picture(640'000)}});
  a.send({bytes("two chunks"), {picture(100'000)}});
  EXPECT_THAT(heads(b, everything(a)), ElementsAre("two chunks", "ten chunks"));
}

TEST(LinkSession, AFloodOfShortMessagesDoesNotHoldUpALongOne) {
  LinkSession a;
  LinkSession b;
  a.send({bytes("long"), {picture(100'000)}});
  for (int i = 0; i < 1000; ++i)
    a.send({Bytes(1000, 'x')});
  auto order = heads(b, everything(a));
  auto at = std::find(order.begin(), order.end(), "long") - order.begin();
  EXPECT_LT(at, 200);
}

TEST(LinkSession, StopsWhenThePeerAcknowledgesNothing) {
  LinkSession a{{.window = 300'000}};
  LinkSession b{{.window = 300'000}};
  for (int i = 0; i < 100; ++i)
    a.send({Bytes(10'000, 'x')});
  auto first = everything(a);
  EXPECT_LT(first.size(), 320'000u);
  EXPECT_EQ(everything(a), "");
  EXPECT_FALSE(a.has_output());
  auto got = heads(b, first).size();
  while (got < 100) {
    b.remind(100ms);
    heads(a, everything(b));
    auto more = heads(b, everything(a)).size();
    ASSERT_GT(more, 0u);
    got += more;
  }
  EXPECT_EQ(got, 100u);
}

TEST(LinkSession, TellsWhenAMessageHasArrived) {
  LinkSession a;
  LinkSession b;
  int arrived = 0;
  a.send({bytes("x"), {picture(100'000)}, 0, [&] { ++arrived; }});
  heads(b, everything(a));
  EXPECT_EQ(arrived, 0);
  b.remind(100ms);
  heads(a, everything(b));
  EXPECT_EQ(arrived, 1);
  EXPECT_EQ(a.unacknowledged(), 0u);
}

TEST(LinkSession, AReminderSaysWhenTheNextSignOfLifeComes) {
  LinkSession a;
  LinkSession b;
  EXPECT_FALSE(a.has_output());
  a.remind(100ms);
  auto said = everything(a);
  EXPECT_FALSE(said.empty());
  EXPECT_THAT(heads(b, said), ElementsAre());
  EXPECT_EQ(b.peer_promise(), 100ms);
  EXPECT_EQ(everything(a), "");
}

TEST(LinkSession, AnAnnouncementIsWrittenBesideWhatElseThereIs) {
  LinkSession a;
  LinkSession b;
  b.send({bytes("x")});
  heads(a, everything(b));
  a.remind(100ms);
  heads(b, everything(a));
  EXPECT_EQ(b.peer_promise(), 0ms) << "the acknowledgement was sign enough";
  b.send({bytes("y")});
  heads(a, everything(b));
  a.announce(5s, true);
  heads(b, everything(a));
  EXPECT_EQ(b.peer_promise(), 5s);
  EXPECT_TRUE(b.peer_awaits());
  EXPECT_EQ(b.unacknowledged(), 0u);
  b.resume(2);
  EXPECT_EQ(b.peer_promise(), 0ms);
  EXPECT_FALSE(b.peer_awaits());
}

TEST(LinkSession, AGoodbyeComesLast) {
  LinkSession a;
  LinkSession b;
  a.say_goodbye("the system ends");
  a.send({bytes("last words")});
  EXPECT_THAT(heads(b, everything(a)), ElementsAre("last words"));
  EXPECT_EQ(b.goodbye(), "the system ends");
}

std::string problem(const SessionLimits& limits, std::string_view data) {
  LinkSession session{limits};
  try {
    heads(session, data);
  } catch (const LinkError& e) {
    return e.what();
  }
  return "none";
}

/// A frame that is a whole message of these words, without bytes after them.
std::string message_of(const std::vector<std::uint64_t>& words) {
  std::vector<char> out;
  link_bytes::put(out, static_cast<std::uint32_t>(1 + 4 + 1 + 4 + 8 * words.size()));
  link_bytes::put(out, std::uint8_t{0});
  link_bytes::put(out, std::uint32_t{1});
  link_bytes::put(out, std::uint8_t{3});
  link_bytes::put(out, static_cast<std::uint32_t>(words.size()));
  for (auto word : words)
    link_bytes::put(out, word);
  return {out.begin(), out.end()};
}

TEST(LinkSession, RefusesWhatCannotBe) {
  using namespace std::string_view_literals;
  SessionLimits x{.chunk = 1024, .largest_message = 4096};
  EXPECT_THAT(problem(x, "\xff\xff\xff\x7f"sv), HasSubstr("a frame of 2147483647 bytes"));
  EXPECT_THAT(problem(x, "\0\0\0\0"sv), HasSubstr("a frame of 0 bytes"));
  EXPECT_THAT(problem(x, "\1\0\0\0\x9"sv), HasSubstr("unknown kind"));
  EXPECT_THAT(problem(x, "\3\0\0\0\1ab"sv), HasSubstr("too early"));
  EXPECT_THAT(problem(x, "\x9\0\0\0\1\1\0\0\0\0\0\0\0"sv), HasSubstr("never sent"));
  EXPECT_THAT(problem(x, "\7\0\0\0\2abcdef"sv), HasSubstr("longer than it should be"));
  EXPECT_THAT(problem(x, "\6\0\0\0\0\1\0\0\0\0"sv), HasSubstr("out of order"));
  EXPECT_THAT(problem(x, message_of(std::vector(5, message_word(MessageWord::keep, 0) - 1))),
              HasSubstr("the size of a message overflows"));
  EXPECT_THAT(problem(x, message_of({message_word(MessageWord::kept, 0)})), HasSubstr("missing"));
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::keep, 1)})),
              HasSubstr("missing"));
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::keep, 1),
                                     message_word(MessageWord::kept, 1)})),
              HasSubstr("missing"));
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::kept, 1)})),
              HasSubstr("not kept"));
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::forget, 1)})),
              HasSubstr("not kept"));
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::keep, 1), 0,
                                     message_word(MessageWord::keep, 1), 0})),
              HasSubstr("the same number"));
  x.kept_contents = content_overhead;
  EXPECT_THAT(problem(x, message_of({0, message_word(MessageWord::keep, 1), 0,
                                     message_word(MessageWord::keep, 2), 0,
                                     message_word(MessageWord::keep, 3), 0})),
              HasSubstr("to keep of more than"));
  // One of very many pieces.
  EXPECT_THAT(problem(x, "\x0a\0\0\0\0\1\0\0\0\1\xff\xff\xff\xff"sv), HasSubstr("pieces"));
}

TEST(LinkSession, OfAMessageThatIsTooLargeTheHeadArrivesAndOthersAreNotAffected) {
  LinkSession a{{.chunk = 1024}};
  LinkSession b{{.chunk = 1024, .largest_message = 4096}};
  a.send({bytes("too large"), {picture(3000), picture(3000)}});
  a.send({Bytes(100'000, 'x'), {picture(5000)}});
  a.send({bytes("next"), {picture(3000)}});
  std::vector<IncomingMessage> got;
  auto data = everything(a);
  // Cut anywhere.
  for (std::size_t i = 0; i < data.size(); i += 7)
    b.receive(as_bytes(std::string_view{data}.substr(i, 7)),
              [&](IncomingMessage x) { got.push_back(std::move(x)); });
  ASSERT_EQ(got.size(), 3u);
  std::sort(got.begin(), got.end(), [](auto& x, auto& y) { return x.too_large < y.too_large; });
  EXPECT_EQ(text(got[0].head), "next");
  EXPECT_EQ(got[0].contents.size(), 1u);
  EXPECT_EQ(text(got[1].head), "too large");
  EXPECT_GT(got[1].too_large, 6000u);
  EXPECT_TRUE(got[1].contents.empty());
  EXPECT_TRUE(got[2].head.empty());
  EXPECT_GT(got[2].too_large, 105'000u);
}

TEST(LinkSession, RefusesToResumeWhatNeverWas) {
  LinkSession a;
  LinkSession b;
  EXPECT_THROW(a.resume(1), LinkError);
  a.send({bytes("x")});
  heads(b, everything(a));
  b.remind(100ms);
  heads(a, everything(b));
  EXPECT_THROW(a.resume(0), LinkError);
  EXPECT_NO_THROW(a.resume(1));
}

// -- contents that are sent again

OutgoingMessage repeated(std::string_view head, std::vector<Value> contents, Lane lane = 0) {
  return {.head = bytes(head), .contents = std::move(contents), .lane = lane, .may_repeat = true};
}

/// The heads, each with the first byte of each picture.
std::vector<std::string> pictures(LinkSession& to, std::string_view data) {
  std::vector<std::string> result;
  to.receive(as_bytes(data), [&](IncomingMessage x) {
    result.push_back(text(x.head));
    for (auto& content : x.contents)
      result.back() +=
        static_cast<char>(content->value(descriptor_of<Picture>()).as<Picture>()->pixels.at(0));
  });
  return result;
}

TEST(LinkSession, AContentIsSentOnceAndIsOneValueForAllWhoGetIt) {
  LinkSession a;
  LinkSession b;
  auto same = picture(100'000, 's');
  std::vector<ReceivedContentPtr> got;
  auto take = [&](IncomingMessage x) { got.push_back(x.contents.at(0)); };
  a.send(repeated("first", {same}));
  b.receive(as_bytes(everything(a)), take);
  a.send(repeated("second", {same}));
  auto second = everything(a);
  EXPECT_LT(second.size(), 100u);
  b.receive(as_bytes(second), take);
  a.send(repeated("another that is as large", {picture(100'000, 's')}));
  auto another = everything(a);
  EXPECT_GT(another.size(), 100'000u);
  b.receive(as_bytes(another), take);
  ASSERT_EQ(got.size(), 3u);
  EXPECT_EQ(got[0], got[1]);
  EXPECT_NE(got[0], got[2]);
  auto& type = descriptor_of<Picture>();
  EXPECT_EQ(got[0]->value(type), same);
  EXPECT_EQ(got[0]->value(type).as<Picture>(), got[1]->value(type).as<Picture>());
}

TEST(LinkSession, WhoRefersToAContentComesAfterItAndOthersDoNotWait) {
  LinkSession a;
  LinkSession b;
  auto same = picture(1'000'000, 's');
  a.send(repeated("carries ", {same}, 7));
  a.send(repeated("refers ", {same}, 8));
  a.send(repeated("refers, too ", {same}, 8));
  a.send({bytes("same lane"), {}, 8});
  a.send({bytes("other lane"), {}, 9});
  EXPECT_EQ(a.waiting(), 5u);
  auto said = everything(a);
  EXPECT_LT(said.size(), 1'010'000u);
  EXPECT_THAT(pictures(b, said),
              ElementsAre("other lane", "carries s", "refers s", "refers, too s", "same lane"));
  EXPECT_EQ(a.waiting(), 0u);
  EXPECT_FALSE(a.has_output());
}

TEST(LinkSession, AContentMayBeInAMessageTwice) {
  LinkSession a;
  LinkSession b;
  auto same = picture(10'000, 's');
  a.send(repeated("", {same, picture(10'000, 'o'), same}));
  a.send(repeated("", {same, same}));
  auto said = everything(a);
  EXPECT_LT(said.size(), 21'000u);
  EXPECT_THAT(pictures(b, said), ElementsAre("sos", "ss"));
}

TEST(LinkSession, WhatIsNotSaidToBeRepeatedIsNotKept) {
  LinkSession a;
  LinkSession b;
  auto same = picture(10'000, 's');
  a.send({bytes("written "), {same}});
  a.send({bytes("and again "), {same}});
  auto said = everything(a);
  EXPECT_GT(said.size(), 20'000u);
  EXPECT_THAT(pictures(b, said), ElementsAre("written s", "and again s"));
}

TEST(LinkSession, OfAMessageThatIsTooLargeNothingIsKept) {
  LinkSession a{{.chunk = 1024, .largest_message = 4096}};
  LinkSession b{{.chunk = 1024, .largest_message = 4096}};
  auto x = picture(3000, 'x');
  a.send(repeated("", {x, picture(3000)}, 1));
  a.send(repeated("", {x}, 1));
  a.send(repeated("", {x}, 1));
  auto said = everything(a);
  EXPECT_GT(said.size(), 9000u);
  EXPECT_LT(said.size(), 10'000u);
  EXPECT_THAT(pictures(b, said), ElementsAre("", "x", "x"));
}

/// Two sessions that talk over connections which break at any time, and cut what is said anywhere.
class BadConnections : public testing::TestWithParam<unsigned> {};

TEST_P(BadConnections, EverythingArrivesOnceAndInOrder) {
  std::minstd_rand random{GetParam()};
  auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>{0, n - 1}(random);
  };
  SessionLimits limits{.chunk = 100, .window = 1000, .kept_contents = 3000};
  // Some values are sent again and again, and replaced now and then.
  std::vector<Value> entries(10);
  struct Side {
    LinkSession session;
    std::string on_the_way;
    int sent = 0;
    int acknowledged = 0;
    /// Per lane: what was sent, and what the other side got.
    std::map<Lane, std::vector<std::string>> out, in;
  };
  Side sides[2]{{LinkSession{limits}, {}, 0, 0, {}, {}}, {LinkSession{limits}, {}, 0, 0, {}, {}}};
  auto deliver = [&](Side& from, Side& to, std::size_t n) {
    auto part = from.on_the_way.substr(0, n);
    from.on_the_way.erase(0, n);
    to.session.receive(as_bytes(part), [&](IncomingMessage x) {
      auto head = text(x.head);
      Lane lane = static_cast<Lane>(head.at(0) - '0');
      for (auto& content : x.contents)
        head += text(content->bytes());
      from.in[lane].push_back(head);
    });
  };
  auto step = [&](bool may_send, bool may_break) {
    auto& from = sides[below(2)];
    auto& to = &from == sides ? sides[1] : sides[0];
    switch (below(8)) {
      case 0:
      case 1: {
        if (!may_send)
          return;
        Lane lane = below(4);
        auto head =
          std::to_string(lane) + ':' + std::to_string(from.sent++) + std::string(below(300), '.');
        auto whole = head;
        std::vector<Value> contents;
        for (auto n = below(3); n > 0; --n) {
          auto& entry = entries[below(entries.size())];
          if (!entry.has_value() || below(5) == 0)
            entry = picture(below(500), static_cast<std::uint8_t>('a' + below(26)));
          contents.push_back(entry);
          whole += text(contents.back().bytes());
        }
        from.out[lane].push_back(whole);
        from.session.send(
          {bytes(head), contents, lane, [&from] { ++from.acknowledged; }, false, below(4) != 0});
        return;
      }
      case 2:
        from.session.remind(100ms);
        [[fallthrough]];
      case 3:
      case 4: {
        std::vector<char> out;
        from.session.produce(out, 1 + below(2000));
        from.on_the_way.append(out.begin(), out.end());
        return;
      }
      case 5:
      case 6:
        deliver(from, to, 1 + below(3000));
        return;
      case 7:
        if (!may_break || below(10) != 0)
          return;
        // Some of what was on the way still arrives.
        deliver(from, to, below(from.on_the_way.size() + 1));
        deliver(to, from, below(to.on_the_way.size() + 1));
        from.on_the_way.clear();
        to.on_the_way.clear();
        from.session.resume(to.session.received());
        to.session.resume(from.session.received());
        return;
    }
  };
  for (int i = 0; i < 3000; ++i)
    step(true, true);
  auto all_there = [](Side& x) { return x.acknowledged == x.sent && x.on_the_way.empty(); };
  for (int i = 0; i < 1'000'000 && !(all_there(sides[0]) && all_there(sides[1])); ++i)
    step(false, false);
  for (auto& side : sides) {
    EXPECT_GT(side.sent, 100);
    EXPECT_EQ(side.acknowledged, side.sent);
    for (auto& [lane, messages] : side.out) {
      auto got = side.in[lane];
      if (lane == 0) {
        std::sort(messages.begin(), messages.end());
        std::sort(got.begin(), got.end());
      }
      EXPECT_EQ(got, messages) << "lane " << lane;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BadConnections, testing::Range(1u, 101u));

} // namespace

} // namespace castor
