#include "castor/tools/chaos/change_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::linearizability {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Thing {};
CASTOR_REFLECT(Thing)

/// Changes of entry x, as they were told, and the writes behind them.
class ChangeCheck : public testing::Test {
protected:
  void wrote(Operation operation, Version version, Tick invoked, Tick returned,
             std::size_t batch = 0) {
    writes.push_back({operation, {"a", "x"}, "c", version, invoked, returned, batch});
    auto event = std::make_shared<ChangeEvent>();
    event->operation = operation;
    event->address = {"a", "x"};
    event->source = "c";
    event->type = descriptor_of<Thing>();
    event->version = version;
    event->sequence = told.size() + 1;
    told.push_back(event);
  }

  std::vector<std::string> faults() const { return faults_of(told, made, writes); }

  ChangeEvent& event(std::size_t i) { return const_cast<ChangeEvent&>(*told[i]); }

  void SetUp() override {
    wrote(Operation::add, 0, 1, 2);
    wrote(Operation::overwrite, 1, 3, 6);
    wrote(Operation::remove, 1, 4, 5);
    wrote(Operation::add, 2, 7, 8);
  }

  std::vector<ChangeEventPtr> told;
  std::vector<ObservedWrite> writes;
  std::uint64_t made = 4;
};

} // namespace

TEST_F(ChangeCheck, FindsNothingWhereAllIsWell) {
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(ChangeCheck, FindsGapsAndWhatIsMissing) {
  told.erase(told.begin());
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("number 2 came as number 1")));
  SetUp();
  made = 9;
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("of 9 changes")));
}

TEST_F(ChangeCheck, FindsVersionsThatDoNotFollow) {
  event(1).version = writes[1].version = 2;
  EXPECT_THAT(faults(), testing::Contains(HasSubstr("after version 0: OVERWRITE")));
}

TEST_F(ChangeCheck, FindsWhatNobodyWasToldAndWhatNobodyDid) {
  writes.back().component = "d";
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("no event for the ADD a/x v2 by d"),
                                    HasSubstr("nobody made this change")));
  writes.back().component = "c";
  // Who died before the answer may have made it.
  writes.back().returned = never;
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(ChangeCheck, FindsAnOrderThatCannotHaveBeen) {
  writes[1].invoked = 6;
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("but written before it: the DELETE")));
}

TEST_F(ChangeCheck, FindsWhatComesBetweenTheWritesOfABatch) {
  writes[1].batch = 1;
  std::swap(writes[2], writes[3]);
  writes[2].batch = 1;
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("between two writes of one batch")));
}

} // namespace castor::linearizability
