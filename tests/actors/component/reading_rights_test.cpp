#include "castor/tests/actors/component/scripted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Of three subarchitectures only b may read a.
class ReadingRights : public testing::Test {
protected:
  void TearDown() override { clear_scripts(); }

  static auto& script(const std::string& name) { return ManagedScript::scripts()[name]; }

  static ArchitectureDescription description() {
    return architecture(subarchitecture("a") + "CPP MG owner Managed\n" + subarchitecture("b") +
                        "CPP MG friend Managed\n" + subarchitecture("c") +
                        "CPP MG stranger Managed\nACCESS b READS a\n");
  }

  const Address note{"a", "note"};
};

TEST_F(ReadingRights, RefuseEveryWayToReadAndNameRuleAndRemedy) {
  script("owner").start = [&](auto& self) { self.add(note, Note{1}); };
  script("friend").run = [&](auto& self) {
    EXPECT_EQ(self.template read<Note>(note)->number, 1);
    EXPECT_EQ(self.template read_all_in<Note>("a").size(), 1u);
    EXPECT_TRUE(self.exists(note));
    EXPECT_EQ(self.version(note), 0u);
  };
  script("stranger").run = [&](auto& self) {
    auto refused = [](auto f) {
      try {
        f();
        ADD_FAILURE();
      } catch (const PermissionException& e) {
        EXPECT_THAT(e.what(), AllOf(HasSubstr("stranger of c may not read"), HasSubstr("of a"),
                                    HasSubstr("ACCESS c READS a"), HasSubstr(".cast file")));
      }
    };
    refused([&] { self.template read<Note>(note); });
    refused([&] { self.template read_all_in<Note>("a"); });
    refused([&] { self.template read_where_in<Note>("a", field(&Note::number) == 1); });
    refused([&] { self.exists(note); });
    refused([&] { self.version(note); });
    EXPECT_TRUE(self.template read_all_in<Note>("b").empty()) << "no rule is about b";
    self.end_system(0, "done");
  };
  System system{description()};
  EXPECT_EQ(run(system), 0);
}

TEST_F(ReadingRights, KeepEventsFromOthers) {
  std::atomic<int> heard_by_friend{0}, heard_by_stranger{0};
  script("friend").start = [&](auto& self) {
    self.on_change(added<Note>().in("a"), [&](auto&) { ++heard_by_friend; });
  };
  script("stranger").start = [&](auto& self) {
    try {
      self.on_change(added<Note>().in("a"), [](auto&) {});
      ADD_FAILURE();
    } catch (const PermissionException& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr("components of c get no change events of a"),
                                  HasSubstr("ACCESS c READS a")));
    }
    self.on_change(added<Note>().anywhere(), [&](auto& event) {
      EXPECT_EQ(event.address.subarchitecture, "b");
      ++heard_by_stranger;
    });
  };
  script("owner").run = [&](auto& self) { self.add(note, Note{}); };
  script("friend").run = [&](auto& self) {
    while (heard_by_friend == 0)
      ASSERT_TRUE(self.sleep_for(1ms));
    self.add(Note{});
    while (heard_by_stranger == 0)
      ASSERT_TRUE(self.sleep_for(1ms));
    self.end_system(heard_by_stranger, "done");
  };
  System system{description()};
  EXPECT_EQ(run(system), 1);
}

TEST_F(ReadingRights, HoldForBroadcastsToo) {
  std::atomic<int> heard{0};
  script("stranger").start = [&](auto& self) {
    self.on_change(added<Note>().anywhere(), [&](auto& event) {
      EXPECT_EQ(event.address.subarchitecture, "b");
      ++heard;
    });
  };
  script("owner").start = [&](auto& self) {
    self.on_change(added<Note>().in("b"), [&](auto&) { self.add(note, Note{}); });
  };
  script("friend").start = [&](auto& self) {
    self.on_change(added<Note>().in("a"), [&](auto&) { self.add(Note{2}); });
  };
  script("friend").run = [&](auto& self) {
    self.add(Note{1});
    while (heard < 2)
      ASSERT_TRUE(self.sleep_for(1ms));
    self.end_system(0, "done");
  };
  SystemOptions options;
  options.broadcast = true;
  System system{description(), options};
  EXPECT_EQ(run(system), 0);
}

} // namespace

} // namespace castor::test
