#include "castor/actors/runtime/entry_reader.hpp"
#include "castor/actors/runtime/unanswered_requests.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <set>
#include <string>

namespace castor::test {

namespace {

struct Sign {
  std::int64_t number = 0;
};
CASTOR_REFLECT(Sign, number)

std::shared_ptr<EntryTable> table_with(const std::string& id, Version version) {
  auto result = std::make_shared<EntryTable>();
  result->insert(
    std::make_shared<const Entry>(Entry{{"a", id}, version, Value::of(Sign{}), "writer"}), 1);
  return result;
}

ClientPtr component_of(const std::string& subarchitecture) {
  return std::make_shared<const Client>(Client{"reader", subarchitecture, 1});
}

} // namespace

TEST(EntryReader, ReadsWhatIsInThisProcessAndMayBeRead) {
  ReadableMemories memories;
  EntryReader own{memories, component_of("a")};
  EntryReader other{memories, component_of("b")};
  EntryReader stranger{memories, component_of("c")};
  EXPECT_FALSE(own.read({"a", "x"})) << "not there yet";
  auto table = table_with("x", 7);
  memories.set("a", {table, std::set<std::string>{"b"}});
  ASSERT_TRUE(own.read({"a", "x"}));
  EXPECT_EQ(own.read({"a", "x"})->version, 7u);
  EXPECT_TRUE(other.read({"a", "x"}));
  EXPECT_FALSE(stranger.read({"a", "x"}));
  EXPECT_FALSE(own.read({"a", "y"}));
  EXPECT_FALSE(own.read({"b", "x"}));
  std::uint64_t reads = 0;
  table->counts().for_each([&](auto&, auto&, auto count) { reads += count; });
  EXPECT_EQ(reads, 3u);
}

TEST(EntryReader, NeverReadsFromAWorkingMemoryThatWasReplaced) {
  ReadableMemories memories;
  EntryReader reader{memories, component_of("a")};
  auto before = table_with("x", 7);
  memories.set("a", {before, {}});
  EXPECT_TRUE(reader.read({"a", "x"}));
  memories.set("a", {std::make_shared<EntryTable>(), {}});
  EXPECT_FALSE(reader.read({"a", "x"}));
  EXPECT_FALSE(before->read("x", std::chrono::steady_clock::now)) << "for those who still have it";
  memories.set("a", {table_with("x", 9), {}});
  EXPECT_EQ(reader.read({"a", "x"})->version, 9u);
  memories.remove("a");
  EXPECT_FALSE(reader.read({"a", "x"}));
}

TEST(UnansweredRequests, AreNotOvertaken) {
  UnansweredRequests requests;
  EXPECT_TRUE(requests.are_handled("a"));
  requests.begun();
  EXPECT_FALSE(requests.are_handled("a"));
  requests.answered(1, "a");
  EXPECT_TRUE(requests.are_handled("a"));
}

TEST(UnansweredRequests, OfOneThatNobodyWaitsForALaterAnswerTells) {
  UnansweredRequests requests;
  requests.begun();
  requests.begun();
  requests.abandoned(2, "a");
  requests.answered(1, "a");
  EXPECT_FALSE(requests.are_handled("a"));
  EXPECT_TRUE(requests.are_handled("b"));
  requests.begun();
  requests.answered(3, "b");
  EXPECT_FALSE(requests.are_handled("a")) << "that was another working memory";
  requests.begun();
  requests.answered(4, "a");
  EXPECT_TRUE(requests.are_handled("a"));
}

} // namespace castor::test
