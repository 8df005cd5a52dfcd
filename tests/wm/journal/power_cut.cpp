#include "castor/tests/wm/journal/power_cut.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

namespace castor::test {

namespace {

using Content = std::vector<std::uint8_t>;

struct Write {
  std::size_t at = 0;
  Content data;
};
struct Truncation {
  std::size_t size = 0;
};
using Unsynced = std::variant<Write, Truncation>;

constexpr std::size_t sector = 512;

void apply(const Write& x, Content& to, std::size_t from, std::size_t size) {
  auto end = x.at + from + size;
  if (to.size() < end)
    to.resize(end);
  std::memcpy(to.data() + x.at + from, x.data.data() + from, size);
}

struct Disk {
  struct File {
    Content synced;
    std::vector<Unsynced> unsynced;
  };

  PowerCut* owner = nullptr;
  std::map<std::string, File> files;
  std::size_t operations = 0;
  sqlite3_vfs* real = nullptr;

  /// Whether the operation is to fail.
  std::optional<int> begin(int error) {
    if (owner->on_operation)
      owner->on_operation();
    if (operations++ < owner->fails_from)
      return std::nullopt;
    return owner->is_full ? SQLITE_FULL : error;
  }
};

/// As SQLite wants it: its own part first, and the real file after it.
struct Shim {
  sqlite3_file base;
  Disk* disk;
  /// Null for a file that needs not survive.
  Disk::File* shadow;

  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

Shim* shim(sqlite3_file* x) {
  return reinterpret_cast<Shim*>(x);
}

sqlite3_file* real(sqlite3_file* x) {
  return shim(x)->real();
}

int close_file(sqlite3_file* x) {
  return real(x)->pMethods->xClose(real(x));
}

int read_file(sqlite3_file* x, void* to, int size, sqlite3_int64 at) {
  return real(x)->pMethods->xRead(real(x), to, size, at);
}

int write_file(sqlite3_file* x, const void* data, int size, sqlite3_int64 at) {
  if (auto* shadow = shim(x)->shadow) {
    if (auto failure = shim(x)->disk->begin(SQLITE_IOERR_WRITE))
      return *failure;
    auto* bytes = static_cast<const std::uint8_t*>(data);
    shadow->unsynced.push_back(Write{static_cast<std::size_t>(at), {bytes, bytes + size}});
  }
  return real(x)->pMethods->xWrite(real(x), data, size, at);
}

int truncate_file(sqlite3_file* x, sqlite3_int64 size) {
  if (auto* shadow = shim(x)->shadow)
    shadow->unsynced.push_back(Truncation{static_cast<std::size_t>(size)});
  return real(x)->pMethods->xTruncate(real(x), size);
}

int sync_file(sqlite3_file* x, int) {
  auto* shadow = shim(x)->shadow;
  if (!shadow)
    return SQLITE_OK;
  if (auto failure = shim(x)->disk->begin(SQLITE_IOERR_FSYNC))
    return *failure;
  for (auto& change : std::exchange(shadow->unsynced, {})) {
    if (auto* part = std::get_if<Write>(&change))
      apply(*part, shadow->synced, 0, part->data.size());
    else
      shadow->synced.resize(std::get<Truncation>(change).size);
  }
  return SQLITE_OK;
}

const sqlite3_io_methods methods = {
  2,
  close_file,
  read_file,
  write_file,
  truncate_file,
  sync_file,
  [](sqlite3_file* x, sqlite3_int64* size) { return real(x)->pMethods->xFileSize(real(x), size); },
  [](sqlite3_file* x, int level) { return real(x)->pMethods->xLock(real(x), level); },
  [](sqlite3_file* x, int level) { return real(x)->pMethods->xUnlock(real(x), level); },
  [](sqlite3_file* x, int* result) {
    return real(x)->pMethods->xCheckReservedLock(real(x), result);
  },
  [](sqlite3_file* x, int what, void* argument) {
    return real(x)->pMethods->xFileControl(real(x), what, argument);
  },
  [](sqlite3_file* x) { return real(x)->pMethods->xSectorSize(real(x)); },
  [](sqlite3_file* x) { return real(x)->pMethods->xDeviceCharacteristics(real(x)); },
  [](sqlite3_file* x, int page, int size, int extend, void volatile** to) {
    return real(x)->pMethods->xShmMap(real(x), page, size, extend, to);
  },
  [](sqlite3_file* x, int offset, int n, int flags) {
    return real(x)->pMethods->xShmLock(real(x), offset, n, flags);
  },
  [](sqlite3_file* x) { real(x)->pMethods->xShmBarrier(real(x)); },
  [](sqlite3_file* x, int erase) { return real(x)->pMethods->xShmUnmap(real(x), erase); },
  nullptr,
  nullptr,
};

Content content_on_disk(const std::string& path) {
  std::ifstream in{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

int open_file(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* result) {
  auto* disk = static_cast<Disk*>(vfs->pAppData);
  auto* x = shim(file);
  x->disk = disk;
  x->shadow = nullptr;
  auto code = disk->real->xOpen(disk->real, path, x->real(), flags, result);
  x->base.pMethods = code == SQLITE_OK ? &methods : nullptr;
  if (code == SQLITE_OK && path) {
    auto [i, is_new] = disk->files.try_emplace(path);
    if (is_new)
      i->second.synced = content_on_disk(path);
    x->shadow = &i->second;
  }
  return code;
}

int remove_file(sqlite3_vfs* vfs, const char* path, int sync_directory) {
  auto* disk = static_cast<Disk*>(vfs->pAppData);
  disk->files.erase(path);
  return disk->real->xDelete(disk->real, path, sync_directory);
}

} // namespace

struct PowerCut::Parts {
  Disk disk;
  sqlite3_vfs vfs{};
};

PowerCut::PowerCut() : parts_(std::make_unique<Parts>()) {
  auto& disk = parts_->disk;
  disk.owner = this;
  disk.real = sqlite3_vfs_find(nullptr);
  auto& vfs = parts_->vfs;
  vfs = *disk.real;
  vfs.szOsFile = static_cast<int>(sizeof(Shim)) + disk.real->szOsFile;
  vfs.zName = name;
  vfs.pAppData = &disk;
  vfs.xOpen = open_file;
  vfs.xDelete = remove_file;
  sqlite3_vfs_register(&vfs, 0);
}

PowerCut::~PowerCut() {
  sqlite3_vfs_unregister(&parts_->vfs);
}

std::size_t PowerCut::operations() const {
  return parts_->disk.operations;
}

DiskImage PowerCut::image(std::mt19937_64& random) const {
  DiskImage result;
  for (auto& [path, file] : parts_->disk.files) {
    auto content = file.synced;
    for (auto& change : file.unsynced) {
      if (auto* size = std::get_if<Truncation>(&change)) {
        if (random() % 2 == 0)
          content.resize(size->size);
        continue;
      }
      auto& part = std::get<Write>(change);
      for (std::size_t at = 0; at < part.data.size(); at += sector)
        if (random() % 2 == 0)
          apply(part, content, at, std::min(sector, part.data.size() - at));
    }
    result[std::filesystem::path{path}.filename()] = std::move(content);
  }
  return result;
}

void put(const DiskImage& image, const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  for (auto& [name, content] : image) {
    std::ofstream out{folder / name, std::ios::binary};
    out.write(reinterpret_cast<const char*>(content.data()),
              static_cast<std::streamsize>(content.size()));
  }
}

} // namespace castor::test
