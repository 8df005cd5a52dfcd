// What grows with the number of nodes.
#include "castor/actors/component/health.hpp"
#include "castor/benchmarks/node_process.hpp"
#include "castor/benchmarks/performance/castor_measurements.hpp"
#include "castor/benchmarks/performance/castor_system.hpp"
#include "castor/benchmarks/performance/process_cost.hpp"
#include "castor/benchmarks/performance/shared_page.hpp"

#include <fmt/core.h>

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

/// Time after which nothing is left of the start: links rest.
constexpr auto settling = 5s;

/// Time without a connection after which a node is lost; until then it is out of reach.
constexpr auto patience = 3000ms;

/// Seconds of processor time: of the coordinator, and of all nodes together.
struct Work {
  double coordinator = 0;
  double nodes = 0;
};

Work operator-(const Work& x, const Work& y) {
  return {x.coordinator - y.coordinator, x.nodes - y.nodes};
}

/// The nodes of the running measurement.
struct Mesh {
  explicit Mesh(const Arguments& x) : arguments(x) {
    for (std::size_t i = 0; i < x.count("nodes"); ++i)
      nodes.push_back(std::make_unique<NodeProcess>(fmt::format("node{}", i), 10s));
  }

  double count() const { return static_cast<double>(nodes.size()); }

  Work work() const {
    auto add = [](double sum, auto& node) { return sum + processor_seconds(node->id()); };
    return {processor_seconds(getpid()), std::accumulate(nodes.begin(), nodes.end(), 0.0, add)};
  }

  double memory_of_nodes() const {
    auto add = [](double sum, auto& node) { return sum + memory_bytes(node->id()); };
    return std::accumulate(nodes.begin(), nodes.end(), 0.0, add);
  }

  const Arguments& arguments;
  const SharedPage::File file = SharedPage::make();
  std::vector<std::unique_ptr<NodeProcess>> nodes;
  Work before_start;
  Clock::time_point begin;
};

Mesh* mesh = nullptr;

/// One on each node.
class FarHearer final : public UnmanagedComponent {
  void start() override {
    page_.emplace(file_);
    on_change(overwritten<Payload>().anywhere(), [this](const ChangeEvent&) { page_->hear(); });
  }

  std::optional<SharedPage> page_;
  Option<std::string> file_{this, "page", "", "file that it shares with the coordinator"};
};
CASTOR_COMPONENT(FarHearer, "hears of overwrites on a node")

/// Measures from the coordinator.
class MeshMeter final : public UnmanagedComponent {
  void start() override {
    on_change(added<ComponentDown>().in(health_subarchitecture), [this](const ChangeEvent& event) {
      if (event.address.id == awaited_)
        lost_at_ = Clock::now();
    });
  }

  void run() override {
    measure_start();
    sleep_for(settling);
    auto idle = measure_idle();
    address_ = add(payload_of(100));
    measure_hearing_of_all();
    measure_work_of_hearing(idle);
    measure_loss("silent", SIGSTOP);
    measure_loss("killed", SIGKILL);
    end_system(0, "done");
  }

  static void measure_start() {
    print_figure("start", std::chrono::duration<double>(Clock::now() - mesh->begin).count());
    auto work = mesh->work() - mesh->before_start;
    print_figure("start_coordinator", work.coordinator);
    print_figure("start_node", work.nodes / mesh->count());
  }

  /// Seconds of processor time for each second.
  Work measure_idle() {
    auto before = mesh->work();
    auto begin = Clock::now();
    sleep_for(std::chrono::duration_cast<std::chrono::nanoseconds>(mesh->arguments.duration()));
    auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    auto work = mesh->work() - before;
    print_figure("idle_coordinator", work.coordinator / seconds);
    print_figure("idle_node", work.nodes / mesh->count() / seconds);
    print_figure("memory_coordinator", memory_bytes(getpid()));
    print_figure("memory_node", mesh->memory_of_nodes() / mesh->count());
    return {work.coordinator / seconds, work.nodes / seconds};
  }

  void measure_hearing_of_all() {
    SharedPage page{mesh->file.path()};
    std::vector<double> microseconds;
    for (auto end = Clock::now() + mesh->arguments.duration(); Clock::now() < end;) {
      sleep_for(5ms);
      auto begin = Clock::now();
      overwrite(address_, payload_of(100));
      heard_ += static_cast<std::int64_t>(mesh->nodes.size());
      page.await_heard(heard_);
      microseconds.push_back(
        std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    }
    print_percentiles(microseconds);
  }

  /// Without anybody who waits for the hearers.
  void measure_work_of_hearing(const Work& idle) {
    constexpr int overwrites = 50;
    auto before = mesh->work();
    auto begin = Clock::now();
    for (int i = 0; i < overwrites; ++i) {
      overwrite(address_, payload_of(100));
      sleep_for(20ms);
    }
    auto seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    auto work = mesh->work() - before;
    auto hearings = overwrites * mesh->count();
    print_figure("hearing_coordinator", (work.coordinator - idle.coordinator * seconds) / hearings);
    print_figure("hearing_node", (work.nodes - idle.nodes * seconds) / hearings);
  }

  /// Seconds from a signal to the last node until it is out of reach.
  void measure_loss(const std::string& figure, int signal) {
    auto& node = *mesh->nodes.back();
    lost_at_.reset();
    awaited_ = fmt::format("hearer{}", mesh->nodes.size() - 1);
    auto begin = Clock::now();
    node.signal(signal);
    while (!lost_at_ && Clock::now() < begin + 30s)
      wait_for_changes(1s);
    if (!lost_at_)
      throw std::runtime_error("the loss of a node was not noticed in 30 seconds");
    print_figure(figure, std::chrono::duration<double>(*lost_at_ - begin - patience).count());
    node.kill();
    mesh->nodes.pop_back();
  }

  Address address_;
  std::int64_t heard_ = 0;
  /// The component whose loss is awaited, and when it was noticed.
  std::string awaited_;
  std::optional<Clock::time_point> lost_at_;
};
CASTOR_COMPONENT(MeshMeter, "measures what nodes cost")

} // namespace

void measure_mesh(const Arguments& x) {
  Mesh running{x};
  mesh = &running;
  SystemOptions options;
  options.link.patience = patience;
  options.connect_patience = options.part_patience = 60s;
  std::string text;
  for (std::size_t i = 0; i < running.nodes.size(); ++i) {
    auto& node = *running.nodes[i];
    options.nodes[node.name()] = node.endpoint();
    text += subarchitecture_text(fmt::format("s{}", i), node.name()) +
            fmt::format("CPP UM hearer{} FarHearer --page {}\n", i, running.file.path());
  }
  text += subarchitecture_text("s") + "CPP UM meter MeshMeter --deadline 1h --budget 1h\n";
  running.before_start = running.work();
  running.begin = Clock::now();
  run_system(text, options);
}

} // namespace castor::benchmark
