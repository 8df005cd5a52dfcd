#include "castor/tools/chaos/journal_snapshot.hpp"

#include "castor/base/text_file.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

namespace castor::faults {

namespace {

TEST(JournalSnapshot, RestoresWhatThereWasAndRemovesWhatThereWasNot) {
  const castor::test::TemporaryFolder folder;
  const auto known = folder / "known.journal";
  const auto fresh = folder / "fresh.journal";
  save_text(known, "before");
  save_text(known.string() + "-wal", "written before");
  {
    const JournalSnapshot snapshot{{{"a", known}, {"b", fresh}}};
    save_text(known, "changed");
    std::filesystem::remove(known.string() + "-wal");
    save_text(known.string() + "-shm", "new");
    save_text(fresh, "new");
    save_text(fresh.string() + "-wal", "new");
  }
  EXPECT_EQ(load_text(known), "before");
  EXPECT_EQ(load_text(known.string() + "-wal"), "written before");
  EXPECT_FALSE(exists(std::filesystem::path{known.string() + "-shm"}));
  EXPECT_FALSE(exists(fresh));
  EXPECT_FALSE(exists(std::filesystem::path{fresh.string() + "-wal"}));
}

TEST(JournalSnapshot, OfNothingDoesNothing) {
  EXPECT_NO_THROW(JournalSnapshot{{}});
}

} // namespace

} // namespace castor::faults
