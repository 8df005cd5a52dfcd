#include "castor/tests/support/temporary_folder.hpp"
#include "castor/tests/wm/memory/working_memories.hpp"
#include "castor/wm/journal/journal_writer.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <utility>

namespace castor::test {

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A journal that does what the test says, when it says so.
struct ScriptedJournal {
  std::vector<JournalGroupPtr> writes;
  caf::actor actor;

  std::uint64_t last() const { return writes.back()->back().sequence; }
};

/// Requests whose answers may have to wait.
class PatientClients : public WorkingMemories {
protected:
  /// Nobody hears of the end of what the fixture consists of.
  ~PatientClients() override {
    for (auto& x : clients)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  /// A request that is not waited for; `arrived` says whether it is answered.
  template <class Reply, class Request>
  std::shared_ptr<std::optional<Reply>> begin_at(const std::string& name, Request request) {
    auto result = std::make_shared<std::optional<Reply>>();
    clients.push_back(
      system.spawn([=, this, to = wm.at(name)](caf::event_based_actor* me) -> caf::behavior {
        me->request(to, caf::infinite, request)
          .then([=](const Reply& x) { *result = x; },
                [=, this](const caf::error& e) { errors.push_back(system.render(e)); });
        return {[](int) {}};
      }));
    scheduler.run();
    return result;
  }

  std::shared_ptr<std::optional<Outcome<Version>>> begin_write(WriteRequest request) {
    auto& at = request.address.subarchitecture;
    request.client = std::make_shared<const Client>(Client{"tester", at});
    return begin_at<Outcome<Version>>(at, request);
  }

  auto begin_add(const Address& at, int number = 0, EntryLife life = {}) {
    return begin_write({Operation::add, at, Value::of(Item{number}), {}, {}, 0, life});
  }

  std::vector<std::string> reports;
  std::vector<std::string> errors;
  std::vector<caf::actor> clients;
};

TEST_F(PatientClients, NeedNotWaitForAnswersOfAWorkingMemoryThatHasEnded) {
  add({"a", "1"});
  auto holder = std::make_shared<const Client>(Client{"holder", "a"});
  auto other = std::make_shared<const Client>(Client{"other", "b"});
  LockRequest request{{"a", "1"}, LockLevel::odr, {holder, 1, 1h}};
  ASSERT_TRUE(begin_at<Outcome<Lease>>("a", request)->has_value());
  request.patience = {other, 1, 1h};
  // By way of their own one.
  auto lease = begin_at<Outcome<Lease>>("b", request);
  auto read = begin_at<Outcome<EntryPtr>>("b", ReadRequest{{"a", "1"}, {other, 2, 1h}});
  auto query =
    begin_at<Outcome<std::vector<EntryPtr>>>("b", QueryRequest{{"a", "Item"}, {other, 3, 1h}});
  // Who does not wait any more need not hear of it.
  begin_at<Outcome<EntryPtr>>("b", ReadRequest{{"a", "1"}, {other, 4, 1h}});
  caf::anon_send(wm.at("b"), CancelWait{{"a", "1"}, other, 4});
  scheduler.run();
  EXPECT_THAT(errors, IsEmpty());
  caf::anon_send_exit(wm.at("a"), caf::exit_reason::kill);
  scheduler.run();
  EXPECT_FALSE(lease->has_value() || read->has_value() || query->has_value());
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_THAT(errors, Each(HasSubstr("request_receiver_down")));
}

/// A working memory d beside those of the fixture, with a journal.
class JournaledWorkingMemory : public PatientClients {
protected:
  ~JournaledWorkingMemory() override {
    caf::anon_send_exit(journal.actor, caf::exit_reason::user_shutdown);
  }

