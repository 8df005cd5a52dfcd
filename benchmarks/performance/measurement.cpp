#include "castor/benchmarks/performance/measurement.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace castor::benchmark {

const std::string& Arguments::text(const std::string& name) const {
  auto i = values_.find(name);
  if (i == values_.end()) {
    std::fprintf(stderr, "the argument %s=VALUE is missing\n", name.c_str());
    std::exit(2);
  }
  return i->second;
}

double Arguments::number(const std::string& name) const {
  return std::atof(text(name).c_str());
}

std::size_t Arguments::count(const std::string& name) const {
  return static_cast<std::size_t>(std::atoll(text(name).c_str()));
}

int run_measurement(int argc, char** argv, const Measurements& measurements) {
  auto measurement = argc > 1 ? measurements.find(argv[1]) : measurements.end();
  if (measurement == measurements.end()) {
    std::fprintf(stderr, "usage: %s MEASUREMENT NAME=VALUE..., where MEASUREMENT is one of:\n",
                 argv[0]);
    for (auto& [name, f] : measurements)
      std::fprintf(stderr, "  %s\n", name.c_str());
    return 2;
  }
  std::map<std::string, std::string> values;
  for (int i = 2; i < argc; ++i) {
    std::string argument{argv[i]};
    auto sign = argument.find('=');
    if (sign == std::string::npos) {
      std::fprintf(stderr, "%s is not NAME=VALUE\n", argument.c_str());
      return 2;
    }
    values[argument.substr(0, sign)] = argument.substr(sign + 1);
  }
  try {
    measurement->second(Arguments{std::move(values)});
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", argv[1], e.what());
    return 1;
  }
  return 0;
}

void print_figure(const std::string& name, double value) {
  std::printf("figure %s %.9g\n", name.c_str(), value);
  std::fflush(stdout);
}

void print_percentiles(std::vector<double> microseconds) {
  std::sort(microseconds.begin(), microseconds.end());
  print_figure("p50", microseconds[microseconds.size() / 2]);
  print_figure("p99", microseconds[microseconds.size() * 99 / 100]);
}

std::size_t batch_of(std::size_t bytes) {
  constexpr std::size_t most_bytes = 128 << 20;
  return std::clamp<std::size_t>(most_bytes / bytes, 64, 5000);
}

} // namespace castor::benchmark
