#include "castor/actors/runtime/seen_versions.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <random>
#include <string>

namespace castor {

namespace {

Address at(int i) {
  return {"a", std::to_string(i)};
}

TEST(SeenVersions, RemembersTheLatest) {
  SeenVersions seen;
  EXPECT_EQ(seen.get(at(1)), std::nullopt);
  seen.set(at(1), 3);
  seen.set(at(1), 4);
  EXPECT_EQ(seen.get(at(1)), 4u);
  EXPECT_EQ(seen.get({"b", "1"}), std::nullopt) << "another subarchitecture, another entry";
  seen.erase(at(1));
  EXPECT_EQ(seen.get(at(1)), std::nullopt);
}

TEST(SeenVersions, ForgetsOnlyWhatWasNotSeenForLong) {
  SeenVersions seen{10};
  for (int i = 0; i < 1000; ++i) {
    seen.set(at(i), 0);
    seen.set(at(-1), static_cast<Version>(i));
    EXPECT_EQ(seen.get(at(-1)), static_cast<Version>(i));
    for (int k = std::max(0, i - 8); k <= i; ++k)
      EXPECT_TRUE(seen.get(at(k)).has_value()) << k << " of " << i;
  }
  int remembered = 0;
  for (int i = 0; i < 1000; ++i)
    remembered += seen.get(at(i)).has_value();
  EXPECT_LE(remembered, 22);
}

TEST(SeenVersions, TheNewestCountsAcrossGenerations) {
  SeenVersions seen{2};
  seen.set(at(1), 1);
  seen.set(at(2), 1);
  seen.set(at(3), 1);
  seen.set(at(1), 2);
  EXPECT_EQ(seen.get(at(1)), 2u);
  seen.erase(at(1));
  EXPECT_EQ(seen.get(at(1)), std::nullopt);
}

TEST(VersionTable, AgreesWithAMap) {
  std::mt19937 random{1};
  for (int run = 0; run < 20; ++run) {
    VersionTable table;
    std::map<int, SeenVersion> expected;
    auto ids = std::size_t{1} << (run % 12);
    for (int step = 0; step < 20'000; ++step) {
      auto id = static_cast<int>(random() % ids);
      auto key = VersionTable::fingerprint(at(id));
      if (random() % 5 < 3) {
        SeenVersion x{random(), random() % 2 == 0};
        table.set(key, x);
        expected[id] = x;
      } else {
        table.erase(key);
        expected.erase(id);
      }
      ASSERT_EQ(table.size(), expected.size());
      auto other = static_cast<int>(random() % ids);
      auto found = table.find(VersionTable::fingerprint(at(other)));
      auto i = expected.find(other);
      ASSERT_EQ(found.has_value(), i != expected.end());
      if (found) {
        ASSERT_EQ(found->version, i->second.version);
        ASSERT_EQ(found->expected, i->second.expected);
      }
    }
  }
}

TEST(VersionTable, TellsSubarchitecturesAndIdsApart) {
  EXPECT_FALSE(VersionTable::fingerprint({"ab", "c"}) == VersionTable::fingerprint({"a", "bc"}));
  EXPECT_FALSE(VersionTable::fingerprint({"a", "b"}) == VersionTable::fingerprint({"b", "a"}));
}

} // namespace

} // namespace castor
