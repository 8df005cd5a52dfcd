#include "castor/actors/link/admission.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>

namespace castor {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class AdmissionTest : public testing::Test {
protected:
  std::optional<Admission::Connection> admit(Admission::Connection x, const std::string& address) {
    now += 1ms;
    return admission.admit(x, address, now);
  }

  Admission::Time now{1h};
  Admission admission{{.all = 4, .per_address = 3, .silent = 100ms, .patience = 1000ms}};
};

TEST_F(AdmissionTest, ThoseWhoSayNothingHaveLessTime) {
  admit(1, "a");
  admit(2, "b");
  admission.has_sent(2);
  EXPECT_THAT(admission.late(now + 50ms), IsEmpty());
  EXPECT_THAT(admission.late(now + 200ms), ElementsAre(1));
  EXPECT_THAT(admission.late(now + 2000ms), ElementsAre(1, 2));
}

TEST_F(AdmissionTest, TheOldestSilentOneGivesWay) {
  admit(1, "a");
  admit(2, "b");
  admit(3, "c");
  admit(4, "d");
  admission.has_sent(1);
  EXPECT_EQ(admit(5, "e"), 2);
  EXPECT_EQ(admit(6, "f"), 3);
  EXPECT_EQ(admission.size(), 4u);
}

TEST_F(AdmissionTest, WhoeverTakesTooMuchMakesRoomForItselfOnly) {
  admit(1, "b");
  for (int i = 2; i <= 4; ++i)
    admit(i, "a");
  EXPECT_EQ(admit(5, "a"), 2);
  for (int i = 3; i <= 5; ++i)
    admission.has_sent(i);
  EXPECT_EQ(admit(6, "a"), 6);
  EXPECT_EQ(admit(7, "c"), 1);
}

TEST_F(AdmissionTest, StrangersGiveWayBeforeThoseWhoAreKnown) {
  admission.remember("known");
  admit(1, "known");
  admit(2, "a");
  admit(3, "b");
  admit(4, "c");
  EXPECT_EQ(admit(5, "d"), 2);
  // Everybody speaks: only one who is known gets in at once.
  for (int i : {1, 3, 4, 5})
    admission.has_sent(i);
  EXPECT_EQ(admit(6, "e"), 6);
  EXPECT_EQ(admit(7, "known"), 3);
}

TEST_F(AdmissionTest, SlowSpeakersKeepNobodyOutForLong) {
  for (int i = 1; i <= 4; ++i) {
    admit(i, std::to_string(i));
    admission.has_sent(i);
  }
  EXPECT_EQ(admit(5, "e"), 5);
  now += 150ms;
  EXPECT_EQ(admit(6, "f"), 1);
}

TEST_F(AdmissionTest, WhoIsGoneTakesNoPlace) {
  for (int i = 1; i <= 4; ++i)
    admit(i, std::to_string(i));
  admission.remove(3);
  EXPECT_EQ(admit(5, "e"), std::nullopt);
}

} // namespace

} // namespace castor
