// What a table says of injections, and the file that keeps them.

#include "castor/benchmarks/safety/injection.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace castor::benchmark {

namespace {

Injection injection(const std::string& kind, double braked_ms, double waited_ms = 0) {
  return {kind, {braked_ms, braked_ms + 625, braked_ms / 2000 + 0.156, 0}, waited_ms};
}

} // namespace

TEST(Injections, AreSummarisedByKind) {
  const auto all = summarise({injection("a", 100), injection("a", 300), injection("a", 200, 4),
                              injection("b", 50), injection("b", 70)});
  ASSERT_EQ(all.size(), 2U);
  const auto& a = all.at("a");
  EXPECT_EQ(a.count, 3U);
  EXPECT_EQ(a.braked_p50, 200);
  EXPECT_EQ(a.braked_max, 300);
  EXPECT_EQ(a.stood_max, 925);
  EXPECT_NEAR(a.way_p50, 0.256, 1e-9);
  EXPECT_EQ(a.waited_max, 4);
  EXPECT_EQ(a.late, 0U);
  EXPECT_EQ(all.at("b").braked_p50, 50);
}

TEST(Injections, AreLateByLoadOnlyIfTheyWouldHaveBeenInTimeWithoutIt) {
  const auto all = summarise({injection("a", 301), injection("a", 350, 49), injection("a", 350, 50),
                              injection("a", 299, 50)});
  EXPECT_EQ(all.at("a").late, 2U);
  EXPECT_EQ(all.at("a").late_by_load, 1U);
}

TEST(Injections, AreKeptInAFile) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "injections";
  EXPECT_TRUE(read_injections(file).empty());
  auto x = injection("link cut", 123.25, 1.5);
  x.stop.collisions = 2;
  append(x, file);
  append(injection("b", 7), file);
  const auto read = read_injections(file);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].kind, "link cut");
  EXPECT_EQ(read[0].stop.braked_ms, 123.25);
  EXPECT_EQ(read[0].stop.stood_ms, x.stop.stood_ms);
  EXPECT_EQ(read[0].stop.way, x.stop.way);
  EXPECT_EQ(read[0].stop.collisions, 2);
  EXPECT_EQ(read[0].waited_ms, 1.5);
  EXPECT_EQ(read[1].kind, "b");
}

TEST(Injections, LineThatCannotBeReadIsNamed) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "injections";
  append(injection("a", 1), file);
  std::ofstream{file, std::ios::app} << "{\"kind\": 3}\n";
  try {
    read_injections(file);
    FAIL() << "it was read";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string{e.what()}.find(file.string() + ":2: no injection"), std::string::npos)
      << e.what();
  }
}

} // namespace castor::benchmark
