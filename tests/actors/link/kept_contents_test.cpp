#include "castor/actors/link/kept_contents.hpp"

#include "castor/actors/link/link_error.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace castor {

struct Photo {
  Bytes pixels;
};
CASTOR_REFLECT(Photo, pixels)

namespace {

constexpr std::size_t photo_size = 1000;
constexpr std::size_t photo_cost = photo_size + content_overhead;

class KeptContents : public testing::Test {
protected:
  using Mentions = SentContents::Mentions;

  static Value value() { return Value::of(Photo{Bytes(photo_size)}); }

  /// Mentions the value in a message: whether it is kept then.
  bool mention(const Value& x, Mentions& message) {
    return sent.find(x, message) || sent.add(x, photo_size, message);
  }

  /// The same in a message that is written at once.
  bool send(const Value& x) {
    Mentions message;
    auto result = mention(x, message);
    sent.take_forgotten(message);
    for (auto& y : message.forgotten)
      forgotten.push_back(y->number);
    sent.written(message);
    return result;
  }

  SentContents sent{3 * photo_cost};
  std::vector<ContentNumber> forgotten;
};

TEST_F(KeptContents, AreKnownByTheValueAndNotByWhatItHolds) {
  auto x = value();
  auto copy = x;
  Mentions message;
  EXPECT_EQ(sent.find(x, message), nullptr);
  auto kept = sent.add(x, photo_size, message);
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(sent.find(copy, message), kept);
  EXPECT_EQ(sent.find(value(), message), nullptr);
}

TEST_F(KeptContents, AMessageThatRefersIsReadyOnceTheOneThatCarriesIsWritten) {
  auto x = value();
  Mentions first, second;
  mention(x, first);
  mention(x, first);
  mention(x, second);
  EXPECT_TRUE(first.are_ready());
  EXPECT_FALSE(second.are_ready());
  sent.written(first);
  EXPECT_TRUE(second.are_ready());
}

TEST_F(KeptContents, TheLeastRecentlyUsedMakesRoom) {
  auto a = value(), b = value(), c = value(), d = value();
  for (auto& x : {a, b, c, a, d})
    EXPECT_TRUE(send(x));
  EXPECT_THAT(forgotten, testing::ElementsAre(2));
  Mentions message;
  EXPECT_NE(sent.find(a, message), nullptr);
  EXPECT_EQ(sent.find(b, message), nullptr);
}

TEST_F(KeptContents, WhatAMessageOnItsWayMentionsIsNotForgotten) {
  auto a = value(), b = value(), c = value();
  Mentions on_the_way;
  for (auto& x : {a, b, c})
    EXPECT_TRUE(mention(x, on_the_way));
  EXPECT_FALSE(send(value()));
  EXPECT_TRUE(forgotten.empty());
  sent.written(on_the_way);
  EXPECT_TRUE(send(value()));
  EXPECT_THAT(forgotten, testing::ElementsAre(1));
}

TEST_F(KeptContents, WhatThePeerHasNotBeenToldToForgetTakesRoomAtMostAsMuchAgain) {
  std::vector<Value> values;
  std::vector<Mentions> on_the_way;
  auto add = [&] {
    values.push_back(value());
    on_the_way.emplace_back();
    auto result = mention(values.back(), on_the_way.back());
    sent.take_forgotten(on_the_way.back());
    // The content is there, but not yet the message that says what to forget.
    auto carried = on_the_way.back();
    carried.forgotten.clear();
    sent.written(carried);
    return result;
  };
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(add()) << i;
  EXPECT_FALSE(add());
  for (auto& x : on_the_way) {
    Mentions told;
    told.forgotten = x.forgotten;
    sent.written(told);
  }
  EXPECT_TRUE(add());
}

TEST_F(KeptContents, WhatIsTooLargeIsNotKept) {
  auto x = value();
  Mentions message;
  EXPECT_EQ(sent.add(x, 3 * photo_cost, message), nullptr);
  EXPECT_TRUE(message.carried.empty());
}

TEST(SentContents, ValuesThatNobodyHasAreForgotten) {
  SentContents sent{1'000'000};
  auto lasting = Value::of(Photo{});
  std::size_t most = 0;
  for (int i = 0; i < 1000; ++i) {
    for (auto& x : {Value::of(Photo{}), lasting}) {
      SentContents::Mentions message;
      EXPECT_TRUE(sent.find(x, message) || sent.add(x, photo_size, message));
      sent.take_forgotten(message);
      sent.written(message);
    }
    most = std::max(most, sent.size());
  }
  EXPECT_LE(most, 4u);
  SentContents::Mentions message;
  EXPECT_EQ(sent.find(lasting, message)->number, 2u);
}

TEST(ReceivedContents, AreFoundUntilTheyAreForgotten) {
  ReceivedContents received{1000};
  auto content = std::make_shared<ReceivedContent>(Bytes(10));
  received.add(7, content);
  EXPECT_EQ(received.find(7), content);
  EXPECT_THROW(received.add(7, content), LinkError);
  received.forget(7);
  EXPECT_THROW(received.find(7), LinkError);
  EXPECT_THROW(received.forget(7), LinkError);
}

TEST(ReceivedContents, TakeOnlySoMuchMemory) {
  ReceivedContents received{1000};
  auto add = [&](ContentNumber x) {
    received.add(x, std::make_shared<ReceivedContent>(Bytes(1000 - content_overhead)));
  };
  for (ContentNumber x = 0; x < 100; ++x) {
    add(x);
    add(x + 1000);
    received.forget(x);
    received.forget(x + 1000);
  }
  EXPECT_EQ(received.size(), 0u);
  add(1);
  add(2);
  EXPECT_THROW(add(3), LinkError);
}

TEST(ReceivedContent, IsAValueOfOneType) {
  auto photo = Value::of(Photo{Bytes{1, 2}});
  ReceivedContent x{photo.bytes()};
  EXPECT_EQ(x.value(photo.type_ptr()), photo);
  EXPECT_EQ(x.bytes(), photo.bytes());
  auto other = std::make_shared<TypeDescriptor>(photo.type());
  ++other->hash;
  EXPECT_THROW(x.value(other), DecodeError);
}

} // namespace

} // namespace castor
