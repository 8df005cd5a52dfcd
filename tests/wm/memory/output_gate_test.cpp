#include "castor/wm/memory/output_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Said {
  std::vector<std::string> words;

  void say(OutputGate& gate, const std::string& word) {
    if (gate.holds())
      gate.push([this, word] { words.push_back(word); });
    else
      words.push_back(word);
  }
};

TEST(OutputGate, HoldsNothingWhileEverythingIsSynced) {
  OutputGate gate;
  EXPECT_FALSE(gate.holds());
  gate.written(1, 1, 10);
  EXPECT_TRUE(gate.holds());
  gate.synced(1);
  EXPECT_FALSE(gate.holds());
}

TEST(OutputGate, LetsGoWhatDependsOnNothingUnsyncedInItsOrder) {
  OutputGate gate;
  Said said;
  gate.written(1, 1, 10);
  said.say(gate, "one");
  gate.written(3, 2, 10);
  said.say(gate, "two");
  said.say(gate, "three");
  gate.synced(1);
  EXPECT_THAT(said.words, ElementsAre("one"));
  said.say(gate, "four");
  EXPECT_EQ(gate.unsynced(), 2u);
  gate.synced(3);
  EXPECT_THAT(said.words, ElementsAre("one", "two", "three", "four"));
}

TEST(OutputGate, LetsSomeChangesBeUnsyncedIfToldTo) {
  OutputGate gate{{2, 100}};
  gate.written(1, 1, 10);
  gate.written(2, 1, 10);
  EXPECT_FALSE(gate.holds());
  Said said;
  gate.written(3, 1, 10);
  said.say(gate, "late");
  EXPECT_THAT(said.words, IsEmpty());
  gate.synced(1);
  EXPECT_THAT(said.words, ElementsAre("late"));
}

TEST(OutputGate, BoundsTheBytesThatMayBeUnsynced) {
  OutputGate gate{{1000, 100}};
  gate.written(1, 1, 101);
  EXPECT_TRUE(gate.holds());
  gate.synced(1);
  EXPECT_FALSE(gate.holds());
}

TEST(OutputGate, ForgetsWhatIsNeverToBeSaid) {
  OutputGate gate;
  Said said;
  gate.written(1, 1, 1);
  said.say(gate, "lost");
  gate.drop();
  gate.synced(1);
  EXPECT_THAT(said.words, IsEmpty());
}

TEST(OutputGate, SaysEverythingOnceThereIsNoJournalAnyMore) {
  OutputGate gate;
  Said said;
  gate.written(1, 1, 1);
  said.say(gate, "said all the same");
  gate.open();
  EXPECT_THAT(said.words, ElementsAre("said all the same"));
  EXPECT_FALSE(gate.holds());
}

} // namespace

} // namespace castor::test
