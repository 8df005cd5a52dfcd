#include "castor/wm/memory/lease_service.hpp"

#include "castor/tests/wm/values/test_types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

ClientPtr client_named(const std::string& name) {
  return std::make_shared<const Client>(Client{name, "a", 1});
}

class LeaseServiceTest : public testing::Test {
protected:
  LeaseServiceTest() {
    for (auto id : {"x", "y"})
      write({Operation::add, {"a", id}, Value::of(Box{}), {}, ann});
  }

  void write(const WriteRequest& request) {
    auto effect = store.prepare(request);
    if (!effect)
      throw std::logic_error(effect.failure().message);
    store.commit(*effect, now);
    if (request.operation == Operation::remove)
      service.erase(request.address.id);
    service.settle();
  }

  void pass(Timestamp time) {
    now += time;
    service.expire(now);
    service.settle();
  }

  LockRequest locking(const std::string& id, const ClientPtr& client,
                      LockLevel level = LockLevel::o, Timestamp at_most = 10s) {
    return {{"a", id}, level, {client, ++numbers, at_most}};
  }

  /// The token of a lease that the client is granted at once.
  LeaseToken lock(const std::string& id, const ClientPtr& client, LockLevel level = LockLevel::o) {
    return (**service.try_lock(locking(id, client, level), now)).token;
  }

  template <class Reply>
  WaitingReply<Reply> keep(std::vector<Outcome<Reply>>& replies) {
    return {[&replies](Outcome<Reply> x) { replies.push_back(std::move(x)); },
            [this] { ++abandoned; }};
  }

  EntryStore store{"a"};
  LeaseService service{store, {}};
  Timestamp now{0};
  WaitNumber numbers = 0;
  int abandoned = 0;
  ClientPtr ann = client_named("ann");
  ClientPtr bob = client_named("bob");
  std::vector<Outcome<Lease>> leases;
  std::vector<Outcome<EntryPtr>> reads;
  std::vector<Outcome<LeaseService::Entries>> queries;
};

} // namespace

TEST_F(LeaseServiceTest, GrantsALeaseToTheNextWhoWaits) {
  auto token = lock("x", ann);
  auto request = locking("x", bob);
  EXPECT_FALSE(service.try_lock(request, now)) << "bob has to wait";
  service.wait_to_lock(request, now, keep(leases));
  EXPECT_EQ(service.waiting(), 1u);
  ASSERT_TRUE(service.unlock({{"a", "x"}, ann, token}, now));
  EXPECT_TRUE(leases.empty()) << "answers are for settle()";
  EXPECT_TRUE(service.settle());
  ASSERT_EQ(leases.size(), 1u);
  EXPECT_GT((*leases[0]).token, token);
  EXPECT_EQ(service.waiting(), 0u);
  EXPECT_FALSE(service.settle());
}

TEST_F(LeaseServiceTest, RefusesALockWithoutPatience) {
  lock("x", ann);
  auto refused = service.try_lock(locking("x", bob, LockLevel::o, 0s), now);
  ASSERT_TRUE(refused && !*refused);
  EXPECT_EQ(refused->failure().kind, FailureKind::leased);
  EXPECT_THAT(refused->failure().message, HasSubstr("ann of a holds a lease of level O"));
}

TEST_F(LeaseServiceTest, NamesTheHolderToWhoHasWaitedTooLong) {
  auto token = lock("x", ann);
  auto request = locking("x", bob, LockLevel::o, 100ms);
  service.try_lock(request, now);
  service.wait_to_lock(request, now, keep(leases));
  EXPECT_EQ(service.next_deadline(), Timestamp{100ms});
  pass(100ms);
  ASSERT_EQ(leases.size(), 1u);
  EXPECT_EQ(leases[0].failure().kind, FailureKind::no_answer);
  EXPECT_THAT(leases[0].failure().message,
              HasSubstr("could not lock a/x in time: ann of a holds a lease"));
  EXPECT_TRUE(service.unlock({{"a", "x"}, ann, token}, now));
}

TEST_F(LeaseServiceTest, LetsReadsWaitForALeaseOfLevelODROnly) {
  ReadRequest request{{"a", "x"}, {bob, ++numbers, 10s}};
  auto token = lock("x", ann, LockLevel::od);
  EXPECT_TRUE(service.try_read(request));
  service.unlock({{"a", "x"}, ann, token}, now);
  token = lock("x", ann, LockLevel::odr);
  EXPECT_FALSE(service.try_read(request));
  service.wait_to_read(request, now, keep(reads));
  service.unlock({{"a", "x"}, ann, token}, now);
  service.settle();
  ASSERT_EQ(reads.size(), 1u);
  EXPECT_EQ((*reads[0])->address.id, "x");
}