  void start(JournalMode mode = JournalMode::full, bool go_on_without = false) {
    journal.actor = system.spawn([this](caf::event_based_actor*) -> caf::behavior {
      return {[this](const JournalWrite& x) { journal.writes.push_back(x.changes); }};
    });
    WorkingMemoryOptions options;
    options.subarchitecture = "d";
    options.epoch = scheduler.clock().now();
    options.journal.mode = mode;
    options.journal.go_on_without = go_on_without;
    options.journal.most_unsynced = 3;
    options.journal.report = [this](const std::string& x) { reports.push_back(x); };
    options.opened_journal = opened;
    options.journal_writer = journal.actor;
    wm["d"] = system.spawn(working_memory, options);
    Peers peers;
    for (auto& [name, actor] : wm)
      peers.working_memories[name] = caf::actor_cast<caf::strong_actor_ptr>(actor);
    for (auto& [name, actor] : wm)
      ask<Acknowledged>(actor, peers);
  }

  /// The journal has everything that it was given.
  void sync() { tell({journal.last()}); }

  void tell(const JournalNews& news) {
    caf::anon_send(wm.at("d"), news);
    scheduler.run();
  }

  template <class Reply, class Request>
  auto begin(const Request& request) {
    return begin_at<Reply>("d", request);
  }

  auto begin_add(const std::string& id, int number = 0) {
    return PatientClients::begin_add({"d", id}, number);
  }

