#include "castor/communication/lexicon/english_lexicon.hpp"
#include "castor/communication/parsing/hybrid_logic.hpp"
#include "castor/communication/parsing/packing.hpp"
#include "castor/communication/parsing/parser.hpp"

#include <gmock/gmock.h>

using namespace castor::communication;
using testing::SizeIs;

namespace {

std::vector<ReadingForms> two_readings() {
  return {
    {parse_logical_form("@e:action(put ^ <Patient>(b:thing ^ ball ^ <Location>(n:region ^ near))"
                        " ^ <Destination>(o:region ^ on))")},
    {parse_logical_form("@e:action(put ^ <Patient>(b:thing ^ ball) ^ <Destination>(n:region "
                        "^ near ^ <Location>(o:region ^ on)))")}};
}

PackedLogicalForm ambiguous() {
  Parser parser(english_lexicon());
  auto packed = parser.parse("put the ball near the box on the table");
  EXPECT_THAT(packed.readings, SizeIs(2));
  return packed;
}

} // namespace

TEST(Packing, KeepsWhatReadingsShareOnce) {
  const auto packed = pack(two_readings());
  ASSERT_THAT(packed.nominals, SizeIs(4));
  ASSERT_THAT(packed.nominals[1].propositions, SizeIs(1));
  EXPECT_THAT(packed.nominals[1].propositions[0].readings, testing::ElementsAre(0, 1));
  ASSERT_THAT(packed.nominals[1].relations, SizeIs(1));
  EXPECT_THAT(packed.nominals[1].relations[0].readings, testing::ElementsAre(0));
}

TEST(Packing, LosesNoReading) {
  const auto readings = two_readings();
  const auto packed = pack(readings);
  for (std::int32_t id = 0; id < 2; ++id) {
    const auto forms = unpack(packed, id);
    ASSERT_THAT(forms, SizeIs(1));
    EXPECT_TRUE(equivalent(forms[0], readings[static_cast<std::size_t>(id)][0]));
  }
  EXPECT_THAT(unpack(packed, 2), SizeIs(0));
}

TEST(Packing, ForgetsAllOfAReadingThatIsRemoved) {
  const std::vector<ReadingForms> readings = {
    {parse_logical_form("@a:thing(ball ^ <Owner>(o:person ^ you))")},
    {parse_logical_form("@b:colour(red)")}};
  auto packed = pack(readings);
  remove_readings(packed, std::vector<std::int32_t>{0});
  EXPECT_EQ(packed.readings, (std::vector<Reading>{{1, 0}}));
  EXPECT_EQ(packed.roots, (std::vector<PackedValue>{{"b", {1}}}));
  ASSERT_THAT(packed.nominals, SizeIs(1));
  EXPECT_EQ(packed.nominals[0].name, "b");
}

TEST(Pruning, RemovesTheReadingThatNothingSupports) {
  auto packed = ambiguous();
  // The box is not on the table.
  EXPECT_TRUE(prune(packed, std::vector<InterpretationSupport>{{"w6", "Location", "w7", false}}));
  EXPECT_EQ(packed.state, InterpretationState::pruned);
  ASSERT_THAT(packed.readings, SizeIs(1));
  const auto form = unpack(packed, packed.readings[0].id).at(0);
  EXPECT_EQ(dependent(form, *find_nominal(form, "w1"), "Destination")->name, "w7");
  for (const auto& nominal : packed.nominals)
    for (const auto& relation : nominal.relations)
      EXPECT_THAT(relation.readings, SizeIs(1));
}

TEST(Pruning, LeavesAFormOfWhichNothingIsSupported) {
  auto packed = ambiguous();
  const auto before = packed;
  EXPECT_FALSE(prune(packed, std::vector<InterpretationSupport>{{"w6", "Location", "w7", false},
                                                                {"w3", "Location", "w4", false}}));
  EXPECT_EQ(packed, before);
}

TEST(Pruning, HeedsNothingThatIsSupportedOrNotThere) {
  auto packed = ambiguous();
  const auto before = packed;
  EXPECT_FALSE(prune(packed, std::vector<InterpretationSupport>{{"w6", "Location", "w7", true},
                                                                {"w99", "Location", "w4", false}}));
  EXPECT_EQ(packed, before);
}