TEST_F(LeaseServiceTest, TellsReadersOfADeletion) {
  auto token = lock("x", ann, LockLevel::odr);
  service.wait_to_read({{"a", "x"}, {bob, ++numbers, 10s}}, now, keep(reads));
  write({Operation::remove, {"a", "x"}, {}, {}, ann, token});
  ASSERT_EQ(reads.size(), 1u);
  EXPECT_EQ(reads[0].failure().kind, FailureKind::does_not_exist);
}

TEST_F(LeaseServiceTest, AQueryWaitsForOneLeaseAfterTheOther) {
  auto x = lock("x", ann, LockLevel::odr);
  auto y = lock("y", ann, LockLevel::odr);
  QueryRequest request;
  request.patience = {bob, ++numbers, 10s};
  EXPECT_FALSE(service.try_query(request));
  service.wait_to_query(request, now, keep(queries));
  service.unlock({{"a", "x"}, ann, x}, now);
  service.settle();
  EXPECT_TRUE(queries.empty());
  service.unlock({{"a", "y"}, ann, y}, now);
  service.settle();
  ASSERT_EQ(queries.size(), 1u);
  EXPECT_EQ((*queries[0]).size(), 2u);
}

TEST_F(LeaseServiceTest, ACancelledWaitIsAbandonedAndNotAnswered) {
  auto token = lock("x", ann);
  auto request = locking("x", bob);
  service.wait_to_lock(request, now, keep(leases));
  service.cancel({{"a", "x"}, bob, request.patience.number}, now);
  EXPECT_EQ(abandoned, 1);
  service.unlock({{"a", "x"}, ann, token}, now);
  service.settle();
  EXPECT_TRUE(leases.empty());
  EXPECT_TRUE(service.empty());
}

TEST_F(LeaseServiceTest, TheEndOfAClientEndsItsLeasesAndWaits) {
  lock("x", ann);
  auto y = lock("y", bob);
  service.wait_to_lock(locking("x", bob), now, keep(leases));
  std::vector<Outcome<Lease>> of_the_dead;
  service.wait_to_lock(locking("y", ann), now, keep(of_the_dead));
  service.drop(*ann, now);
  service.settle();
  EXPECT_EQ(leases.size(), 1u);
  EXPECT_TRUE(service.unlock({{"a", "y"}, bob, y}, now));
  service.settle();
  EXPECT_TRUE(of_the_dead.empty());
}

TEST_F(LeaseServiceTest, RenewalsSayWhatIsLost) {
  auto token = lock("x", ann);
  auto reply = service.renew({ann, {{"x", token}, {"y", token}}}, now);
  ASSERT_EQ(reply.lost.size(), 1u);
  EXPECT_EQ(reply.lost[0].id, "y");
}

TEST_F(LeaseServiceTest, SaysWhoHoldsALeaseAndHowManyWait) {
  lock("x", ann, LockLevel::od);
  service.wait_to_lock(locking("x", bob), now, keep(leases));
  auto status = *service.status({"a", "x"});
  EXPECT_EQ(status.level, LockLevel::od);
  EXPECT_EQ(status.holder, ann);
  EXPECT_EQ(status.waiting, 1u);
  EXPECT_EQ(service.status({"a", "z"}).failure().kind, FailureKind::does_not_exist);
}

TEST_F(LeaseServiceTest, ProtectsEntriesFromDeletionAtLevelODAndAbove) {
  EXPECT_FALSE(service.protected_until("x"));
  lock("x", ann, LockLevel::o);
  EXPECT_FALSE(service.protected_until("x"));
  lock("y", ann, LockLevel::od);
  EXPECT_EQ(service.protected_until("y"), now + LeaseTableOptions{}.duration);
}

TEST_F(LeaseServiceTest, FollowsAProbeFromAWaitToTheHolder) {
  auto token = lock("x", ann);
  auto request = locking("x", bob);
  service.wait_to_lock(request, now, keep(leases));
  WaitEdge edge;
  edge.waiter = bob;
  edge.number = request.patience.number;
  EXPECT_EQ(service.follow(edge), ann);
  EXPECT_EQ(edge.address.id, "x");
  EXPECT_EQ(edge.obstacle, token);
  edge.number = ++numbers;
  EXPECT_EQ(service.follow(edge), nullptr) << "that wait is over";
}

TEST_F(LeaseServiceTest, FollowsAProbeToTheOwnerOfAnEphemeralEntry) {
  WriteRequest request{Operation::add, {"a", "z"}, Value::of(Box{}), {}, ann};
  request.life = EntryLife{.ephemeral = true};
  write(request);
  WaitEdge edge;
  edge.kind = WaitEdge::Kind::owner;
  edge.waiter = bob;
  edge.address = {"a", "z"};
  EXPECT_EQ(service.follow(edge), ann);
  edge.address = {"a", "x"};
  EXPECT_EQ(service.follow(edge), nullptr) << "nobody's end ends it";
}

} // namespace castor::test
