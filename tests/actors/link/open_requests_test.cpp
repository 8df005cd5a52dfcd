#include "castor/actors/link/open_requests.hpp"

#include "castor/tools/simulation/testing_system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::test {

namespace {

using testing::IsEmpty;
using testing::SizeIs;

class OpenRequestsTest : public testing::Test, protected simulation::TestingSystem {
protected:
  OpenRequestsTest() { requests.add_process(1); }

  ~OpenRequestsTest() override {
    caf::anon_send_exit(caf::actor_cast<caf::actor>(sender), caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  static caf::message_id request(std::uint64_t number) {
    return caf::make_message_id(caf::message_id::default_async_value + number);
  }

  OpenRequests requests;
  caf::strong_actor_ptr sender = caf::actor_cast<caf::strong_actor_ptr>(
    system.spawn([]() -> caf::behavior { return {[](int) {}}; }));
};

TEST_F(OpenRequestsTest, OfALostProcessAreThoseThatWereNotAnswered) {
  EXPECT_TRUE(requests.add(1, sender, request(1)));
  EXPECT_TRUE(requests.add(1, sender, request(2)));
  requests.remove(sender, request(1).response_id());
  auto unanswered = requests.remove_process(1);
  ASSERT_THAT(unanswered, SizeIs(1));
  EXPECT_EQ(unanswered.front().sender, sender);
  EXPECT_EQ(unanswered.front().id, request(2));
  EXPECT_THAT(requests.remove_process(1), IsEmpty());
}

TEST_F(OpenRequestsTest, GoToNoProcessThatIsLostOrUnknown) {
  EXPECT_FALSE(requests.add(2, sender, request(1)));
  requests.remove_process(1);
  EXPECT_FALSE(requests.add(1, sender, request(1)));
}

TEST_F(OpenRequestsTest, OutliveTheLossOfOtherProcesses) {
  requests.add_process(2);
  requests.add(1, sender, request(1));
  requests.add(2, sender, request(2));
  EXPECT_THAT(requests.remove_process(2), SizeIs(1));
  EXPECT_THAT(requests.remove_process(1), SizeIs(1));
}

} // namespace

} // namespace castor::test
