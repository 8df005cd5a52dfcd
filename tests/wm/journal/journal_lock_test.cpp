#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tests/wm/journal/journaled_store.hpp"
#include "castor/wm/journal/journal_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

namespace castor::test {

namespace {

using testing::AllOf;
using testing::HasSubstr;

class JournalLocks : public testing::Test {
protected:
  JournalLocks() {
    options.mode = JournalMode::full;
    options.file = folder / "journals/a.castor-journal";
    options.system = "first-1-1";
    other = options;
    other.system = "second-2-2";
  }

  static std::string refusal(const std::function<void()>& f) {
    try {
      f();
    } catch (const JournalError& e) {
      return e.what();
    }
    return "nothing was refused";
  }

  static std::string refusal(const JournalOptions& x) {
    return refusal([&] { open_journal(x, "a"); });
  }

  std::filesystem::path lock() const { return options.file.string() + ".lock"; }

  TemporaryFolder folder;
  JournalOptions options;
  JournalOptions other;
};

TEST_F(JournalLocks, RefuseASecondSystemByNameAndProcess) {
  JournaledStore first{options};
  EXPECT_THAT(refusal(other),
              AllOf(HasSubstr(options.file.string()),
                    HasSubstr("system first-1-1, process " + std::to_string(getpid()) + " on "),
                    HasSubstr("--journal-dir")));
  first.set(0, 1);
  first.sync(); // nothing was taken away from it
}

TEST_F(JournalLocks, TellOthersWhetherTheyAreHeld) {
  EXPECT_FALSE(is_locked(options.file));
  {
    JournaledStore first{options};
    EXPECT_TRUE(is_locked(options.file));
    first.set(0, 1);
    first.sync();
  }
  EXPECT_FALSE(is_locked(options.file));
}

TEST_F(JournalLocks, LetASecondSystemGoOnWithoutAJournalIfItMay) {
  JournaledStore first{options};
  other.go_on_without = true;
  std::string report;
  other.report = [&](const std::string& x) { report = x; };
  EXPECT_EQ(open_journal(other, "a").file, nullptr);
  EXPECT_THAT(report, HasSubstr("first-1-1"));
  EXPECT_FALSE(std::filesystem::exists(options.file.string() + ".corrupt-1"));
}

TEST_F(JournalLocks, AreFreeAfterTheEndWhetherOrderlyOrNot) {
  {
    JournaledStore first{options};
    first.file().close();
    EXPECT_FALSE(std::filesystem::exists(lock()));
  }
  { JournaledStore second{other}; }
  EXPECT_TRUE(std::filesystem::exists(lock()));
  JournaledStore third{options};
}

TEST_F(JournalLocks, AreFreeOnceTheProcessWasKilled) {
  std::array<int, 2> opened{};
  ASSERT_EQ(pipe(opened.data()), 0);
  auto child = fork();
  if (child == 0) {
    JournaledStore store{options};
    auto done = write(opened[1], "x", 1);
    pause();
    _exit(done == 1 ? 0 : 1);
  }
  char x = 0;
  ASSERT_EQ(read(opened[0], &x, 1), 1);
  EXPECT_THAT(refusal(other), HasSubstr("process " + std::to_string(child)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  JournaledStore second{other};
  ::close(opened[0]);
  ::close(opened[1]);
}

TEST_F(JournalLocks, GoToALaterOpenerOfTheSameSystemForGood) {
  std::optional<JournaledStore> before{options};
  options.returning = true;
  JournaledStore after{options};
  before->set(0, 1);
  EXPECT_THAT(refusal([&] { before->sync(); }), HasSubstr("has taken it over"));
  before.reset();
  after.set(0, 2);
  after.sync();
  after.tidy(); // which takes the lock that the other held
  EXPECT_THAT(refusal(other), HasSubstr("system first-1-1"));
}

TEST_F(JournalLocks, AreLostForGoodToASystemThatCameInBetween) {
  { JournaledStore first{options}; }
  { JournaledStore second{other}; }
  options.returning = true;
  EXPECT_THAT(refusal(options), HasSubstr("system second-2-2"));
  EXPECT_THAT(refusal(options), HasSubstr("has taken it over"));
}

TEST_F(JournalLocks, AreTakenAgainIfSomebodyRemovesThem) {
  JournaledStore first{options};
  std::filesystem::remove(lock());
  first.tidy();
  EXPECT_THAT(refusal(other), HasSubstr("system first-1-1"));
}

TEST_F(JournalLocks, AreRefusedAsALinkToSomethingElse) {
  std::ofstream{folder / "precious"} << "text";
  std::filesystem::create_directories(lock().parent_path());
  std::filesystem::create_symlink(folder / "precious", lock());
  EXPECT_THAT(refusal(options), HasSubstr(lock().string()));
  std::ifstream in{folder / "precious"};
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>{in}, {}}), "text");
}

TEST_F(JournalLocks, LeaveNoDescriptorBehindWhenTheyAreRefused) {
  JournaledStore first{options};
  auto lowest_free = [] {
    int descriptor = dup(0);
    ::close(descriptor);
    return descriptor;
  };
  auto before = lowest_free();
  for (int i = 0; i < 10; ++i)
    refusal(other);
  EXPECT_EQ(lowest_free(), before);
}

/// What happens to the files of a journal that is in use.
class JournalsInUse : public JournalLocks {
protected:
  std::string failure_after(const std::function<void()>& f) {
    JournaledStore store{options};
    store.set(0, 1);
    store.sync();
    f();
    store.set(0, 2);
    return refusal([&] { store.sync(); });
  }
};

TEST_F(JournalsInUse, FailIfTheirFileIsRemoved) {
  EXPECT_THAT(failure_after([&] { std::filesystem::remove(options.file); }),
              AllOf(HasSubstr(options.file.string()), HasSubstr("removed or moved")));
}

TEST_F(JournalsInUse, FailIfTheirWriteAheadLogIsRemoved) {
  EXPECT_THAT(failure_after([&] { std::filesystem::remove(options.file.string() + "-wal"); }),
              HasSubstr("-wal was removed or moved"));
}

TEST_F(JournalsInUse, FailIfTheirFolderIsMoved) {
  EXPECT_THAT(
    failure_after([&] { std::filesystem::rename(options.file.parent_path(), folder / "away"); }),
    HasSubstr("removed or moved"));
}

TEST_F(JournalsInUse, FailIfTheirFolderIsRemoved) {
  EXPECT_THAT(failure_after([&] { std::filesystem::remove_all(options.file.parent_path()); }),
              HasSubstr("removed or moved"));
}

TEST_F(JournalsInUse, FailIfAnotherFileIsPutInTheirPlace) {
  EXPECT_THAT(failure_after([&] {
                auto copy = options.file.string() + ".copy";
                std::filesystem::copy_file(options.file, copy);
                std::filesystem::rename(copy, options.file);
              }),
              HasSubstr("was replaced by another file"));
}

TEST_F(JournalsInUse, FailOnSharedStorageToo) {
  options.shared = true;
  EXPECT_THAT(failure_after([&] { std::filesystem::remove(options.file); }),
              HasSubstr("removed or moved"));
}

TEST_F(JournalsInUse, AreNotBegunAnewByTheSystemThatHadThem) {
  failure_after([&] { std::filesystem::remove_all(options.file.parent_path()); });
  options.returning = true;
  EXPECT_THAT(refusal(options), AllOf(HasSubstr(options.file.string()), HasSubstr("put it back")));
  EXPECT_FALSE(std::filesystem::exists(options.file));
}

} // namespace

} // namespace castor::test
