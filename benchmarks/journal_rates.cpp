#include "castor/benchmarks/journal_rates.hpp"

#include "castor/benchmarks/race.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <caf/scoped_actor.hpp>

#include <fmt/core.h>

#include <sqlite3.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace castor::benchmark {

namespace {

struct Payload {
  std::string text;
};
CASTOR_REFLECT(Payload, text)

double per_second(std::uint64_t count, Clock::time_point begin) {
  return static_cast<double>(count) / std::chrono::duration<double>(Clock::now() - begin).count();
}

void require(int code) {
  if (code != SQLITE_OK && code != SQLITE_DONE) {
    fmt::print(stderr, "SQLite: {}\n", sqlite3_errstr(code));
    std::exit(1);
  }
}

} // namespace

double sqlite_rate(const JournalRun& run, std::size_t bytes, std::size_t group) {
  auto file = run.folder / "raw.db";
  sqlite3* database = nullptr;
  require(sqlite3_open(file.c_str(), &database));
  sqlite3_exec(database,
               "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; CREATE TABLE log (sequence "
               "INTEGER PRIMARY KEY, id TEXT, value BLOB)",
               nullptr, nullptr, nullptr);
  sqlite3_stmt* insert = nullptr;
  require(sqlite3_prepare_v2(database, "INSERT INTO log (id, value) VALUES (?, ?)", -1, &insert,
                             nullptr));
  std::string value(bytes, 'x');
  auto begin = Clock::now();
  std::uint64_t count = 0;
  while (Clock::now() - begin < run.duration) {
    require(sqlite3_exec(database, "BEGIN", nullptr, nullptr, nullptr));
    for (std::size_t i = 0; i < group; ++i, ++count) {
      sqlite3_bind_text(insert, 1, "entry", -1, SQLITE_STATIC);
      sqlite3_bind_blob(insert, 2, value.data(), static_cast<int>(bytes), SQLITE_STATIC);
      require(sqlite3_step(insert));
      sqlite3_reset(insert);
    }
    require(sqlite3_exec(database, "COMMIT", nullptr, nullptr, nullptr));
  }
  auto result = per_second(count, begin);
  sqlite3_finalize(insert);
  sqlite3_close(database);
  std::filesystem::remove(file);
  return result;
}

double journal_rate(const JournalRun& run, JournalMode mode, std::size_t bytes, int clients,
                    int under_way) {
  caf::actor_system_config config;
  config.set("scheduler.policy", caf::atom("sharing"));
  caf::actor_system system{config};
  WorkingMemoryOptions options;
  options.subarchitecture = "a";
  options.epoch = Clock::now();
  options.journal.mode = mode;
  options.journal.file = run.folder / ("a" + std::string{journal_extension});
  options.journal.report = [](const std::string& x) { fmt::print(stderr, "{}\n", x); };
  if (mode != JournalMode::off)
    options.opened_journal = std::make_shared<OpenedJournal>(open_journal(options.journal, "a"));
  auto wm = system.spawn(working_memory, options);
  std::atomic<std::uint64_t> count{0};
  auto begin = Clock::now();
  std::vector<std::thread> threads;
  for (int i = 0; i < clients; ++i)
    threads.emplace_back([&, i] {
      caf::scoped_actor self{system};
      auto client = std::make_shared<const Client>(Client{"client" + std::to_string(i), "a"});
      auto value = Value::of(Payload{std::string(bytes, 'x')});
      Address address{"a", std::to_string(i)};
      Version version = 0;
      auto send = [&](Operation operation) {
        WriteRequest request{operation, address, value, {}, client};
        if (operation == Operation::overwrite)
          request.last_seen = version++;
        return self->request(wm, caf::infinite, std::move(request));
      };
      auto take = [&](auto& handle) {
        handle.receive(
          [&](const Outcome<Version>& x) {
            if (!x)
              fmt::print(stderr, "{}\n", x.failure().message);
            ++count;
          },
          [&](const caf::error& e) {
            fmt::print(stderr, "{}\n", system.render(e));
            std::exit(1);
          });
      };
      auto added = send(Operation::add);
      take(added);
      while (Clock::now() - begin < run.duration) {
        std::vector<decltype(send(Operation::overwrite))> handles;
        for (int k = 0; k < under_way; ++k)
          handles.push_back(send(Operation::overwrite));
        for (auto& x : handles)
          take(x);
      }
    });
  for (auto& x : threads)
    x.join();
  auto result = per_second(count, begin);
  caf::anon_send_exit(wm, caf::exit_reason::user_shutdown);
  system.await_all_actors_done();
  std::filesystem::remove(options.journal.file);
  return result;
}

} // namespace castor::benchmark
