// How well things are followed through sequences of the Object Tracking Benchmark.
//
//     tracking_benchmark FOLDER...
//
// Each FOLDER holds a sequence: img/0001.jpg, ... and groundtruth_rect.txt. The tracker is shown
// the thing in the first picture only; overlaps (intersection by union) are those in all others.

#include "castor/benchmarks/tracking/otb_sequence.hpp"

#include <fmt/core.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: {} FOLDER...\n", argv[0]);
    return 2;
  }
  try {
    for (int i = 1; i < argc; ++i) {
      auto score = castor::otb::run(castor::otb::load_sequence(argv[i]));
      fmt::print("{}: {} pictures, mean overlap {:.3f}, success rate at 0.5 {:.3f}, missed in {}, "
                 "{:.1f} ms per picture\n",
                 argv[i], score.pictures, score.mean_overlap, score.success_rate, score.missed,
                 score.ms_per_picture);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
