#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tests/wm/journal/journaled_store.hpp"
#include "castor/tests/wm/journal/power_cut.hpp"
#include "castor/wm/journal/journal_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

namespace castor::test {

namespace {

/// What may happen to a store with a journal.
enum class Step { one, two, sync, tidy, crash, end };

JournalOptions options_for(const TemporaryFolder& folder) {
  JournalOptions result;
  result.mode = JournalMode::full;
  result.file = folder / "a.castor-journal";
  result.limit_bytes = 40'000;
  result.remembered_deletions = 3;
  return result;
}

RC_GTEST_PROP(JournalProperties, WhateverWasSyncedComesBackHoweverItWasFolded, ()) {
  TemporaryFolder folder;
  auto options = options_for(folder);
  options.limit_bytes = *rc::gen::element<std::uint64_t>(0, 60'000, 1'000'000);
  using Change = std::tuple<Step, unsigned, int>;
  auto steps = *rc::gen::container<std::vector<Change>>(
    rc::gen::tuple(rc::gen::weightedElement<Step>({{12, Step::one},
                                                   {4, Step::two},
                                                   {4, Step::sync},
                                                   {2, Step::tidy},
                                                   {1, Step::crash},
                                                   {1, Step::end}}),
                   rc::gen::arbitrary<unsigned>(), rc::gen::inRange(1, 100)));
  std::optional<JournaledStore> store{options};
  auto synced = store->picture();
  for (auto& [step, entry, number] : steps)
    switch (step) {
      case Step::one:
        store->set(entry, number);
        break;
      case Step::two:
        store->write({store->change(entry, number), store->change(entry + 1, number, true)});
        break;
      case Step::sync:
        store->sync();
        synced = store->picture();
        break;
      case Step::tidy:
        store->tidy();
        break;
      case Step::end:
        store->sync();
        synced = store->picture();
        store->file().close();
        [[fallthrough]];
      case Step::crash:
        store.reset();
        store.emplace(options);
        RC_ASSERT(store->picture() == synced);
        break;
    }
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

RC_GTEST_PROP(JournalProperties, NothingThatWasTamperedWithIsTakenForWhatWasWritten, ()) {
  TemporaryFolder folder;
  auto options = options_for(folder);
  bool clean = *rc::gen::arbitrary<bool>();
  std::vector<Picture> pictures;
  {
    JournaledStore store{options};
    pictures.push_back(store.picture());
    auto n = *rc::gen::inRange(1, 60);
    for (int i = 1; i < n; ++i) {
      store.write({store.change(static_cast<std::size_t>(i * 5), i)});
      pictures.push_back(store.picture());
      store.sync();
      store.file().tidy();
    }
    // The write-ahead log is what a crash leaves behind.
    if (!clean)
      for (auto* suffix : {"", "-wal"})
        std::filesystem::copy_file(options.file.string() + suffix,
                                   (folder / "copy").string() + suffix);
  }
  auto copy = folder / "copy";
  if (clean)
    std::filesystem::copy_file(options.file, copy);
  auto target = copy.string() + (!clean && *rc::gen::arbitrary<bool>() ? "-wal" : "");
  auto content = content_of(target);
  auto times = *rc::gen::inRange(1, 6);
  for (int i = 0; i < times && !content.empty(); ++i) {
    auto at = *rc::gen::inRange<std::size_t>(0, content.size());
    auto length = *rc::gen::element<std::size_t>(1, 1, 8, 512, 4096);
    auto bits = *rc::gen::inRange(0, 256);
    for (std::size_t k = at; k < std::min(content.size(), at + length); ++k)
      content[k] = static_cast<char>(bits == 0 ? 0 : content[k] ^ bits);
  }
  if (*rc::gen::inRange(0, 5) == 0)
    content.resize(*rc::gen::inRange<std::size_t>(0, content.size() + 1));
  std::ofstream{target, std::ios::binary}.write(content.data(),
                                                static_cast<std::streamsize>(content.size()));
  options.file = copy;
  try {
    JournaledStore store{options};
    auto found = store.picture();
    RC_ASSERT(std::find(pictures.begin(), pictures.end(), found) != pictures.end());
    // What was synced into the file itself does not go.
    if (clean)
      RC_ASSERT(found == pictures.back());
    RC_TAG("opened");
  } catch (const JournalError&) {
    RC_TAG("refused");
  }
}

/// Cuts the power at random moments of a life with a journal; each image with what was
/// acknowledged by then, and what might be there besides.
struct Cut {
  DiskImage image;
  std::size_t acknowledged = 0;
  std::size_t written = 0;
};

TEST(JournalPowerCut, LosesNothingThatWasAcknowledged) {
  // CASTOR_POWER_CUTS=1000 cuts it so often.
  auto* wanted = std::getenv("CASTOR_POWER_CUTS");
  const std::size_t cuts_wanted = wanted ? std::strtoul(wanted, nullptr, 10) : 150;
  std::size_t cut = 0;
  std::size_t lost_unsynced = 0;
  for (std::uint64_t seed = 0; cut < cuts_wanted; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random{seed};
    TemporaryFolder folder;
    auto options = options_for(folder);
    options.shared = seed % 4 == 3;
    JournaledStore{options}.file().close();
    PowerCut disk;
    options.vfs = PowerCut::name;
    std::vector<Cut> cuts;
    // After each write; the last of them may be under way.
    std::vector<Picture> pictures;
    std::size_t acknowledged = 0;
    {
      JournaledStore store{options};
      pictures.push_back(store.picture());
      disk.on_operation = [&] {
        if (random() % 40 == 0)
          cuts.push_back({disk.image(random), acknowledged, pictures.size()});
      };
      for (int i = 1; i < 120; ++i) {
        if (random() % 3 == 0)
          store.write({store.change(random(), i), store.change(random(), i, true)});
        else
          store.set(random(), i);
        pictures.push_back(store.picture());
        if (random() % 3 > 0)
          continue;
        store.sync();
        acknowledged = pictures.size() - 1;
        if (random() % 2 == 0)
          store.file().tidy();
      }
      disk.on_operation = nullptr;
    }
    for (auto& x : cuts) {
      put(x.image, folder / "after");
      auto after = options;
      after.vfs.clear();
      after.file = folder / "after/a.castor-journal";
      auto found = JournaledStore{after}.picture();
      auto first = pictures.begin() + static_cast<std::ptrdiff_t>(x.acknowledged);
      auto last = pictures.begin() + static_cast<std::ptrdiff_t>(x.written);
      auto is = std::find(first, last, found);
      ASSERT_NE(is, last) << "acknowledged was " << *first << "\nbut there is " << found;
      lost_unsynced += is != last - 1;
    }
    cut += cuts.size();
  }
  EXPECT_GT(lost_unsynced, 0u) << "nothing was ever lost: no power was cut";
  RecordProperty("power_cuts", static_cast<int>(cut));
}

TEST(JournalFailure, IsNoticedAtWhateverOperationOfTheDiskItComes) {
  for (bool is_full : {false, true})
    for (std::size_t number = 0;; ++number) {
      SCOPED_TRACE(number);
      TemporaryFolder folder;
      auto options = options_for(folder);
      JournaledStore{options}.file().close();
      PowerCut disk;
      options.vfs = PowerCut::name;
      std::optional<JournaledStore> store{options};
      disk.fails_from = disk.operations() + number;
      disk.is_full = is_full;
      auto synced = store->picture();
      bool failed = false;
      try {
        for (int i = 1; i < 30; ++i) {
          store->set(static_cast<std::size_t>(i), i);
          store->sync();
          synced = store->picture();
          store->file().tidy();
        }
      } catch (const JournalError& e) {
        failed = true;
        EXPECT_THAT(e.what(), testing::HasSubstr("cannot be written"));
      }
      store.reset();
      disk.fails_from = ~std::size_t{0};
      options.vfs.clear();
      // The write that was refused may be there or not, like one that was not answered.
      auto found = JournaledStore{options}.picture();
      EXPECT_TRUE(found == synced || found.sequence == synced.sequence + 1) << found;
      if (!failed)
        break;
    }
}

} // namespace

} // namespace castor::test
