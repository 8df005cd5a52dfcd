// What Cyclone DDS costs; one measurement of scripts/bench at a time. Samples are reliable and all
// are kept; the receiver, another process, acknowledges each with a sample of its own, as only that
// tells the writer that its value was taken.
#include "castor/benchmarks/own_process.hpp"
#include "castor/benchmarks/performance/measurement.hpp"
#include "castor/benchmarks/performance/shared_page.hpp"
#include "castor/benchmarks/race.hpp"

#include <dds/dds.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

// Made from sample.idl.
#include "sample.h"

namespace castor::benchmark {

namespace {

using Sample = castor_benchmark_Sample;

/// Over the loopback device, and without multicast: as the others are measured.
const char* const network = "<General><Interfaces><NetworkInterface name='lo' multicast='false'/>"
                            "</Interfaces><AllowMulticast>false</AllowMulticast></General>"
                            "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
                            "<Peers><Peer address='127.0.0.1'/></Peers></Discovery>";

dds_entity_t checked(dds_entity_t x) {
  if (x < 0)
    throw std::runtime_error(std::string{"DDS: "} + dds_strretcode(x));
  return x;
}

/// A participant that sends on one topic and receives on another.
class Peer {
public:
  Peer(dds_domainid_t domain, const char* sent, const char* received) {
    checked(dds_create_domain(domain, network));
    participant_ = checked(dds_create_participant(domain, nullptr, nullptr));
    auto qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    writer_ = checked(dds_create_writer(participant_, topic(sent), qos, nullptr));
    reader_ = checked(dds_create_reader(participant_, topic(received), qos, nullptr));
    dds_delete_qos(qos);
    auto arrived = checked(dds_create_readcondition(reader_, DDS_ANY_STATE));
    waitset_ = checked(dds_create_waitset(participant_));
    checked(dds_waitset_attach(waitset_, arrived, 0));
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() { dds_delete(participant_); }

  void await_other() const {
    auto deadline = Clock::now() + std::chrono::seconds{20};
    dds_publication_matched_status_t sends;
    dds_subscription_matched_status_t receives;
    do {
      if (Clock::now() > deadline)
        throw std::runtime_error("DDS does not discover the other process");
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
      checked(dds_get_publication_matched_status(writer_, &sends));
      checked(dds_get_subscription_matched_status(reader_, &receives));
    } while (sends.current_count == 0 || receives.current_count == 0);
  }

  void send(std::uint64_t number, std::vector<std::uint8_t>& content) const {
    Sample sample{};
    sample.number = number;
    sample.content._length = sample.content._maximum = static_cast<std::uint32_t>(content.size());
    sample.content._buffer = content.data();
    checked(dds_write(writer_, &sample));
  }

  /// Waits for samples, and calls `f` with the number of each.
  template <class F>
  void take(F&& f) {
    constexpr std::size_t most = 64;
    checked(dds_waitset_wait(waitset_, nullptr, 0, DDS_SECS(10)));
    void* samples[most]{};
    dds_sample_info_t infos[most];
    auto count = checked(dds_take(reader_, samples, infos, most, most));
    for (int i = 0; i < count; ++i)
      if (infos[i].valid_data)
        f(static_cast<const Sample*>(samples[i])->number);
    if (count > 0)
      checked(dds_return_loan(reader_, samples, count));
  }

private:
  dds_entity_t topic(const char* name) const {
    return checked(
      dds_create_topic(participant_, &castor_benchmark_Sample_desc, name, nullptr, nullptr));
  }

  dds_entity_t participant_ = 0;
  dds_entity_t writer_ = 0;
  dds_entity_t reader_ = 0;
  dds_entity_t waitset_ = 0;
};

/// A domain that other runs hardly use.
dds_domainid_t own_domain() {
  return static_cast<dds_domainid_t>(getpid() % 200);
}

/// Values that another process has received and acknowledged, with `in_flight` under way.
void measure_writes(const Arguments& x) {
  auto domain = own_domain();
  auto in_flight = x.count("in_flight");
  OwnProcess other{{"--serve", std::to_string(domain), ""}};
  Peer peer{domain, "values", "acknowledgements"};
  peer.await_other();
  std::vector<std::uint8_t> payload(x.count("bytes"), 'x');
  std::uint64_t sent = 0;
  std::uint64_t acknowledged = 0;
  auto await = [&](std::uint64_t number) {
    while (acknowledged < number)
      peer.take([&](std::uint64_t received) { acknowledged = std::max(acknowledged, received); });
  };
  auto operations = std::min(batch_of(x.count("bytes")), in_flight * 50);
  Race race{1};
  print_figure("rate", race.measure_for(
                         x.duration(), 0, operations, [] {},
                         [&] {
                           for (std::size_t i = 0; i < operations; ++i) {
                             peer.send(++sent, payload);
                             if (sent - acknowledged >= in_flight)
                               await(sent - in_flight + 1);
                           }
                           await(sent);
                         }));
}

/// From a write here until a reader, another process, has taken it.
void measure_link_events(const Arguments& x) {
  auto domain = own_domain();
  auto file = SharedPage::make();
  OwnProcess other{{"--serve", std::to_string(domain), file.path()}};
  SharedPage page{file.path()};
  Peer peer{domain, "values", "acknowledgements"};
  peer.await_other();
  std::vector<std::uint8_t> payload(x.count("bytes"), 'x');
  std::uint64_t sent = 0;
  print_percentiles(measure_hearing(
    page, x.duration(), [&] { peer.send(++sent, payload); },
    [](std::chrono::nanoseconds pause) { std::this_thread::sleep_for(pause); }));
}

/// Acknowledges values, or hears of them at the page if there is one.
int serve(char** argv) {
  Peer peer{static_cast<dds_domainid_t>(std::atoi(argv[2])), "acknowledgements", "values"};
  std::optional<SharedPage> page;
  if (*argv[3] != '\0')
    page.emplace(argv[3]);
  std::thread{[] {
    await_end_of_input();
    std::_Exit(0);
  }}.detach();
  std::puts("ready");
  std::fflush(stdout);
  std::vector<std::uint8_t> nothing;
  while (true)
    peer.take([&](std::uint64_t number) {
      if (page)
        page->hear();
      else
        peer.send(number, nothing);
    });
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  if (argc == 4 && argv[1] == std::string{"--serve"})
    return serve(argv);
  return run_measurement(argc, argv,
                         {{"link_writes", measure_writes}, {"link_events", measure_link_events}});
}