  std::shared_ptr<OpenedJournal> opened = std::make_shared<OpenedJournal>();
  ScriptedJournal journal;
};

TEST_F(JournaledWorkingMemory, AnswersAWriteOnceItIsSynced) {
  start();
  auto answer = begin_add("1", 5);
  EXPECT_FALSE(answer->has_value());
  ASSERT_EQ(journal.writes.size(), 1u);
  EXPECT_EQ(journal.writes.front()->front().value.as<Item>()->number, 5);
  sync();
  ASSERT_TRUE(answer->has_value());
  EXPECT_EQ(***answer, 0u);
}

TEST_F(JournaledWorkingMemory, ShowsNobodyWhatACrashCouldUndo) {
  start();
  begin_add("1");
  auto client = std::make_shared<const Client>(Client{"reader", "d"});
  auto read = begin<Outcome<EntryPtr>>(ReadRequest{{"d", "1"}, {}});
  auto query = begin<Outcome<std::vector<EntryPtr>>>(QueryRequest{{"d", "Item"}, {}});
  auto exists = begin<Outcome<bool>>(ExistsQuery{{"d", "1"}});
  auto version = begin<Outcome<Version>>(VersionQuery{{"d", "1"}});
  auto lease = begin<Outcome<Lease>>(LockRequest{{"d", "1"}, LockLevel::odr, {client, 1}});
  auto locked = begin<Outcome<LockStatus>>(LockQuery{{"d", "1"}});
  auto renewed = begin<RenewReply>(RenewRequest{client, {{"1", 1}}});
  // A refusal tells of the write before it, too.
  auto refused = begin_add("1");
  auto anything_said = [&] {
    return read->has_value() || query->has_value() || exists->has_value() || version->has_value() ||
           lease->has_value() || locked->has_value() || renewed->has_value() ||
           refused->has_value();
  };
  EXPECT_FALSE(anything_said());
  sync();
  EXPECT_TRUE(read->has_value() && query->has_value() && exists->has_value() &&
              version->has_value() && lease->has_value() && locked->has_value() &&
              renewed->has_value() && refused->has_value());
}

TEST_F(JournaledWorkingMemory, AnswersReadsAtOnceWhenNothingIsUnsynced) {
  start();
  begin_add("1");
  sync();
  EXPECT_TRUE(begin<Outcome<EntryPtr>>(ReadRequest{{"d", "1"}, {}})->has_value());
}

TEST_F(JournaledWorkingMemory, AnswersAWaitingReadOnceWhatItSeesIsSynced) {
  start();
  begin_add("1");
  sync();
  auto holder = std::make_shared<const Client>(Client{"holder", "d"});
  auto reader = std::make_shared<const Client>(Client{"reader", "d"});
  auto lease = begin<Outcome<Lease>>(LockRequest{{"d", "1"}, LockLevel::odr, {holder, 1, 10s}});
  ASSERT_TRUE(lease->has_value());
  auto read = begin<Outcome<EntryPtr>>(ReadRequest{{"d", "1"}, {reader, 1, 10s}});
  auto waiting = begin<Outcome<Lease>>(LockRequest{{"d", "1"}, LockLevel::o, {reader, 2, 10s}});
  WriteRequest request{Operation::overwrite, {"d", "1"}, Value::of(Item{2}), Version{0}, holder};
  request.token = (***lease).token;
  begin<Outcome<Version>>(request);
  begin<Outcome<Acknowledged>>(UnlockRequest{{"d", "1"}, holder, (***lease).token});
  EXPECT_FALSE(read->has_value());
  EXPECT_FALSE(waiting->has_value());
  sync();
  ASSERT_TRUE(read->has_value());
  EXPECT_EQ((***read)->version, 1u);
  EXPECT_TRUE(waiting->has_value());
}

TEST_F(JournaledWorkingMemory, TellsOfAChangeOnceItIsSynced) {
  start();
  auto& near = listen();
  subscribe(near, "d", 1, any_change());
  auto& far = listen();
  subscribe(far, "a", 1, any_change().anywhere());
  begin_add("1");
  begin_add("2");
  EXPECT_THAT(told(near), IsEmpty());
  EXPECT_THAT(told(far), IsEmpty());
  tell({1});
  EXPECT_THAT(told(near), ElementsAre("ADD d/1"));
  EXPECT_THAT(told(far), ElementsAre("ADD d/1"));
  begin_add("3");
  tell({3});
  EXPECT_THAT(told(near), ElementsAre("ADD d/1", "ADD d/2", "ADD d/3"));
  EXPECT_THAT(told(far), ElementsAre("ADD d/1", "ADD d/2", "ADD d/3"));
}

TEST_F(JournaledWorkingMemory, WritesABatchDownAsOne) {
  start();
  BatchRequest batch{"d", {}};
  for (auto id : {"1", "2"})
    batch.writes.push_back({Operation::add,
                            {"d", id},
                            Value::of(Item{}),
                            {},
                            std::make_shared<const Client>(Client{"tester", "d"})});
  begin<Outcome<std::vector<Version>>>(batch);
  ASSERT_EQ(journal.writes.size(), 1u);
  EXPECT_EQ(journal.writes.front()->size(), 2u);
  EXPECT_EQ(journal.writes.front()->back().write, 1u);
}

TEST_F(JournaledWorkingMemory, SaysHowItsJournalIsDoingEvenIfThatHangs) {
  start();
  begin_add("1");
  begin_add("2");
  begin<Outcome<bool>>(ExistsQuery{{"d", "1"}});
  auto journal_status = status("d").journal;
  EXPECT_EQ(journal_status.mode, JournalMode::full);
  EXPECT_EQ(journal_status.unsynced, 2u);
  EXPECT_EQ(journal_status.held, 3u);
  tell({2, 4096, 1});
  journal_status = status("d").journal;
  EXPECT_EQ(journal_status.unsynced, 0u);
  EXPECT_EQ(journal_status.bytes, 4096u);
  EXPECT_EQ(journal_status.syncs, 1u);
}

TEST_F(JournaledWorkingMemory, AcknowledgesAtOnceIfItIsBatchedUpToABound) {
  start(JournalMode::batched);
  for (auto id : {"1", "2", "3"})
    EXPECT_TRUE(begin_add(id)->has_value());
  auto answer = begin_add("4");
  EXPECT_FALSE(answer->has_value());
  tell({1});
  EXPECT_TRUE(answer->has_value());
}

// --- failures ---

TEST_F(JournaledWorkingMemory, EndsWhenItsJournalFailsAndHasAcknowledgedNothingThatIsNotThere) {
  start();
  auto& listener = listen();
  subscribe(listener, "d", 1, any_change());
  auto answer = begin_add("1");
  auto read = begin<Outcome<EntryPtr>>(ReadRequest{{"d", "1"}, {}});
  outsider->monitor(wm.at("d"));
  tell({0, 0, 0, "the disk is on fire"});
  EXPECT_FALSE(answer->has_value());
  EXPECT_FALSE(read->has_value());
  // They need not wait until their patience is over.
  EXPECT_THAT(errors,
              ElementsAre(HasSubstr("request_receiver_down"), HasSubstr("request_receiver_down")));
  EXPECT_THAT(told(listener), IsEmpty());
  EXPECT_THAT(reports, ElementsAre(HasSubstr("the disk is on fire. The working memory of d ends")));
  outsider->receive([&](const caf::down_msg& x) {
    EXPECT_THAT(system.render(x.reason), HasSubstr("the disk is on fire"));
  });
}

TEST_F(JournaledWorkingMemory, GoesOnWithoutAJournalIfItIsTo) {
  start(JournalMode::full, true);
  auto& listener = listen();
  subscribe(listener, "d", 1, any_change());
  auto answer = begin_add("1");
  tell({0, 0, 0, "the disk is on fire"});
  EXPECT_TRUE(answer->has_value());
  EXPECT_THAT(told(listener), ElementsAre("ADD d/1"));
  EXPECT_THAT(reports, ElementsAre(HasSubstr("d goes on without a journal")));
  EXPECT_TRUE(begin_add("2")->has_value());
  EXPECT_EQ(journal.writes.size(), 1u);
  EXPECT_EQ(status("d").journal.failure, "the disk is on fire");
}

// --- recovery ---

TEST_F(JournaledWorkingMemory, GivesNoTokenTwiceAndGoesOnCounting) {
  opened->session = 7;
  opened->image.sequence = 41;
  start();
  begin_add("1");
  EXPECT_EQ(journal.last(), 42u);
  sync();
  auto client = std::make_shared<const Client>(Client{"tester", "d"});
  auto lease = begin<Outcome<Lease>>(LockRequest{{"d", "1"}, LockLevel::o, {client, 1}});
  EXPECT_GT((***lease).token, 7 * numbers_per_incarnation);
  EXPECT_LT((***lease).token, 8 * numbers_per_incarnation);
}

TEST_F(JournaledWorkingMemory, LetsEntriesEndThatHaveOutlivedTheirOwnersOrTheirTime) {
  auto entry = [&](const std::string& id, EntryLife life, UnixTime time) {
    opened->image.entries.push_back(
      {std::make_shared<const Entry>(Entry{{"d", id}, 0, Value::of(Item{}), "tester", life}),
       ++opened->image.sequence, time});
  };
  opened->time = 100s;
  EntryLife ephemeral;
  ephemeral.ephemeral = true;
  entry("ephemeral", ephemeral, 100s);
  entry("stale", {10s}, 89s);
  entry("fresh", {10s}, 95s);
  entry("from the future", {10s}, 200s);
  entry("for ever", {}, 1s);
  start();
  scheduler.advance_time(1ms);
  scheduler.run();
  sync();
  auto ids = [&] {
    std::vector<std::string> result;
    auto found = begin<Outcome<std::vector<EntryPtr>>>(QueryRequest{{"d", "Item"}, {}});
    for (auto& x : *found->value())
      result.push_back(x->address.id);
    return result;
  };
  EXPECT_THAT(ids(), ElementsAre("for ever", "from the future", "fresh"));
  EXPECT_THAT(journal.writes.front()->back().source, owner_ended_source);
  scheduler.advance_time(6s);
  scheduler.run();
  sync();
  EXPECT_THAT(ids(), ElementsAre("for ever", "from the future"));
  scheduler.advance_time(6s);
  scheduler.run();
  sync();
  EXPECT_THAT(ids(), ElementsAre("for ever"));
}

// --- with a file ---

/// The working memory e, whose journal is a real file.
class FiledWorkingMemory : public PatientClients {
protected:
  ~FiledWorkingMemory() override {
    for (auto& x : ended)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
  }

