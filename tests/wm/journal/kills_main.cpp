// Kills a process that writes journals, over and over, and looks whether any write that it has
// acknowledged is missing, or is there twice.
//
//   castor_journal_kills [--kills N] [--seed S]
#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/wm/journal/journal_reader.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <caf/scoped_actor.hpp>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::test {

namespace {

struct Mark {
  std::uint64_t number = 0;
};
CASTOR_REFLECT(Mark, number)

constexpr int clients = 4;

/// One keeps all its changes, the other folds them as soon as it can.
const std::vector<std::string> subarchitectures{"kept", "folded"};

JournalOptions options_for(const std::filesystem::path& folder, const std::string& name) {
  JournalOptions result;
  result.mode = JournalMode::full;
  result.file = folder / (name + journal_extension);
  result.keep = name == "kept";
  result.limit_bytes = 100'000;
  result.report = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
  return result;
}

// --- the process that is killed ---

/// In one piece, also if the process is killed meanwhile.
void tell(const std::string& line) {
  if (::write(STDOUT_FILENO, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    std::_Exit(3);
}

/// Writes entries of its own, and tells of every write that was acknowledged.
class VictimClient {
public:
  VictimClient(caf::actor_system& system, WorkingMemoryActor wm, std::string subarchitecture,
               int client, std::uint64_t session)
    : self_(system), wm_(std::move(wm)), subarchitecture_(std::move(subarchitecture)),
      client_(client), number_(session << 32 | static_cast<std::uint64_t>(client) << 28) {}

  void run() {
    for (;;) {
      ++number_;
      BatchRequest batch{subarchitecture_, {}};
      batch.writes.push_back(next("one"));
      // Now and then two at once.
      if (number_ % 5 == 0)
        batch.writes.push_back(next("two"));
      auto versions = ask<std::vector<Version>>(batch);
      std::string lines;
      for (std::size_t i = 0; i < versions.size(); ++i)
        lines += fmt::format("{} {} {} {}\n", subarchitecture_, number_, batch.writes[i].address.id,
                             versions[i]);
      tell(lines + "done\n");
    }
  }

private:
  template <class Reply, class Request>
  Reply ask(const Request& request) {
    Reply result{};
    self_->request(wm_, caf::infinite, request)
      .receive(
        [&](const Outcome<Reply>& x) {
          if (!x)
            throw std::runtime_error(x.failure().message);
          result = *x;
        },
        [&](const caf::error& e) { throw std::runtime_error(self_->system().render(e)); });
    return result;
  }

  /// Adds, overwrites or deletes the entry.
  WriteRequest next(const std::string& name) {
    Address address{subarchitecture_, fmt::format("{}-{}", name, client_)};
    auto who = std::make_shared<const Client>(Client{fmt::format("{}", number_), subarchitecture_});
    auto value = Value::of(Mark{number_});
    if (!ask<bool>(ExistsQuery{address}))
      return {Operation::add, address, value, {}, who};
    if (number_ % 7 == 0)
      return {Operation::remove, address, {}, {}, who};
    auto version = ask<Version>(VersionQuery{address});
    return {Operation::overwrite, address, value, version, who};
  }

  caf::scoped_actor self_;
  WorkingMemoryActor wm_;
  std::string subarchitecture_;
  int client_;
  std::uint64_t number_;
};

int be_victim(const std::filesystem::path& folder) {
  caf::actor_system_config config;
  caf::actor_system system{config};
  std::vector<std::thread> threads;
  for (auto& name : subarchitectures) {
    WorkingMemoryOptions options;
    options.subarchitecture = name;
    options.epoch = std::chrono::steady_clock::now();
    options.journal = options_for(folder, name);
    options.opened_journal = std::make_shared<OpenedJournal>(open_journal(options.journal, name));
    auto session = options.opened_journal->session;
    auto wm = system.spawn(working_memory, options);
    for (int i = 0; i < clients; ++i)
      threads.emplace_back([&system, wm, name, i, session] {
        VictimClient{system, wm, name, i, session}.run();
      });
  }
  for (auto& x : threads)
    x.join();
  return 0;
}

// --- the process that kills ---

void require(bool condition, const std::string& what) {
  if (!condition)
    throw std::runtime_error(what);
}

/// What a write did: the versions of the entries that it changed.
using Write = std::map<std::string, Version>;

/// What was acknowledged, and whether the journals have it.
class Judge {
public:
  explicit Judge(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What the process has said until it was killed.
  void hear(const std::string& output) {
    auto end = output.rfind("done\n");
    std::istringstream in{end == output.npos ? std::string{} : output.substr(0, end)};
    std::string subarchitecture;
    while (in >> subarchitecture) {
      std::uint64_t number = 0;
      std::string id;
      Version version = 0;
      if (subarchitecture != "done" && in >> number >> id >> version)
        acknowledged_[subarchitecture][number][id] = version;
    }
  }

  std::size_t acknowledged() const {
    std::size_t result = 0;
    for (auto& [name, writes] : acknowledged_)
      result += writes.size();
    return result;
  }

  /// Of the journal that has all changes: each once, whole, and all that were acknowledged.
  void check_kept() {
    std::map<std::uint64_t, Write> found;
    std::map<std::uint64_t, std::uint64_t> firsts;
    std::uint64_t sequence = 0;
    JournalReader{file("kept")}.replay([&](const JournalRecord& x) {
      require(x.sequence == ++sequence, fmt::format("change {} is missing", sequence));
      auto number = std::stoull(x.source);
      if (x.value.has_value())
        require(x.value.as<Mark>()->number == number, x.id + " has another's value");
      auto [first, is_new] = firsts.try_emplace(number, x.write);
      require(first->second == x.write && found[number].emplace(x.id, x.version).second,
              fmt::format("write {} came twice", number));
    });
    for (auto& [number, write] : found)
      require(write.size() == (number % 5 == 0 ? 2 : 1),
              fmt::format("of write {} there is only a part", number));
    for (auto& [number, write] : acknowledged_["kept"])
      require(found.count(number) > 0 && found.at(number) == write,
              fmt::format("write {} was acknowledged and is not there as it was", number));
  }

  /// Of the other: every entry is as the last acknowledged write left it, or one write further.
  void check_folded() {
    auto image = JournalReader{file("folded")}.replay().store();
    Entries found;
    for (auto& [id, version] : image.deleted)
      found[id] = {version, 0};
    for (auto& x : image.entries)
      found[x.entry->address.id] = {x.entry->version, x.entry->value.as<Mark>()->number};
    auto known = folded_;
    for (auto& [number, write] : acknowledged_["folded"])
      for (auto& [id, version] : write)
        if (auto& x = known[id]; number > x.second)
          x = {version, number};
    for (auto& [id, x] : known) {
      auto [version, number] = x;
      auto entry = found.find(id);
      require(entry != found.end(), id + " is lost");
      auto [found_version, found_number] = entry->second;
      require(found_version == version || found_version == version + 1,
              fmt::format("{} is at version {}, known was {}", id, found_version, version));
      require(found_version > version || found_number == 0 || found_number == number,
              fmt::format("{} is as write {} left it, known was {}", id, found_number, number));
      // What was not acknowledged is known now.
      x = {found_version, std::max(found_number, number)};
    }
    folded_ = std::move(known);
  }

private:
  std::filesystem::path file(const std::string& name) const {
    return folder_ / (name + journal_extension);
  }

  /// The version of each entry, and the last write that is known of it.
  using Entries = std::map<std::string, std::pair<Version, std::uint64_t>>;

  std::filesystem::path folder_;
  Entries folded_;
  std::map<std::string, std::map<std::uint64_t, Write>> acknowledged_;
};

int kill_often(const std::string& program, int kills, std::uint64_t seed) {
  TemporaryFolder folder;
  Judge judge{folder.path()};
  std::mt19937_64 random{seed};
  try {
    cli::Progress progress{"kills"};
    for (int i = 1; i <= kills; ++i) {
      progress.update(i, kills, fmt::format("{} of {}", i, kills));
      Process victim{{program, "--victim", folder.path().string()}};
      // When it is killed is a matter of chance: before it is ready, too, but not every time where
      // processes start slowly.
      if (i % 2 == 0)
        victim.wait_for_output("done\n");
      std::this_thread::sleep_for(std::chrono::milliseconds{10 + random() % 60});
      victim.send_signal(SIGKILL);
      auto status = victim.wait();
      require(status == 128 + SIGKILL, "it ended of itself: " + victim.errors());
      judge.hear(victim.output());
      if (std::filesystem::exists(folder / ("folded" + std::string{journal_extension})))
        judge.check_folded();
      if (i % 100 == 0 || i == kills)
        judge.check_kept();
    }
    fmt::print("{} kills, {} acknowledged writes: none is lost, none is there twice\n", kills,
               judge.acknowledged());
    return judge.acknowledged() > 0 ? 0 : 1;
  } catch (const std::runtime_error& e) {
    fmt::print(stderr, "seed {}: {}\n", seed, e.what());
    return 1;
  }
}

int main(int argc, char** argv) {
  CLI::App app{"Kills a process that writes journals, and looks whether they have what it "
               "acknowledged."};
  std::string victim;
  int kills = 25;
  std::uint64_t seed = 1;
  app.add_option("--kills", kills, "how often");
  app.add_option("--seed", seed, "of the moments");
  app.add_option("--victim", victim, "be the process that is killed, with journals in this folder");
  CLI11_PARSE(app, argc, argv);
  return victim.empty() ? kill_often(argv[0], kills, seed) : be_victim(victim);
}

} // namespace

} // namespace castor::test

int main(int argc, char** argv) {
  return castor::test::main(argc, argv);
}
