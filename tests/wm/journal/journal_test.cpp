#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tests/wm/journal/journaled_store.hpp"
#include "castor/wm/journal/journal_reader.hpp"
#include "castor/wm/journal/sqlite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Journal : public testing::Test {
protected:
  Journal() {
    options.mode = JournalMode::full;
    options.file = folder / "journals/a.castor-journal";
    options.report = [this](const std::string& x) { reports.push_back(x); };
  }

  /// What is said when the journal cannot be opened.
  std::string refusal() {
    try {
      open_journal(options, "a");
    } catch (const JournalError& e) {
      return e.what();
    }
    return "it was opened";
  }

  void overwrite_bytes(std::streamoff at, const std::string& with) {
    std::fstream file{options.file, std::ios::in | std::ios::out | std::ios::binary};
    file.seekp(at);
    file << with;
  }

  /// Ends in order.
  Picture write_some() {
    JournaledStore store{options};
    for (int i = 1; i < 20; ++i)
      store.set(static_cast<std::size_t>(i), i);
    store.sync();
    store.file().close();
    return store.picture();
  }

  TemporaryFolder folder;
  JournalOptions options;
  std::vector<std::string> reports;
};

TEST_F(Journal, GivesBackEntriesVersionsAndTheirOrder) {
  std::optional<JournaledStore> store{options};
  EXPECT_TRUE(store->set(0, 1));
  EXPECT_TRUE(store->set(1, 1));
  EXPECT_TRUE(store->set(0, 2));
  EXPECT_TRUE(store->set(2, 1));
  EXPECT_TRUE(store->set(2, 4)); // deletes it
  EXPECT_TRUE(store->write({store->change(3, 1, true), store->change(4, 1)}));
  store->sync();
  auto before = store->picture();
  store.reset();
  JournaledStore again{options};
  EXPECT_EQ(again.picture(), before);
  EXPECT_EQ(again.store().sequence(), 7u);
}

TEST_F(Journal, KnowsTypesThatThisProcessNeedNotHave) {
  JournaledStore{options}.file().close();
  {
    JournaledStore store{options};
    store.write({store.change(3, 1, true)});
    store.sync();
  }
  auto entry = *JournaledStore{options}.store().read("e3");
  EXPECT_EQ(entry->type_name(), "SignedNote");
  EXPECT_TRUE(entry->value.type().is_a("Note"));
  EXPECT_EQ(entry->value.as<SignedNote>()->author, "me");
}

TEST_F(Journal, HasNothingOfAWriteThatWasNotSynced) {
  std::optional<JournaledStore> store{options};
  store->set(0, 1);
  store->sync();
  auto before = store->picture();
  store->write({store->change(1, 1), store->change(2, 1)});
  store.reset();
  EXPECT_EQ(JournaledStore{options}.picture(), before);
}

TEST_F(Journal, SaysWhichFieldsAnOverwriteChanged) {
  {
    JournaledStore store{options};
    store.set(0, 1);
    store.set(0, 2);
    store.sync();
  }
  std::vector<FieldMask> masks;
  JournalReader{options.file}.replay([&](const JournalRecord& x) { masks.push_back(x.changed); });
  EXPECT_THAT(masks, ElementsAre(0, field_bit(*descriptor_of<Note>(), "number")));
}

TEST_F(Journal, TellsItsWritesApart) {
  {
    JournaledStore store{options};
    store.write({store.change(1, 1), store.change(2, 1)});
    store.set(0, 1);
    store.sync();
  }
  std::vector<std::uint64_t> writes;
  JournalReader{options.file}.replay([&](const JournalRecord& x) { writes.push_back(x.write); });
  EXPECT_THAT(writes, ElementsAre(1, 1, 3));
}

// --- incarnations and sessions ---

TEST_F(Journal, GoesOnWithoutAGapAfterACrashIfEverythingAcknowledgedWasSynced) {
  {
    JournaledStore store{options};
    store.set(0, 1);
    store.sync();
  }
  JournaledStore store{options};
  EXPECT_EQ(store.opened().incarnation, 0u);
  store.set(0, 2);
  store.sync();
  EXPECT_EQ(store.store().sequence(), 2u);
  EXPECT_EQ(*store.store().version("e0"), 1u);
}

TEST_F(Journal, BeginsNewNumbersIfAcknowledgedWritesMayBeLost) {
  options.mode = JournalMode::batched;
  {
    JournaledStore store{options};
    store.set(0, 1);
    store.set(1, 1);
    store.set(1, 4); // deletes it
    store.sync();
    store.set(0, 2);
  }
  auto first = numbers_per_incarnation;
  JournaledStore store{options};
  EXPECT_EQ(store.opened().incarnation, 1u);
  // Nobody who saw version 1 can take for that what somebody else writes now.
  EXPECT_EQ(*store.store().version("e0"), first);
  EXPECT_EQ(store.store().sequence(), first);
  store.set(0, 3);
  store.set(1, 3);
  store.set(2, 3);
  store.sync();
  EXPECT_EQ(*store.store().version("e0"), first + 1);
  EXPECT_EQ(*store.store().version("e1"), first + 1);
  EXPECT_EQ(*store.store().version("e2"), first);
  auto before = store.picture();
  store.file().close();
  EXPECT_EQ(JournaledStore{options}.picture(), before);
}

