#include "castor/tests/tools/linearizability/world.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <new>
#include <stdexcept>
#include <type_traits>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace castor::linearizability {

namespace {

constexpr std::size_t most_operations =
  World::most_entries * World::most_operations_per_entry + 16 * World::most_players;
constexpr std::size_t most_findings = 16;
constexpr std::size_t letters = 26;

/// Of an operation that is written down.
enum class Stage : std::uint32_t { empty, begun, ended, dropped };

struct Operation {
  std::atomic<Stage> stage{Stage::empty};
  OperationRecord begun;
  OperationRecord ended;
};

struct Finding {
  std::atomic<bool> complete{false};
  std::array<char, 400> text{};
};

std::chrono::nanoseconds steady_now() {
  return std::chrono::steady_clock::now().time_since_epoch();
}

} // namespace

/// As it lies in memory that is shared between processes.
struct World::Page {
  std::uint64_t seed = 0;
  std::size_t players = 0;
  std::array<char, most_entries + 1> homes{};
  unsigned pauses = 0;
  std::chrono::nanoseconds longest_pause{0};
  bool may_lose = false;
  std::chrono::nanoseconds begin{0};

  std::atomic<std::size_t> entered{0};
  std::array<std::atomic<Tick>, most_players + 1> left{};
  std::array<std::atomic<bool>, letters> lost{};
  std::atomic<bool> may_close{false};
  std::atomic<bool> closed{false};

  std::atomic<Content> contents{0};
  std::array<std::atomic<std::size_t>, most_entries> begun{};
  std::atomic<std::size_t> written{0};
  std::array<Operation, most_operations> operations;
  std::atomic<std::size_t> found{0};
  std::array<Finding, most_findings> findings;
};

static_assert(std::atomic<Stage>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(std::is_trivially_copyable_v<OperationRecord>);

World::World(const WorldSettings& settings) : file_(memfd_create("world", MFD_CLOEXEC)) {
  auto* memory = file_ >= 0 && ftruncate(file_, sizeof(Page)) == 0
                   ? mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0)
                   : MAP_FAILED;
  if (memory == MAP_FAILED)
    throw std::runtime_error("no memory for a world");
  page_ = new (memory) Page{};
  page_->seed = settings.seed;
  page_->players = settings.players;
  settings.homes.copy(page_->homes.data(), most_entries);
  page_->pauses = settings.pauses;
  page_->longest_pause = settings.longest_pause;
  page_->may_lose = settings.may_lose;
  page_->begin = steady_now();
}

World::World(const std::string& path) : file_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  auto* memory = mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED)
    throw std::runtime_error("there is no world at " + path);
  page_ = static_cast<Page*>(memory);
}

World::~World() {
  munmap(page_, sizeof(Page));
  ::close(file_);
}

std::string World::path() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_);
}

WorldSettings World::settings() const {
  return {page_->seed,   page_->players,       page_->homes.data(),
          page_->pauses, page_->longest_pause, page_->may_lose};
}

Address World::address(std::uint32_t entry) const {
  return {std::string(1, page_->homes[entry]), std::string(1, char('w' + entry))};
}

Tick World::now() const {
  return Tick((steady_now() - page_->begin).count());
}

// -- operations

Content World::new_content() {
  return ++page_->contents;
}

bool World::is_worn_out(std::uint32_t entry, std::size_t reserve) const {
  return page_->begun[entry] + reserve * page_->players > most_operations_per_entry;
}

World::Number World::begin(const OperationRecord& x) {
  ++page_->begun[x.entry];
  auto number = page_->written++;
  auto& slot = page_->operations.at(number);
  slot.begun = x;
  slot.stage.store(Stage::begun, std::memory_order_release);
  return number;
}

void World::end(Number operation, const OperationRecord& x) {
  auto& slot = page_->operations.at(operation);
  slot.ended = x;
  slot.stage.store(Stage::ended, std::memory_order_release);
}

void World::drop(Number operation) {
  page_->operations.at(operation).stage.store(Stage::dropped, std::memory_order_release);
}

void World::report(const std::string& what) {
  auto number = page_->found++;
  if (number >= most_findings)
    return;
  auto& slot = page_->findings[number];
  what.copy(slot.text.data(), slot.text.size() - 1);
  slot.complete.store(true, std::memory_order_release);
}

// -- who is there

void World::enter() {
  ++page_->entered;
}

void World::leave(Client player) {
  Tick not_yet = 0;
  page_->left.at(player).compare_exchange_strong(not_yet, now());
}

bool World::all_have_entered() const {
  return page_->entered >= page_->players;
}

bool World::all_have_left() const {
  for (Client x = 1; x <= page_->players; ++x)
    if (!has_left(x))
      return false;
  return true;
}

bool World::has_left(Client player) const {
  return page_->left.at(player) != 0;
}

void World::lose(const std::string& subarchitecture) {
  page_->lost.at(std::size_t(subarchitecture.front() - 'a')) = true;
}

bool World::is_lost(const std::string& subarchitecture) const {
  return page_->lost.at(std::size_t(subarchitecture.front() - 'a'));
}

void World::let_close() {
  page_->may_close = true;
}

bool World::may_close() const {
  return page_->may_close;
}

void World::close() {
  page_->closed = true;
}

bool World::is_closed() const {
  return page_->closed;
}

// -- afterwards

History World::operations() const {
  History result;
  auto written = std::min<std::size_t>(page_->written, most_operations);
  for (std::size_t i = 0; i < written; ++i) {
    auto& slot = page_->operations[i];
    auto stage = slot.stage.load(std::memory_order_acquire);
    if (stage == Stage::begun)
      result.push_back(slot.begun);
    else if (stage == Stage::ended)
      result.push_back(slot.ended);
  }
  return result;
}

std::vector<std::string> World::findings() const {
  std::vector<std::string> result;
  for (auto& x : page_->findings)
    if (x.complete.load(std::memory_order_acquire))
      result.emplace_back(x.text.data());
  return result;
}

std::map<Client, Tick> World::ends() const {
  std::map<Client, Tick> result;
  for (Client x = 1; x <= page_->players; ++x)
    if (has_left(x))
      result[x] = page_->left[x];
  return result;
}

} // namespace castor::linearizability
