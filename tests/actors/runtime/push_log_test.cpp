#include "castor/actors/runtime/push_log.hpp"
#include "castor/actors/runtime/push_recorder.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/wm/journal/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

struct Picture {
  std::vector<std::uint8_t> bytes;
  std::int64_t number = 0;
};
CASTOR_REFLECT(Picture, bytes, number)

struct Word {
  std::string text;
};
CASTOR_REFLECT(Word, text)

/// A picture of 1 MB, all of one colour.
Value picture(std::uint8_t colour, std::int64_t number) {
  return Value::of(Picture{std::vector<std::uint8_t>(1'000'000, colour), number});
}

class PushLog : public testing::Test {
protected:
  PushLogWriter writer() const { return {file, "camera"}; }

  static void append(PushLogWriter& log, std::vector<RecordedPush> all) {
    log.begin();
    for (auto& x : all)
      log.append(x);
    log.commit();
  }

  std::vector<RecordedPush> read() const {
    PushLogReader reader{file};
    std::vector<RecordedPush> result;
    while (auto x = reader.next())
      result.push_back(*std::move(x));
    return result;
  }

  PushLogSummary summary() const { return PushLogReader{file}.summary(); }

  TemporaryFolder folder;
  const std::filesystem::path file = folder / "camera.castor-pushes";
};

TEST_F(PushLog, GivesBackWhatWasHandedOut) {
  {
    auto log = writer();
    append(log, {{1ms, true, picture(7, 1)},
                 {2ms, false, Value::of(Word{"hello"})},
                 {3ms, false, Value::of(Word{""})}});
  }
  auto all = read();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].time, 1ms);
  EXPECT_TRUE(all[0].pushed);
  EXPECT_EQ(all[0].value, picture(7, 1));
  EXPECT_FALSE(all[1].pushed);
  EXPECT_EQ(all[1].value.as<Word>()->text, "hello");
  EXPECT_EQ(all[2].value.as<Word>()->text, "");
  auto x = summary();
  EXPECT_EQ(x.provider, "camera");
  EXPECT_EQ(x.pushes, 1u);
  EXPECT_EQ(x.pulls, 2u);
  EXPECT_EQ(x.first, 1ms);
  EXPECT_EQ(x.last, 3ms);
  EXPECT_EQ(PushLogReader{file}.first_of_each_type().size(), 2u);
}

TEST_F(PushLog, StoresOnceWhatDoesNotChange) {
  auto log = writer();
  for (int i = 0; i < 50; ++i)
    append(log, {{i * 1ms, true, picture(7, i)}});
  EXPECT_LT(log.bytes(), 6'000'000u);
  auto all = read();
  ASSERT_EQ(all.size(), 50u);
  EXPECT_EQ(all[49].value, picture(7, 49));
  EXPECT_EQ(all[0].value, picture(7, 0));
}

TEST_F(PushLog, DropsTheOldestAndKeepsWhatOthersShareWithIt) {
  auto log = writer();
  append(log, {{1ms, true, picture(7, 1)}, {2ms, true, picture(7, 2)}, {3ms, true, picture(8, 3)}});
  log.begin();
  log.drop_oldest();
  log.commit();
  EXPECT_GT(log.bytes(), 1'900'000u);
  auto all = read();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].value, picture(7, 2));
  log.begin();
  log.drop_oldest();
  log.commit();
  EXPECT_LT(log.bytes(), 1'100'000u);
  append(log, {{4ms, true, picture(8, 4)}});
  EXPECT_LT(log.bytes(), 1'200'000u);
  EXPECT_EQ(read().back().value, picture(8, 4));
  EXPECT_EQ(summary().dropped, 2u);
}

TEST_F(PushLog, GoesOnWithTheFileOfAPredecessor) {
  {
    auto log = writer();
    append(log, {{1ms, true, picture(7, 1)}, {2ms, true, picture(7, 2)}});
  }
  auto log = writer();
  append(log, {{3ms, true, picture(9, 3)}});
  log.begin();
  log.drop_oldest();
  log.drop_oldest();
  log.commit();
  auto all = read();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].value, picture(9, 3));
  EXPECT_LT(log.bytes(), 1'100'000u);
}

TEST_F(PushLog, RefusesWhatIsNone) {
  EXPECT_THROW(PushLogReader{file}, JournalError);
  std::ofstream{file} << "something else";
  try {
    PushLogReader reader{file};
    FAIL();
  } catch (const JournalError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr(file.string()));
  }
}

TEST_F(PushLog, FindsDamage) {
  {
    auto log = writer();
    append(log, {{1ms, true, picture(7, 1)}});
  }
  sqlite::Database{file, sqlite::OpenMode::write}.run(
    "UPDATE chunks SET bytes = zeroblob(length(bytes)) WHERE number = 3");
  EXPECT_THROW(read(), JournalError);
}

TEST_F(PushLog, ARecorderStaysWithinItsLimitAndKeepsTheNewest) {
  {
    PushRecorder recorder{folder.path(), 5'000'000};
    for (int i = 0; i < 20; ++i)
      recorder.record("camera", true, picture(static_cast<std::uint8_t>(i), i));
    recorder.record("laser", true, Value::of(Word{"scan"}));
  }
  auto x = summary();
  EXPECT_LE(x.bytes, 5'000'000u);
  EXPECT_EQ(x.pushes, 4u);
  EXPECT_EQ(x.dropped, 16u);
  EXPECT_EQ(x.lost, 0u);
  EXPECT_EQ(read().back().value, picture(19, 19));
  EXPECT_EQ(PushLogReader{folder / "laser.castor-pushes"}.summary().pushes, 1u);
}

} // namespace

} // namespace castor::test
