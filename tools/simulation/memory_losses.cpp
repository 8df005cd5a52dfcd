#include "castor/tools/simulation/memory_losses.hpp"

#include <algorithm>
#include <string>

namespace castor::simulation {

namespace {

using linearizability::Status;

/// How an entry stands in a working memory that begins with what its journal has.
linearizability::Result begin_of(const StoreImage& image, const std::string& id,
                                 linearizability::Token token) {
  for (auto& x : image.entries)
    if (x.entry->address.id == id)
      return {Status::ok, x.entry->version, linearizability::content_of(*x.entry), token};
  for (auto& [deleted, version] : image.deleted)
    if (deleted == id)
      return {Status::does_not_exist, version, 0, token};
  return {Status::never_existed, image.floor, 0, token};
}

} // namespace

std::size_t note_losses(SystemWorld& world, const SimulatedMachines& machines) {
  std::size_t result = 0;
  for (auto& [name, lives] : machines.memories())
    for (std::size_t i = 1; i < lives.size(); ++i) {
      auto from = std::min(lives[i - 1].end, lives[i].begin);
      auto to = std::max(lives[i - 1].end, lives[i].begin);
      if (lives[i].session != 0 && !lives[i].may_lack_changes) {
        for (std::uint32_t entry = 0; entry < world.entries.size(); ++entry)
          if (world.entries[entry].address.subarchitecture == name)
            world.recorder.leases_lost(entry, lives[i].session * numbers_per_incarnation, from, to);
        continue;
      }
      if (lives[i].session != 0) {
        for (std::uint32_t entry = 0; entry < world.entries.size(); ++entry)
          if (auto& address = world.entries[entry].address; address.subarchitecture == name)
            world.recorder.lost(
              entry, from, to,
              begin_of(*lives[i].image, address.id, lives[i].session * numbers_per_incarnation));
        continue;
      }
      ++result;
      auto floor = (lives[i].incarnation - 1) * numbers_per_life;
      for (std::uint32_t entry = 0; entry < world.entries.size(); ++entry)
        if (world.entries[entry].address.subarchitecture == name)
          world.recorder.lost(entry, from, to,
                              {.status = Status::never_existed, .version = floor, .token = floor});
    }
  return result;
}

} // namespace castor::simulation
