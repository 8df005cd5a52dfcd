#include <castor/castor.hpp>

#include <chrono>
#include <memory>
#include <vector>

using namespace std::chrono_literals;

struct Scan {
  std::vector<double> ranges;
};
CASTOR_REFLECT(Scan, ranges)

class Laser : public castor::StandaloneComponent {
  castor::Option<std::chrono::milliseconds> period_{this, "period", 100ms, "time between scans"};

  void run() override {
    while (sleep_for(period_.get()))
      push(Scan{{1.5, 0.25, 3}});
  }
};
CASTOR_COMPONENT(Laser, "pretends to scan")

class ScanReader : public castor::UnmanagedComponent {
  void start() override {
    on_push<Scan>("laser", [this](const std::shared_ptr<const Scan>& scan) {
      if (++scans_ == 3)
        info("three scans, the last one of {} ranges", scan->ranges.size());
    });
  }

  int scans_ = 0;
};
CASTOR_COMPONENT(ScanReader, "counts scans")
