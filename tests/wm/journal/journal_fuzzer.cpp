// Damages the file of a sound journal, and reads and opens what that makes: the input is a list of
// patches.

#include "castor/tests/support/fuzzing.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/journal/journal_reader.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace castor;
using test::require;

struct FuzzNote {
  std::int64_t number = 0;
  std::string text;
};
CASTOR_REFLECT(FuzzNote, number, text)

/// In memory, for as long as the process lives.
class Folder {
public:
  Folder() : path_("/dev/shm/castor-journal-fuzzer-" + std::to_string(getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

const std::filesystem::path& folder() {
  static const Folder result;
  return result.path();
}

JournalOptions options() {
  JournalOptions result;
  result.mode = JournalMode::full;
  result.file = folder() / "a.castor-journal";
  return result;
}

JournalGroupPtr one_write(EntryStore& store, int i) {
  WriteRequest x;
  x.address = {"a", "e" + std::to_string(i % 5)};
  x.client = std::make_shared<const Client>(Client{"c", "a"});
  if (auto old = store.read(x.address.id)) {
    x.operation = i % 3 == 0 ? Operation::remove : Operation::overwrite;
    x.last_seen = (*old)->version;
  }
  if (x.operation != Operation::remove)
    x.value = Value::of(FuzzNote{i, "text"});
  auto effect = store.prepare(x);
  require(static_cast<bool>(effect));
  auto entry = effect->entry;
  auto before = effect->before;
  auto event = store.commit(*std::move(effect), Timestamp{i});
  auto group = std::make_shared<JournalGroup>();
  group->push_back(record_of(*event, *entry, before, UnixTime{0}));
  return group;
}

/// The bytes of a journal with entries, deletions and changes, of which some are folded.
std::string sound_journal() {
  auto with = options();
  with.limit_bytes = 1;
  auto opened = open_journal(with, "a");
  EntryStore store{"a"};
  for (int i = 1; i < 60; ++i) {
    opened.file->append({one_write(store, i)});
    if (i == 40)
      while (opened.file->tidy()) {
        // Until all is folded.
      }
  }
  opened.file->close();
  opened.file.reset();
  std::ifstream in{with.file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

/// Patches: two bytes of place, in units of an eighth of what they can reach, one of length, and
/// what is to stand there. Length 255 cuts the file off there.
std::string damaged(std::string bytes, std::span<const std::uint8_t> patches) {
  while (patches.size() > 3) {
    auto place = (std::size_t{patches[0]} << 8 | patches[1]) * bytes.size() / 0x10000;
    auto length = std::size_t{patches[2]};
    patches = patches.subspan(3);
    if (length == 255) {
      bytes.resize(place);
      return bytes;
    }
    for (std::size_t i = 0; i < length && !patches.empty() && place + i < bytes.size(); ++i) {
      bytes[place + i] = static_cast<char>(patches.front());
      patches = patches.subspan(1);
    }
  }
  return bytes;
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto sound = sound_journal();
  auto with = options();
  for (auto* suffix : {"-wal", "-shm", ".lock"})
    std::filesystem::remove(with.file.string() + suffix);
  {
    std::ofstream out{with.file, std::ios::binary | std::ios::trunc};
    out << damaged(sound, {data, size});
  }
  std::uint64_t read = 0;
  bool is_readable = false;
  try {
    JournalReader{with.file}.replay([&](const JournalRecord& x) { read = x.sequence; });
    is_readable = true;
  } catch (const JournalError&) {
    // As it should be.
  }
  try {
    auto opened = open_journal(with, "a");
    // What opens is sound, so it can be read, and what is in it comes back.
    require(is_readable);
    require(opened.image.sequence >= read);
    opened.file->close();
    opened.file.reset();
    auto again = open_journal(with, "a");
    require(again.image.sequence == opened.image.sequence);
    require(again.image.entries.size() == opened.image.entries.size());
    again.file->close();
  } catch (const JournalError&) {
    // As it should be.
  }
  return 0;
}