TEST_F(Journal, RecoversToTheSameHoweverOften) {
  options.mode = JournalMode::batched;
  write_some();
  JournaledStore{options}.file().close();
  auto before = JournaledStore{options}.picture();
  options.mode = JournalMode::full;
  // The last one ended without closing: once more numbers are given up.
  auto after = JournaledStore{options}.picture();
  EXPECT_EQ(after.entries.size(), before.entries.size());
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(JournaledStore{options}.picture(), after);
}

TEST_F(Journal, IsWrittenByWhoeverOpenedItLastAlone) {
  JournaledStore first{options};
  first.set(0, 1);
  first.sync();
  JournaledStore second{options};
  EXPECT_GT(second.opened().session, first.opened().session);
  first.set(0, 2);
  try {
    first.sync();
    ADD_FAILURE() << "both write";
  } catch (const JournalError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr(options.file.string()), HasSubstr("has taken it over"),
                                HasSubstr("process " + std::to_string(getpid()))));
  }
  second.set(0, 3);
  second.sync();
  auto before = second.picture();
  EXPECT_THROW(first.file().close(), JournalError);
  EXPECT_EQ(JournaledStore{options}.picture(), before);
}

TEST_F(Journal, IsWrittenByOneAloneOnSharedStorage) {
  options.shared = true;
  JournaledStore first{options};
  first.set(0, 1);
  first.sync();
  EXPECT_FALSE(std::filesystem::exists(options.file.string() + "-wal"));
  JournaledStore second{options};
  first.set(0, 2);
  EXPECT_THROW(first.sync(), JournalError);
  EXPECT_EQ(second.picture().sequence, 1u);
}

TEST_F(Journal, BelongsToOneSubarchitecture) {
  write_some();
  try {
    open_journal(options, "b");
    ADD_FAILURE();
  } catch (const JournalError& e) {
    EXPECT_THAT(e.what(), HasSubstr("it is the journal of a"));
  }
}

// --- growth ---

TEST_F(Journal, StaysWithinItsLimitHoweverMuchIsWritten) {
  options.limit_bytes = 200'000;
  JournaledStore store{options};
  std::uint64_t largest = 0;
  for (int i = 1; i < 5000; ++i) {
    store.set(static_cast<std::size_t>(i * 7), i);
    if (i % 10 == 0)
      store.sync();
    store.file().tidy();
    largest = std::max(largest, std::filesystem::file_size(options.file));
  }
  store.sync();
  store.tidy();
  auto before = store.picture();
  EXPECT_LT(largest, 2 * options.limit_bytes);
  EXPECT_LT(store.file().bytes(), 8'000'000u); // with the write-ahead log
  EXPECT_EQ(JournaledStore{options}.picture(), before);
}

TEST_F(Journal, KeepsEverythingIfItIsARecording) {
  options.limit_bytes = 0;
  options.keep = true;
  {
    JournaledStore store{options};
    for (int i = 1; i < 100; ++i) {
      store.set(0, i);
      store.sync();
      store.tidy();
    }
  }
  EXPECT_EQ(JournalReader{options.file}.summary().changes, 99u);
}

TEST_F(Journal, ForgetsTheOldestDeletionsAsTheStoreDoes) {
  options.remembered_deletions = 2;
  options.limit_bytes = 0;
  std::optional<JournaledStore> store{options};
  for (std::size_t i = 0; i < 5; ++i) {
    store->set(i, 1);
    store->set(i, 2);
    store->set(i, 4); // deletes it
    store->sync();
    store->tidy();
  }
  auto before = store->picture();
  store.reset();
  EXPECT_EQ(JournaledStore{options}.picture(), before);
}

// --- failures ---

TEST_F(Journal, IsRefusedWhereItCannotBeMade) {
  std::ofstream{folder / "file"} << "in the way";
  options.file = folder / "file/a.castor-journal";
  EXPECT_THAT(refusal(), AllOf(HasSubstr(options.file.string()), HasSubstr("--journal-dir")));
}

TEST_F(Journal, IsRefusedIfTheFileIsSomethingElse) {
  std::filesystem::create_directories(options.file.parent_path());
  std::ofstream{options.file} << "this is no journal, but precious all the same";
  EXPECT_THAT(refusal(), HasSubstr("move it away"));
  std::ifstream in{options.file};
  std::string text;
  std::getline(in, text);
  EXPECT_EQ(text, "this is no journal, but precious all the same");
}

