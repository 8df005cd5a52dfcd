#include "castor/benchmarks/safety/injection.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace castor::benchmark {

namespace {

using nlohmann::json;

json to_json(const Injection& x) {
  return {{"kind", x.kind},    {"braked_ms", x.stop.braked_ms},   {"stood_ms", x.stop.stood_ms},
          {"way", x.stop.way}, {"collisions", x.stop.collisions}, {"waited_ms", x.waited_ms}};
}

Injection from_json(const json& x) {
  Injection result;
  x.at("kind").get_to(result.kind);
  x.at("braked_ms").get_to(result.stop.braked_ms);
  x.at("stood_ms").get_to(result.stop.stood_ms);
  x.at("way").get_to(result.stop.way);
  x.at("collisions").get_to(result.stop.collisions);
  x.at("waited_ms").get_to(result.waited_ms);
  return result;
}

/// Median and maximum.
std::pair<double, double> median_and_max(std::vector<double> x) {
  std::ranges::sort(x);
  return {x[(x.size() - 1) / 2], x.back()};
}

template <class F>
std::pair<double, double> median_and_max(const std::vector<Injection>& all, F f) {
  std::vector<double> values;
  for (const auto& x : all)
    values.push_back(f(x));
  return median_and_max(std::move(values));
}

StopSummary summary_of(const std::vector<Injection>& all) {
  StopSummary result;
  result.count = all.size();
  std::tie(result.braked_p50, result.braked_max) =
    median_and_max(all, [](auto& x) { return x.stop.braked_ms; });
  std::tie(result.stood_p50, result.stood_max) =
    median_and_max(all, [](auto& x) { return x.stop.stood_ms; });
  std::tie(result.way_p50, result.way_max) =
    median_and_max(all, [](auto& x) { return x.stop.way; });
  for (const auto& x : all) {
    if (x.stop.braked_ms > bound_ms)
      ++(x.stop.braked_ms - x.waited_ms > bound_ms ? result.late : result.late_by_load);
    result.waited_max = std::max(result.waited_max, x.waited_ms);
    result.collisions = std::max(result.collisions, x.stop.collisions);
  }
  return result;
}

} // namespace

std::map<std::string, StopSummary> summarise(const std::vector<Injection>& injections) {
  std::map<std::string, std::vector<Injection>> by_kind;
  for (const auto& x : injections)
    by_kind[x.kind].push_back(x);
  std::map<std::string, StopSummary> result;
  for (const auto& [kind, all] : by_kind)
    result.emplace(kind, summary_of(all));
  return result;
}

std::vector<Injection> read_injections(const std::filesystem::path& file) {
  std::vector<Injection> result;
  std::ifstream in{file};
  int number = 1;
  for (std::string line; std::getline(in, line); ++number) {
    try {
      result.push_back(from_json(json::parse(line)));
    } catch (const json::exception& e) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) +
                               ": no injection: " + e.what() + "; remove the line");
    }
  }
  return result;
}

void append(const Injection& x, const std::filesystem::path& file) {
  std::ofstream out{file, std::ios::app};
  if (!(out << to_json(x).dump() << '\n' << std::flush))
    throw std::runtime_error(file.string() + " cannot be written; name another file");
}

} // namespace castor::benchmark
