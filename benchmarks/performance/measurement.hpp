#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace castor::benchmark {

/// Arguments of a measurement, given as NAME=VALUE. A name without a value is an error of the
/// caller, which ends the program.
class Arguments {
public:
  explicit Arguments(std::map<std::string, std::string> values) : values_(std::move(values)) {}

  const std::string& text(const std::string& name) const;
  double number(const std::string& name) const;
  std::size_t count(const std::string& name) const;

  /// How long a measurement should take, without its preparation.
  std::chrono::duration<double> duration() const {
    return std::chrono::duration<double>{number("seconds")};
  }

private:
  std::map<std::string, std::string> values_;
};

/// Measurements of a program, by name.
using Measurements = std::map<std::string, std::function<void(const Arguments&)>>;

/// A main function: runs the measurement that the first argument names, with the others as its
/// Arguments. What it measures are lines of standard output, each `figure NAME VALUE`, which
/// measure.py reads; scripts/bench knows their units.
int run_measurement(int argc, char** argv, const Measurements& measurements);

/// Prints a figure that was measured.
void print_figure(const std::string& name, double value);

/// Prints the median and the 99th percentile as the figures `p50` and `p99`.
/// @param microseconds not empty
void print_percentiles(std::vector<double> microseconds);

/// So many payloads of a size that making them takes little memory, and sending them long enough to
/// be timed.
std::size_t batch_of(std::size_t bytes);

} // namespace castor::benchmark
