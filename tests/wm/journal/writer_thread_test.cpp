#include "castor/tests/support/temporary_folder.hpp"
#include "castor/wm/journal/journal_reader.hpp"
#include "castor/wm/memory/working_memory.hpp"

#include <caf/scoped_actor.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace castor::test {

namespace {

struct Mark {
  int number = 0;
};
CASTOR_REFLECT(Mark, number)

TEST(JournalThread, WritesEverythingDownAfterItsWorkingMemoryHasEnded) {
  TemporaryFolder folder;
  JournalOptions options;
  options.delay = std::chrono::hours{1};
  options.file = folder / "a.castor-journal";
  constexpr int times = 20;
  for (int i = 0; i < times; ++i) {
    // With something left to write, and with nothing.
    options.mode = i % 2 == 0 ? JournalMode::batched : JournalMode::full;
    caf::actor_system_config config;
    caf::actor_system system{config};
    WorkingMemoryOptions wm_options;
    wm_options.subarchitecture = "a";
    wm_options.epoch = std::chrono::steady_clock::now();
    wm_options.journal = options;
    wm_options.opened_journal = std::make_shared<OpenedJournal>(open_journal(options, "a"));
    auto wm = system.spawn(working_memory, std::move(wm_options));
    caf::scoped_actor self{system};
    WriteRequest request{Operation::add,
                         {"a", std::to_string(i)},
                         Value::of(Mark{i}),
                         {},
                         std::make_shared<const Client>(Client{"tester", "a"})};
    self->request(wm, caf::infinite, request)
      .receive([](const Outcome<Version>& x) { EXPECT_TRUE(x.ok()); },
               [&](const caf::error& e) { ADD_FAILURE() << system.render(e); });
    self->send_exit(wm, caf::exit_reason::user_shutdown);
  }
  JournalReader reader{options.file};
  EXPECT_TRUE(reader.summary().clean);
  EXPECT_EQ(reader.summary().incarnation, 0u);
  EXPECT_EQ(reader.replay().size(), static_cast<std::size_t>(times));
}

} // namespace

} // namespace castor::test
