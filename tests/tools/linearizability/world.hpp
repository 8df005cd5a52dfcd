#pragma once

#include "castor/tools/linearizability/history.hpp"
#include "castor/wm/entries/address.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor::linearizability {

struct WorldSettings {
  std::uint64_t seed = 0;
  /// Numbered from 1.
  std::size_t players = 0;
  /// Of each entry, the subarchitecture that it lies in: at most four names of one letter.
  std::string homes;
  /// How often players pause between operations, in percent, and for how long at most.
  unsigned pauses = 5;
  std::chrono::nanoseconds longest_pause{0};
  /// Processes may lose each other for good though they live.
  bool may_lose = false;
};

/// What those share who take part in one run, whatever processes they are in. It outlives them:
/// what a process did is known, too, if it was killed.
class World {
public:
  using Number = std::size_t;

  static constexpr std::size_t most_players = 16;
  static constexpr std::size_t most_entries = 4;
  /// More than that may not be begun on one entry.
  static constexpr std::size_t most_operations_per_entry = 200;

  /// A new one.
  explicit World(const WorldSettings& settings);
  /// That of another process, or of another component of this one.
  explicit World(const std::string& path);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World();

  /// Where others find it, for as long as this object lives.
  std::string path() const;

  WorldSettings settings() const;
  Address address(std::uint32_t entry) const;

  /// Nanoseconds since it was made.
  Tick now() const;

  // -- operations

  Content new_content();
  /// Whether enough was done with the entry, if every player may begin so many more.
  bool is_worn_out(std::uint32_t entry, std::size_t reserve) const;
  /// Writes down an operation, before it is sent.
  Number begin(const OperationRecord& x);
  /// It came back, with what is known then.
  void end(Number operation, const OperationRecord& x);
  /// It was not made, for a reason that lies elsewhere.
  void drop(Number operation);
  /// Something is wrong that the history does not show.
  void report(const std::string& what);

  // -- who is there

  void enter();
  void leave(Client player);
  bool all_have_entered() const;
  bool all_have_left() const;
  bool has_left(Client player) const;

  /// The subarchitecture's working memory ends now.
  void lose(const std::string& subarchitecture);
  bool is_lost(const std::string& subarchitecture) const;

  /// All have left, and who looks at how the entries stand in the end may do so.
  void let_close();
  bool may_close() const;
  void close();
  bool is_closed() const;

  // -- afterwards

  /// Without lapses.
  History operations() const;
  std::vector<std::string> findings() const;
  /// When the players left.
  std::map<Client, Tick> ends() const;

private:
  struct Page;

  int file_ = -1;
  Page* page_ = nullptr;
};

} // namespace castor::linearizability
