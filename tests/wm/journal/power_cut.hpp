#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace castor::test {

/// What a disk would hold if the power went off now, by the names of the files.
using DiskImage = std::map<std::string, std::vector<std::uint8_t>>;

/// A way for SQLite to the operating system's files on which remembers what was not synced, so that
/// it can be lost. While it lives, its name is that of an SQLite VFS.
class PowerCut {
public:
  PowerCut();
  PowerCut(const PowerCut&) = delete;
  PowerCut& operator=(const PowerCut&) = delete;
  ~PowerCut();

  static constexpr const char* name = "castor-power-cut";

  /// What would be there: all that was synced, and of each 512 bytes that were written since,
  /// whatever chance has brought there.
  DiskImage image(std::mt19937_64& random) const;

  /// Is called before every write and sync.
  std::function<void()> on_operation;

  /// From the operation of that number on (counted from 0), everything fails.
  std::size_t fails_from = ~std::size_t{0};
  /// What then happens: the disk is full, or there is an error.
  bool is_full = false;

  /// How many operations there were.
  std::size_t operations() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

void put(const DiskImage& image, const std::filesystem::path& folder);

} // namespace castor::test
