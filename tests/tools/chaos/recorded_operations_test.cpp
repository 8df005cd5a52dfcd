#include "castor/tools/chaos/recorded_operations.hpp"

#include "castor/wm/entries/failure.hpp"
#include "castor/wm/memory/working_memory.hpp"
#include "castor/wm/store/entry_store.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace castor::faults::test {

namespace {

using linearizability::never;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = linearizability::Verdict::Kind;

/// Writes the files of processes, moment by moment.
class Script {
public:
  /// Somebody of a first life begins something with the entry x of the subarchitecture a; the
  /// number of the operation.
  int begin(const std::string& who, const std::string& what, const std::string& more = {},
            int life = 1) {
    text_ << R"({"begin": )" << ++number_ << R"(, "at": )" << ++now_ << R"(, "component": ")" << who
          << R"(", "life": )" << life << R"(, "do": ")" << what << R"(", "where": "a", "id": "x")"
          << (more.empty() ? "" : ", ") << more << "}\n";
    return number_;
  }

  void end(int number, const std::string& gave = {}) {
    text_ << R"({"end": )" << number << R"(, "at": )" << ++now_ << (gave.empty() ? "" : ", ")
          << gave << "}\n";
  }

  void fail(int number, FailureKind why) {
    end(number, R"("failure": )" + std::to_string(static_cast<int>(why)));
  }

  void add(const std::string& who, int content, Version version = 0) {
    end(begin(who, "add", content_of(content)), version_of(version));
  }

  void overwrite(const std::string& who, int content, Version seen, int life = 1) {
    end(begin(who, "overwrite", content_of(content) + R"(, "seen": )" + std::to_string(seen), life),
        version_of(seen + 1));
  }

  void read(const std::string& who, int content, Version version) {
    end(begin(who, "read"), version_of(version) + ", " + content_of(content));
  }

  static std::string content_of(int content) { return R"("content": )" + std::to_string(content); }
  static std::string version_of(Version version) {
    return R"("version": )" + std::to_string(version);
  }

  Recording recording(const std::string& rest = {}) const {
    RecordingReader reader;
    std::istringstream in{text_.str() + rest};
    reader.read(in);
    return reader.take();
  }

  std::uint64_t now() const { return now_; }

private:
  std::ostringstream text_;
  int number_ = 0;
  std::uint64_t now_ = 0;
};

Judgement judge(const Script& script, const MemoryConditions& conditions = {.subarchitecture = "a"},
                const std::set<Life>& ended = {}) {
  return judge_operations(script.recording(), conditions, ended, never - 1);
}

const MemoryConditions empty_again{.subarchitecture = "a", .went_down = true};
const MemoryConditions durable{.subarchitecture = "a", .went_down = true, .durable = true};
const MemoryConditions leasing{.subarchitecture = "a", .lease = Timestamp{1'000'000}};

TEST(RecordedOperations, AreReadWithTheirEnds) {
  Script script;
  script.add("p", 5);
  script.begin("q", "overwrite", R"("content": 6, "seen": 0, "token": 9)");
  auto x = script.recording();
  ASSERT_THAT(x, SizeIs(2));
  EXPECT_EQ(x[0].component, "p");
  EXPECT_EQ(to_string(x[0].address), "a/x");
  EXPECT_EQ(x[0].record.returned, 2);
  EXPECT_TRUE(x[1].record.pending());
  EXPECT_EQ(x[1].record.token, 9);
  EXPECT_EQ(x[1].record.last_seen, 0);
  EXPECT_NE(x[0].record.client, x[1].record.client);
}

