// What a journal costs: acknowledged writes per second of a working memory with one, as ratios to
// what SQLite itself does with the same payload and the same number of writes in each transaction.
//
//   journal_benchmark [SECONDS] [FOLDER]
#include "castor/benchmarks/journal_rates.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace castor::benchmark {

namespace {

void report(const JournalRun& run) {
  fmt::print("{:<34}{:>14}{:>22}{:>22}{:>22}\n", "acknowledged writes/s (to SQLite)", "SQLite",
             "full", "batched", "off");
  for (auto [name, bytes] : {std::pair{"100 B", std::size_t{100}}, {"64 KB", std::size_t{65536}}})
    for (auto [clients, under_way] : {std::pair{1, 1}, {4, 1}, {16, 1}, {4, 64}}) {
      auto group = static_cast<std::size_t>(clients * under_way);
      auto raw = sqlite_rate(run, bytes, group);
      fmt::print(
        "{:<34}{:>14.0f}",
        fmt::format("{}, {} client{} x {}", name, clients, clients == 1 ? "" : "s", under_way),
        raw);
      for (auto mode : {JournalMode::full, JournalMode::batched, JournalMode::off}) {
        auto x = journal_rate(run, mode, bytes, clients, under_way);
        fmt::print("{:>13.0f} {:>8}", x, fmt::format("({:.2f})", x / raw));
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  JournalRun run;
  if (argc > 1)
    run.duration = std::chrono::duration<double>{std::atof(argv[1])};
  run.folder =
    argc > 2 ? argv[2] : std::filesystem::temp_directory_path() / "castor-journal-benchmark";
  std::filesystem::create_directories(run.folder);
  report(run);
  std::filesystem::remove_all(run.folder);
}
