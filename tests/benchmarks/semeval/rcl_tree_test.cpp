#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"

#include <gtest/gtest.h>

using namespace castor::semeval;

TEST(RclTree, IsReadAsItIsWritten) {
  const std::string text = "(event: (action: take) (entity: (id: 1) (color: red) (type: cube) "
                           "(spatial-relation: (relation: "
                           "above) (entity: (type: board)))))";
  EXPECT_EQ(to_string(parse_rcl(text)), text);
}

TEST(RclTree, KnowsItsWordsButDoesNotShowThem) {
  const auto tree =
    parse_rcl("(event: (action: take (token: 1 2)) (entity: (type: cube (token: 4))))");
  EXPECT_EQ(to_string(tree), "(event: (action: take) (entity: (type: cube)))");
  EXPECT_EQ(tree.child("action")->first_token, 1);
  EXPECT_EQ(tree.child("action")->last_token, 2);
  EXPECT_EQ(tree.child("entity")->child("type")->first_token, 4);
  EXPECT_EQ(tree.child("entity")->value_of("type"), "cube");
  EXPECT_EQ(tree.child("destination"), nullptr);
}

TEST(RclTree, RefusesWhatIsNone) {
  for (const std::string text : {"", "event", "(event", "(event:", "(event: (a: b)", "(event: a) b",
                                 "()", "(: a)", "(a: (token: x))"})
    EXPECT_THROW(parse_rcl(text), RclError) << text;
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "(a: ";
  EXPECT_THROW(parse_rcl(deep), RclError);
}