TEST(RecordedOperations, LinesThatAKilledProcessDidNotFinishAreLeftOut) {
  Script script;
  script.add("p", 5);
  EXPECT_THAT(script.recording(R"({"begin": 2, "at": 3, "compo)"), SizeIs(1));
}

TEST(JudgementOfOperations, SaysOnWhatGrounds) {
  Script script;
  script.add("p", 5);
  script.read("q", 5, 0);
  auto result = judge(script);
  EXPECT_EQ(result.verdict, Kind::ok) << result.report;
  EXPECT_EQ(result.grounds, "2 operations on 1 entry");
}

TEST(JudgementOfOperations, SeesAReadOfWhatWasOverwritten) {
  Script script;
  script.add("p", 5);
  script.overwrite("p", 6, 0);
  script.read("q", 5, 0);
  auto result = judge(script);
  EXPECT_EQ(result.verdict, Kind::violation);
  EXPECT_THAT(result.report, HasSubstr("a/x: no order of its operations explains their results"));
  EXPECT_THAT(result.report, HasSubstr("p overwrite content 6 over version 0"));
}

TEST(JudgementOfOperations, SeesTwoOverwritesOfOneVersion) {
  Script script;
  script.add("p", 5);
  script.overwrite("p", 6, 0);
  script.overwrite("q", 7, 0);
  EXPECT_EQ(judge(script).verdict, Kind::violation);
}

TEST(JudgementOfOperations, AWriteThatWasNotAnsweredMayHaveBeenMade) {
  Script script;
  script.add("p", 5);
  script.begin("p", "overwrite", R"("content": 6, "seen": 0)");
  script.read("q", 6, 1);
  EXPECT_EQ(judge(script).verdict, Kind::ok);
}

TEST(JudgementOfOperations, WhatWasRefusedForOtherReasonsSaysNothing) {
  Script script;
  script.fail(script.begin("p", "add", R"("content": 5)"), FailureKind::not_permitted);
  script.add("q", 6);
  EXPECT_EQ(judge(script).verdict, Kind::ok);
}

TEST(JudgementOfOperations, AWriteThatFailedWithAnotherOfItsBatchSaysNothing) {
  const auto refused = [](const std::string& more) {
    Script script;
    script.add("p", 5);
    script.end(script.begin("p", "overwrite", R"("content": 6, "seen": 0)"),
               R"("failure": )" + std::to_string(static_cast<int>(FailureKind::inconsistent)) +
                 more);
    return judge(script).verdict;
  };
  EXPECT_EQ(refused(""), Kind::violation);
  EXPECT_EQ(refused(R"(, "another": true)"), Kind::ok);
}

TEST(JudgementOfOperations, AllWritesOfABatchThatWasNotAnsweredMayHaveBeenMade) {
  for (const auto why : {FailureKind::working_memory_lost, FailureKind::no_answer}) {
    Script script;
    script.add("p", 5);
    script.end(script.begin("p", "overwrite", R"("content": 6, "seen": 0)"),
               R"("failure": )" + std::to_string(static_cast<int>(why)) + R"(, "another": true)");
    script.read("q", 6, 1);
    EXPECT_EQ(judge(script).verdict, Kind::ok) << judge(script).report;
  }
}

TEST(JudgementOfOperations, SeesTwoWhoHoldOneLease) {
  Script script;
  script.add("p", 5);
  script.end(script.begin("p", "lock", R"("level": 0)"), R"("token": 1)");
  script.end(script.begin("q", "lock", R"("level": 0)"), R"("token": 2)");
  EXPECT_EQ(judge(script, leasing).verdict, Kind::violation);
}

TEST(JudgementOfOperations, ALeaseEndsWithTheLifeOfItsHolder) {
  Script script;
  script.add("p", 5);
  script.end(script.begin("p", "lock", R"("level": 0)"), R"("token": 1)");
  script.end(script.begin("q", "lock", R"("level": 0)"), R"("token": 2)");
  EXPECT_EQ(judge(script, leasing, {{"p", 1}}).verdict, Kind::ok);
  EXPECT_EQ(judge(script, leasing, {{"p", 2}}).verdict, Kind::violation);
}

TEST(JudgementOfOperations, SeesTokensThatFall) {
  Script script;
  script.add("p", 5);
  auto lock_and_unlock = [&](const std::string& token) {
    script.end(script.begin("p", "lock", R"("level": 0)"), R"("token": )" + token);
    script.end(script.begin("p", "unlock", R"("token": )" + token));
  };
  lock_and_unlock("7");
  lock_and_unlock("6");
  EXPECT_EQ(judge(script, leasing).verdict, Kind::violation);
}

TEST(JudgementOfOperations, ALossIsAViolationWithAFullJournalOnly) {
  Script script;
  script.add("p", 5);
  script.overwrite("p", 6, 0);
  // The working memory is killed, and comes back without the overwrite, which was acknowledged.
  script.read("q", 5, 0);
  EXPECT_EQ(judge(script, durable).verdict, Kind::violation);
}

TEST(JudgementOfOperations, TellsTheLivesOfAMemoryApartThatComesBackEmpty) {
  Script script;
  script.add("p", 5);
  script.overwrite("p", 6, 0);
  script.add("p", 7, numbers_per_life);
  script.overwrite("q", 8, numbers_per_life);
  auto result = judge(script, empty_again);
  EXPECT_EQ(result.verdict, Kind::ok) << result.report;
  EXPECT_EQ(result.grounds, "4 operations on 1 entry, in 2 lives");
  script.read("p", 7, numbers_per_life);
  EXPECT_EQ(judge(script, empty_again).verdict, Kind::violation);
}

TEST(JudgementOfOperations, DoesNotJudgeWhatItDoesNotKnow) {
  Script script;
  script.read("p", 5, 0);
  auto result = judge(script, {.subarchitecture = "a", .unknown = "nobody knows"});
  EXPECT_EQ(result.verdict, Kind::undecided);
  EXPECT_EQ(result.grounds, "nobody knows");
}

TEST(JudgementOfOperations, LeavesOutEntriesThatGoOfThemselves) {
  Script script;
  script.end(script.begin("p", "add", R"("content": 5, "has_life": true)"), R"("version": 0)");
  script.fail(script.begin("q", "read"), FailureKind::does_not_exist);
  auto result = judge(script);
  EXPECT_EQ(result.verdict, Kind::ok) << result.report;
  EXPECT_EQ(result.grounds, "0 operations on 0 entries");
}

TEST(JudgementOfOperations, WhatWasAskedAfterTheEndDoesNotCount) {
  Script script;
  script.add("p", 5);
  auto until = script.now();
  script.read("q", 4, 0);
  EXPECT_EQ(judge_operations(script.recording(), {.subarchitecture = "a"}, {}, until).verdict,
            Kind::ok);
}

// -- what was told

struct Thing {
  int number = 0;
};
CASTOR_REFLECT(Thing, number)

ChangeEventPtr told(std::uint64_t sequence, Operation operation, Version version,
                    bool coalesced = false, const std::string& source = "p") {
  ChangeEvent result;
  result.operation = operation;
  result.address = {"a", "x"};
  result.source = source;
  result.type = descriptor_of<Thing>();
  result.version = version;
  result.sequence = sequence;
  result.coalesced = coalesced;
  return std::make_shared<const ChangeEvent>(std::move(result));
}

class JudgementOfEvents : public testing::Test {
protected:
  JudgementOfEvents() {
    script_.add("p", 5);
    script_.overwrite("p", 6, 0);
  }

  Judgement judge(const std::vector<ChangeEventPtr>& x,
                  const MemoryConditions& conditions = {.subarchitecture = "a"}) const {
    return judge_events(script_.recording(), conditions, x);
  }

  Script script_;
};

TEST_F(JudgementOfEvents, IsGoodIfAllWereToldOfOnce) {
  auto result = judge({told(1, Operation::add, 0), told(2, Operation::overwrite, 1)});
  EXPECT_EQ(result.verdict, Kind::ok) << result.report;
  EXPECT_EQ(result.grounds, "2 changes");
}

TEST_F(JudgementOfEvents, SeesWhatWasNotTold) {
  auto result = judge({told(1, Operation::add, 0)});
  EXPECT_EQ(result.verdict, Kind::violation);
  EXPECT_THAT(result.report, HasSubstr("no event for the OVERWRITE"));
}

TEST_F(JudgementOfEvents, SeesWhatWasToldTwice) {
  EXPECT_EQ(judge({told(1, Operation::add, 0), told(2, Operation::overwrite, 1),
                   told(2, Operation::overwrite, 1)})
              .verdict,
            Kind::violation);
}

TEST(JudgementOfChanges, AllowsThatEntriesGoOfThemselvesIfTheyDo) {
  auto judged = [](const std::string& life) {
    Script script;
    script.end(script.begin("p", "add", R"("content": 5)" + life), R"("version": 0)");
    const std::vector<ChangeEventPtr> all{told(1, Operation::add, 0),
                                          told(2, Operation::remove, 0, false, expiry_source)};
    return judge_events(script.recording(), {.subarchitecture = "a"}, all).verdict;
  };
  EXPECT_EQ(judged(R"(, "has_life": true)"), Kind::ok);
  EXPECT_EQ(judged(""), Kind::violation);
}

TEST(JudgementOfChanges, AllowsLastWillsOfEntriesThatHaveOne) {
  auto judged = [](const std::string& life, const std::string& source) {
    Script script;
    script.end(script.begin("p", "add", R"("content": 5)" + life), R"("version": 0)");
    const std::vector<ChangeEventPtr> all{told(1, Operation::add, 0),
                                          told(2, Operation::overwrite, 1, false, source)};
    return judge_events(script.recording(), {.subarchitecture = "a"}, all).verdict;
  };
  EXPECT_EQ(judged(R"(, "has_life": true)", last_will_source), Kind::ok);
  EXPECT_EQ(judged(R"(, "has_life": true)", expiry_source), Kind::violation);
  EXPECT_EQ(judged("", last_will_source), Kind::violation);
}

TEST_F(JudgementOfEvents, IsNotPassedOnMergedOnesOrAfterALoss) {
  EXPECT_EQ(judge({told(2, Operation::overwrite, 1, true)}).verdict, Kind::undecided);
  EXPECT_EQ(judge({}, empty_again).verdict, Kind::undecided);
}

} // namespace

} // namespace castor::faults::test
