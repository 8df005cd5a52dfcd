#include "castor/wm/change_event.hpp"

#include "test_types.hpp"

#include <gtest/gtest.h>

namespace castor::test {

TEST(ChangeEvent, UsesThePapersWordsForOperations) {
  EXPECT_EQ(to_string(Operation::add), "ADD");
  EXPECT_EQ(to_string(Operation::overwrite), "OVERWRITE");
  EXPECT_EQ(to_string(Operation::remove), "DELETE");
  EXPECT_EQ(to_string(static_cast<Operation>(77)), "UNKNOWN");
}

TEST(ChangeEvent, PrintsWhatHappenedWhereAndByWhom) {
  ChangeEvent event;
  event.operation = Operation::overwrite;
  event.address = {"vision", "0:3"};
  event.source = "segmentor";
  event.type = descriptor_of<Box>();
  event.version = 2;
  EXPECT_EQ(to_string(event), "OVERWRITE Box vision/0:3 v2 by segmentor");
  EXPECT_EQ(event.type_name(), "Box");
}

} // namespace castor::test
