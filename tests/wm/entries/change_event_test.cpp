#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/values/value.hpp"

#include "castor/tests/wm/values/test_types.hpp"

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

TEST(ChangeEvent, SaysWhichFieldsAnOverwriteChanged) {
  ChangeEvent event;
  event.operation = Operation::overwrite;
  event.address = {"vision", "0:3"};
  event.source = "segmentor";
  event.type = descriptor_of<SignedBox>();
  auto after = signed_box();
  after.label = "coffee";
  after.signature.reset();
  event.changed = changed_fields(Value::of(signed_box()), Value::of(after));
  EXPECT_EQ(event.changed_fields(), (std::vector<std::string>{"label", "signature"}));
  EXPECT_TRUE(event.has_changed(&SignedBox::label));
  EXPECT_TRUE(event.has_changed(&SignedBox::signature));
  EXPECT_FALSE(event.has_changed(&SignedBox::pose));
  EXPECT_FALSE(event.has_changed(&SignedBox::side));
  EXPECT_FALSE(event.has_changed(&Tree::name));
  EXPECT_EQ(to_string(event),
            "OVERWRITE SignedBox vision/0:3 v0 by segmentor, changed label and signature");
  event.coalesced = true;
  EXPECT_EQ(to_string(event), "OVERWRITE SignedBox vision/0:3 v0 by segmentor, changed label and "
                              "signature, coalesced");
}

} // namespace castor::test
