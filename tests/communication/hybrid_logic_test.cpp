#include "castor/communication/parsing/hybrid_logic.hpp"

#include <gtest/gtest.h>

#include <string>

using namespace castor::communication;

TEST(HybridLogic, IsReadAsItIsWritten) {
  for (const std::string text :
       {"@w1:thing(square ^ <Number>sg ^ <Colour>(b1:colour ^ blue))", "@e(<Mood>int)", "@x",
        "@e:perception(see ^ <Wh-Restr>(w1:entity ^ what) ^ <Patient>(w1))",
        "@a:thing(ball) & @b:thing(box)"})
    EXPECT_EQ(to_string(parse_logical_form(text)), text);
}

TEST(HybridLogic, SaysWhereAFormulaIsWrong) {
  const auto offset_of = [](const std::string& text) -> std::size_t {
    try {
      parse_logical_form(text);
    } catch (const HybridLogicError& error) {
      return error.offset();
    }
    return std::string::npos;
  };
  EXPECT_EQ(offset_of("thing"), 0u);
  EXPECT_EQ(offset_of("@w1:thing(square"), 16u);
  EXPECT_EQ(offset_of("@w1:thing(square ^ ball)"), 23u);
  EXPECT_EQ(offset_of("@w1(<Colour blue)"), 12u);
  EXPECT_EQ(offset_of("@w1(a) b"), 7u);
  EXPECT_EQ(offset_of(""), 0u);
}

TEST(HybridLogic, OfEndlessNestingIsRefused) {
  std::string text = "@x(";
  for (int i = 0; i < 100000; ++i)
    text += "<A>(x" + std::to_string(i) + " ^ ";
  EXPECT_THROW(parse_logical_form(text), HybridLogicError);
}

TEST(HybridLogic, SaysWhatIsWrongAlsoOfNamesWithZeroBytes) {
  using namespace std::string_literals;
  try {
    parse_logical_form("@\0y:thing(a ^ <Of>(\0y:person ^ b))"s);
    FAIL() << "it was understood";
  } catch (const HybridLogicError& e) {
    EXPECT_STREQ(e.what(), "\\x00y is of the sort thing already");
  }
}

TEST(HybridLogic, MeansTheSameUnderOtherNames) {
  const auto form = parse_logical_form("@a:thing(ball ^ <A>x ^ <B>y ^ <R>(b) ^ <S>(b:box))");
  EXPECT_TRUE(
    equivalent(form, parse_logical_form("@u:thing(ball ^ <B>y ^ <A>x ^ <S>(v:box) ^ <R>(v))")));
  EXPECT_FALSE(
    equivalent(form, parse_logical_form("@u:thing(ball ^ <B>y ^ <A>x ^ <S>(v:box) ^ <R>(w))")));
  EXPECT_FALSE(equivalent(form, parse_logical_form("@u:thing(ball ^ <B>y ^ <S>(v:box) ^ <R>(v))")));
}

TEST(HybridLogic, ComparesWhatTheRootDoesNotLeadToAsWell) {
  EXPECT_FALSE(equivalent(parse_logical_form("@a:thing & @b:thing(ball)"),
                          parse_logical_form("@a:thing & @b:thing(box)")));
}
