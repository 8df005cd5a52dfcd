// What Redis costs; one measurement of scripts/bench at a time. A redis-server listens at `port` of
// 127.0.0.1.
#include "castor/benchmarks/own_process.hpp"
#include "castor/benchmarks/performance/measurement.hpp"
#include "castor/benchmarks/performance/shared_page.hpp"
#include "castor/benchmarks/race.hpp"

#include <hiredis/hiredis.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace castor::benchmark {

namespace {

class Connection {
public:
  explicit Connection(int port) : context_(redisConnect("127.0.0.1", port)) {
    if (context_ == nullptr || context_->err != 0)
      throw std::runtime_error("cannot connect with redis-server");
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { redisFree(context_); }

  /// Sends nothing before `finish`.
  void begin(const std::vector<std::string>& words) {
    std::vector<const char*> texts;
    std::vector<std::size_t> lengths;
    for (auto& x : words) {
      texts.push_back(x.data());
      lengths.push_back(x.size());
    }
    redisAppendCommandArgv(context_, static_cast<int>(words.size()), texts.data(), lengths.data());
  }

  /// Waits for the next reply.
  void finish() {
    void* reply = nullptr;
    if (redisGetReply(context_, &reply) != REDIS_OK)
      throw std::runtime_error(std::string{"redis-server: "} + context_->errstr);
    auto type = static_cast<redisReply*>(reply)->type;
    freeReplyObject(reply);
    if (type == REDIS_REPLY_ERROR)
      throw std::runtime_error("redis-server refuses a command");
  }

private:
  redisContext* context_;
};

int port_of(const Arguments& x) {
  return static_cast<int>(x.count("port"));
}

/// SETs of one key by each of `clients`, in pipelines of `in_flight`.
void measure_writes(const Arguments& x) {
  auto clients = static_cast<int>(x.count("clients"));
  auto in_flight = x.count("in_flight");
  // So many that syncing each pipeline takes no longer than the measurement should.
  auto pipelines =
    std::min<std::size_t>(100, std::max<std::size_t>(1, batch_of(x.count("bytes")) / in_flight));
  const std::string payload(x.count("bytes"), 'x');
  Race race{clients};
  std::vector<std::thread> threads;
  for (int i = 0; i < clients; ++i)
    threads.emplace_back([&, i] {
      Connection connection{port_of(x)};
      std::vector<std::string> set{"SET", "key" + std::to_string(i), payload};
      auto rate = race.measure_for(
        x.duration(), i, pipelines * in_flight, [] {},
        [&] {
          for (std::size_t p = 0; p < pipelines; ++p) {
            for (std::size_t k = 0; k < in_flight; ++k)
              connection.begin(set);
            for (std::size_t k = 0; k < in_flight; ++k)
              connection.finish();
          }
        });
      if (i == 0)
        print_figure("rate", rate);
    });
  for (auto& thread : threads)
    thread.join();
}

/// From a SET and a PUBLISH here until a subscriber, another process, has heard.
void measure_link_events(const Arguments& x) {
  auto file = SharedPage::make();
  OwnProcess subscriber{{"--subscribe", x.text("port"), file.path()}};
  SharedPage page{file.path()};
  Connection connection{port_of(x)};
  const std::string payload(x.count("bytes"), 'x');
  print_percentiles(measure_hearing(
    page, x.duration(),
    [&] {
      connection.begin({"SET", "key", payload});
      connection.begin({"PUBLISH", "changes", "key"});
      connection.finish();
      connection.finish();
    },
    [](std::chrono::nanoseconds pause) { std::this_thread::sleep_for(pause); }));
}

int subscribe(char** argv) {
  Connection connection{std::atoi(argv[2])};
  SharedPage page{argv[3]};
  connection.begin({"SUBSCRIBE", "changes"});
  connection.finish();
  std::thread{[] {
    await_end_of_input();
    std::_Exit(0);
  }}.detach();
  std::puts("subscribed");
  std::fflush(stdout);
  while (true) {
    connection.finish();
    page.hear();
  }
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  if (argc == 4 && argv[1] == std::string{"--subscribe"})
    return subscribe(argv);
  return run_measurement(argc, argv,
                         {{"link_writes", measure_writes}, {"link_events", measure_link_events}});
}
