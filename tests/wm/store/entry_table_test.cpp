#include "castor/wm/store/entry_table.hpp"

#include "castor/wm/values/reflect.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

struct Tick {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Tick, number)

EntryPtr entry(const std::string& id, Version version) {
  return std::make_shared<const Entry>(
    Entry{{"a", id}, version, Value::of(Tick{std::int64_t(version)}), "writer"});
}

/// The time of the clock of leases.
constexpr EntryTable::Time now{1h};

EntryPtr read(const EntryTable& table, const std::string& id) {
  return table.read(id, [] { return now; });
}

} // namespace

TEST(EntryTable, OthersReadWhatTheOwnerInserted) {
  EntryTable table;
  EXPECT_FALSE(read(table, "x"));
  table.insert(entry("x", 3), 1);
  EXPECT_EQ(table.size(), 1u);
  ASSERT_TRUE(read(table, "x"));
  EXPECT_EQ(read(table, "x")->version, 3u);
  EXPECT_EQ(read(table, "x"), table.find("x")->entry);
  table.change("x", [](EntryTable::Slot& slot) { slot.entry = entry("x", 4); });
  EXPECT_EQ(read(table, "x")->version, 4u);
  table.erase("x");
  EXPECT_FALSE(read(table, "x"));
  EXPECT_EQ(table.find("x"), nullptr);
  EXPECT_EQ(table.size(), 0u);
}

TEST(EntryTable, OthersAskWhereTheAnswerMayDiffer) {
  EntryTable table;
  table.insert(entry("mortal", 0), 1, true);
  EXPECT_FALSE(read(table, "mortal")) << "may be due";
  table.insert(entry("x", 0), 1);
  table.change("x", [](EntryTable::Slot& slot) { slot.is_excluded = true; });
  EXPECT_FALSE(read(table, "x")) << "leased";
  table.change("x", [](EntryTable::Slot& slot) { slot.is_excluded = false; });
  table.begin_atomic();
  EXPECT_FALSE(read(table, "x")) << "in an atomic write";
  table.end_atomic();
  table.set_due(now);
  EXPECT_FALSE(read(table, "x")) << "a lease has ended";
  table.set_due(now + 1ns);
  EXPECT_TRUE(read(table, "x"));
  table.close();
  EXPECT_FALSE(read(table, "x")) << "closed";
  EXPECT_TRUE(table.find("x")) << "its owner may still be at work";
  table.clear();
  EXPECT_EQ(table.size(), 0u);
}

TEST(EntryTable, TheClockIsNotAskedWithoutLeases) {
  EntryTable table;
  table.insert(entry("x", 0), 1);
  EXPECT_TRUE(table.read("x", []() -> EntryTable::Time {
    ADD_FAILURE();
    return {};
  }));
}

/// One thread writes two entries at once, over and over, and adds and deletes others; others read.
TEST(EntryTable, ThreadsSeeAtomicWritesWholeAndNothingOlderThanWasAnswered) {
  EntryTable table;
  constexpr Version last = 20'000;
  table.insert(entry("x", 0), 1);
  table.insert(entry("y", 0), 1);
  std::atomic<Version> answered{0};
  std::atomic<std::size_t> seen{0};
  std::atomic<bool> done{false};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i)
    readers.emplace_back([&] {
      Version x_before = 0;
      while (!done) {
        Version known = answered;
        auto x = read(table, "x");
        auto y = read(table, "y");
        if (x) {
          ++seen;
          EXPECT_GE(x->version, known);
          EXPECT_GE(x->version, x_before);
          x_before = x->version;
        }
        if (x && y) {
          EXPECT_GE(y->version, x->version) << "part of an atomic write";
        }
        read(table, "z" + std::to_string(known % 100));
      }
    });
  // Until the readers have had processors, too.
  for (Version version = 1; version <= last || seen < 1000; ++version) {
    table.begin_atomic();
    for (auto* id : {"x", "y"})
      table.change(id, [&](EntryTable::Slot& slot) { slot.entry = entry(id, version); });
    table.end_atomic();
    answered = version;
    auto other = "z" + std::to_string(version % 100);
    if (table.find(other))
      table.erase(other);
    else
      table.insert(entry(other, version), version);
  }
  done = true;
  for (auto& x : readers)
    x.join();
}

TEST(ReadCounts, AreByComponentAndType) {
  ReadCounts counts;
  auto& a = counts.of_component("a");
  a.add(descriptor_of<Tick>());
  a.add(descriptor_of<Tick>());
  EXPECT_EQ(&counts.of_component("a"), &a);
  counts.of_component("b").add(descriptor_of<Tick>());
  std::vector<std::string> all;
  counts.for_each([&](auto& component, auto& type, auto count) {
    all.push_back(component + ' ' + type + ' ' + std::to_string(count));
  });
  std::string type{descriptor_of<Tick>()->name()};
  EXPECT_EQ(all, (std::vector<std::string>{"a " + type + " 2", "b " + type + " 1"}));
}

} // namespace castor::test