  void start() {
    WorkingMemoryOptions options;
    options.subarchitecture = "e";
    options.epoch = scheduler.clock().now();
    options.journal = journal;
    options.opened_journal = std::make_shared<OpenedJournal>(open_journal(journal, "e"));
    wm["e"] = system.spawn(working_memory, options);
  }

  void end() {
    caf::anon_send_exit(wm.at("e"), caf::exit_reason::user_shutdown);
    scheduler.run();
    wm.erase("e");
  }

  void inject(const JournalFault& x) {
    caf::anon_send(wm.at("e"), x);
    scheduler.run();
  }

  void pass(Timestamp x) {
    scheduler.advance_time(x);
    scheduler.run();
  }

  JournalOptions options() {
    JournalOptions result;
    result.mode = JournalMode::full;
    result.file = folder / "e.castor-journal";
    result.own_thread = false;
    result.report = [this](const std::string& x) { reports.push_back(x); };
    return result;
  }

  TemporaryFolder folder;
  JournalOptions journal = options();
  std::vector<WorkingMemoryActor> ended;
};

TEST_F(FiledWorkingMemory, ComesBackWithWhatItHad) {
  start();
  add({"e", "1"}, 1);
  overwrite({"e", "1"}, 0, 2);
  add({"e", "2"}, 3);
  remove({"e", "2"});
  end();
  start();
  auto entry = *ask<Outcome<EntryPtr>>(wm.at("e"), ReadRequest{{"e", "1"}, {}});
  EXPECT_EQ(entry->version, 1u);
  EXPECT_EQ(entry->value.as<Item>()->number, 2);
  EXPECT_EQ(*add({"e", "2"}), 1u);
  EXPECT_EQ(status("e").events, 5u);
  EXPECT_EQ(status("e").journal.incarnation, 0u);
}

TEST_F(FiledWorkingMemory, SyncsABatchWhenItsDelayIsOver) {
  journal.mode = JournalMode::batched;
  start();
  add({"e", "1"});
  add({"e", "2"});
  EXPECT_EQ(status("e").journal.unsynced, 2u);
  scheduler.advance_time(99ms);
  scheduler.run();
  EXPECT_EQ(status("e").journal.unsynced, 2u);
  scheduler.advance_time(1ms);
  scheduler.run();
  EXPECT_EQ(status("e").journal.unsynced, 0u);
  EXPECT_EQ(status("e").journal.syncs, 1u);
}

TEST_F(FiledWorkingMemory, WritesDownWhatItHasAcknowledgedBeforeItEnds) {
  journal.mode = JournalMode::batched;
  start();
  add({"e", "1"});
  end();
  start();
  EXPECT_EQ(status("e").entries, 1u);
  EXPECT_EQ(status("e").journal.incarnation, 0u);
}

TEST_F(FiledWorkingMemory, EndsWhenAnotherTakesItsJournalOver) {
  start();
  add({"e", "1"});
  ended.push_back(wm.at("e"));
  outsider->monitor(ended.back());
  start();
  auto request = WriteRequest{Operation::add,
                              {"e", "2"},
                              Value::of(Item{}),
                              {},
                              std::make_shared<const Client>(Client{"tester", "e"})};
  bool refused = false;
  caf::anon_send(ended.back(), request);
  scheduler.run();
  outsider->receive([&](const caf::down_msg& x) {
    EXPECT_THAT(system.render(x.reason), HasSubstr("has taken it over"));
    refused = true;
  });
  EXPECT_TRUE(refused);
  EXPECT_EQ(*add({"e", "2"}), 0u);
  EXPECT_EQ(status("e").entries, 2u);
}

// --- faults on purpose ---

const JournalFault failing{JournalFault::Kind::failure, 1s};
const JournalFault slow{JournalFault::Kind::slowness, 1s, 20ms};

TEST_F(FiledWorkingMemory, EndsWhenItsJournalIsMadeToFailAndIsBackWithAllThatItHasAcknowledged) {
  start();
  add({"e", "1"}, 1);
  inject(failing);
  outsider->monitor(wm.at("e"));
  auto answer = begin_add({"e", "2"});
  EXPECT_FALSE(answer->has_value());
  ASSERT_THAT(reports, ElementsAre(HasSubstr("injected failure. The working memory of e ends; "
                                             "everything that it has acknowledged is in its "
                                             "journal")));
  outsider->receive([&](const caf::down_msg& x) {
    EXPECT_THAT(system.render(x.reason), HasSubstr("injected failure"));
  });
  start();
  EXPECT_EQ(status("e").entries, 1u);
  EXPECT_EQ(status("e").journal.incarnation, 0u);
  // The fault was that of the former one.
  EXPECT_TRUE(begin_add({"e", "2"})->has_value());
}

TEST_F(FiledWorkingMemory, GoesOnAndSaysSoWhenItsJournalIsMadeToFail) {
  journal.go_on_without = true;
  start();
  add({"e", "1"});
  inject(failing);
  EXPECT_TRUE(begin_add({"e", "2"})->has_value());
  EXPECT_THAT(reports, ElementsAre(HasSubstr("injected failure. e goes on without a journal")));
  EXPECT_THAT(status("e").journal.failure, HasSubstr("injected failure"));
  pass(2s);
  EXPECT_TRUE(begin_add({"e", "3"})->has_value());
  end();
  start();
  EXPECT_EQ(status("e").entries, 1u);
}

TEST_F(FiledWorkingMemory, DoesNotNoticeAFailureDuringWhichNothingWasWritten) {
  start();
  inject(failing);
  pass(1s);
  EXPECT_TRUE(begin_add({"e", "1"})->has_value());
  EXPECT_THAT(reports, IsEmpty());
}

TEST_F(FiledWorkingMemory, AnswersLaterAsLongAsItsJournalIsMadeSlow) {
  start();
  inject(slow);
  auto first = begin_add({"e", "1"});
  pass(19ms);
  // These come while the first is being written: the next group is theirs.
  auto second = begin_add({"e", "2"});
  auto third = begin_add({"e", "3"});
  EXPECT_FALSE(first->has_value());
  EXPECT_EQ(status("e").journal.unsynced, 3u);
  pass(1ms);
  EXPECT_TRUE(first->has_value());
  pass(19ms);
  EXPECT_FALSE(second->has_value());
  EXPECT_FALSE(third->has_value());
  pass(1ms);
  EXPECT_TRUE(second->has_value());
  EXPECT_TRUE(third->has_value());
  EXPECT_EQ(status("e").journal.syncs, 2u);
  pass(1s);
  EXPECT_TRUE(begin_add({"e", "4"})->has_value());
}

TEST_F(FiledWorkingMemory, WritesDownWhatASlowJournalHasNotTakenBeforeItEnds) {
  journal.mode = JournalMode::batched;
  start();
  inject(slow);
  add({"e", "1"});
  pass(journal.delay);
  add({"e", "2"});
  end();
  pass(1s);
  EXPECT_THAT(reports, IsEmpty());
  start();
  EXPECT_EQ(status("e").entries, 2u);
  EXPECT_EQ(status("e").journal.incarnation, 0u);
}

TEST_F(FiledWorkingMemory, SaysThatAcknowledgedChangesMayBeLostIfItsJournalFailsAtItsEnd) {
  journal.mode = JournalMode::batched;
  start();
  add({"e", "1"});
  inject(failing);
  end();
  EXPECT_THAT(reports,
              ElementsAre(HasSubstr("injected failure. What was acknowledged last may be lost")));
  start();
  EXPECT_EQ(status("e").entries, 0u);
  EXPECT_EQ(status("e").journal.incarnation, 1u);
}

} // namespace

} // namespace castor::test