TEST_F(Journal, IsRefusedIfItWasEmptied) {
  write_some();
  std::filesystem::resize_file(options.file, 0);
  EXPECT_THAT(refusal(), HasSubstr("It is damaged"));
  EXPECT_EQ(std::filesystem::file_size(options.file), 0u);
}

TEST_F(Journal, IsRefusedIfOnlyItsWriteAheadLogIsLeft) {
  JournaledStore store{options};
  store.set(0, 1);
  store.sync();
  std::filesystem::remove(options.file);
  EXPECT_THAT(refusal(), HasSubstr("-wal"));
}

TEST_F(Journal, IsRefusedIfAByteOfAValueIsWrong) {
  write_some();
  std::ifstream in{options.file, std::ios::binary};
  std::string all{std::istreambuf_iterator<char>{in}, {}};
  overwrite_bytes(static_cast<std::streamoff>(all.find("text")), "next");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("checksum"), HasSubstr("castor journal show")));
  EXPECT_THROW(JournalReader{options.file}.replay(), JournalError);
}

TEST_F(Journal, IsRefusedIfRowsAreMissingOfWhichNoOtherTells) {
  int number = 0;
  for (bool folded : {false, true})
    for (auto* what : {"log WHERE sequence = 2", "log WHERE sequence = 4",
                       "entries WHERE id = 'e1'", "deleted", "sessions"}) {
      if (folded == std::string{what}.starts_with("log"))
        continue;
      SCOPED_TRACE(what);
      options.file = folder / std::to_string(++number);
      options.limit_bytes = folded ? 0 : 1'000'000;
      {
        JournaledStore store{options};
        for (std::size_t i = 0; i < 4; ++i)
          store.set(i, 1);
        if (folded)
          store.set(0, 4); // deletes it
        store.sync();
        store.tidy();
        if (folded)
          store.set(5, 1);
        store.sync();
        store.file().close();
      }
      sqlite::Database{options.file, sqlite::OpenMode::write}.run(
        ("DELETE FROM " + std::string{what}).c_str());
      EXPECT_THAT(refusal(), HasSubstr("missing"));
    }
}

TEST_F(Journal, DoesNothingThatWasAddedToItsSchema) {
  write_some();
  sqlite::Database{options.file, sqlite::OpenMode::write}.run(
    "CREATE TRIGGER swallow BEFORE INSERT ON log BEGIN SELECT RAISE(IGNORE); END");
  auto write = [&] {
    JournaledStore store{options};
    store.set(0, 1);
    store.sync();
    store.file().close();
    return store.picture();
  };
  auto written = write();
  EXPECT_EQ(JournaledStore{options}.picture(), written);
}

TEST_F(Journal, IsMovedAsideIfItIsDamagedAndTheWorkingMemoryIsToGoOn) {
  write_some();
  options.go_on_without = true;
  for (int i = 1; i <= 2; ++i) {
    overwrite_bytes(100, "damage damage damage");
    JournaledStore store{options};
    EXPECT_THAT(store.picture().entries, IsEmpty());
    auto aside = options.file.string() + ".corrupt-" + std::to_string(i);
    EXPECT_TRUE(std::filesystem::exists(aside));
    ASSERT_EQ(reports.size(), static_cast<std::size_t>(i));
    EXPECT_THAT(reports.back(), AllOf(HasSubstr("damaged"), HasSubstr(aside)));
    store.set(0, 1);
    store.sync();
    store.file().close();
  }
}

TEST_F(Journal, IsDoneWithoutIfItCannotBeMadeAndTheWorkingMemoryIsToGoOn) {
  std::ofstream{folder / "file"} << "in the way";
  options.file = folder / "file/a.castor-journal";
  options.go_on_without = true;
  auto opened = open_journal(options, "a");
  EXPECT_EQ(opened.file, nullptr);
  EXPECT_THAT(opened.failure, HasSubstr(options.file.string()));
  EXPECT_THAT(reports, ElementsAre(HasSubstr("goes on without a journal")));
}

/// Files may not grow beyond so many bytes.
class FileLimit {
public:
  explicit FileLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limited{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

private:
  rlimit before_{};
};

TEST_F(Journal, SaysSoWhenThereIsNoRoomAndHasWhatWasSyncedBefore) {
  Picture synced;
  {
    JournaledStore store{options};
    FileLimit limit{100'000};
    try {
      for (int i = 1; i < 10'000; ++i) {
        synced = store.picture();
        store.set(0, i);
        store.sync();
      }
      ADD_FAILURE() << "there is no end to it";
    } catch (const JournalError& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(options.file.string()), HasSubstr("room")));
    }
  }
  EXPECT_GT(synced.sequence, 5u);
  EXPECT_EQ(JournaledStore{options}.picture(), synced);
}

} // namespace

} // namespace castor::test
