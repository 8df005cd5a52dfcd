// What it costs to find the filters that want a change, by how many are registered: one (and then
// ten) of them match, whatever their number. Content is matched in place, as in a working memory.
//
//   filter_index_benchmark [MOST_FILTERS]
#include "castor/wm/filters/filter_index.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace castor::benchmark {

namespace {

using Clock = std::chrono::steady_clock;

struct Spot {
  double x = 0;
  double y = 0;
  double z = 0;
};
CASTOR_REFLECT(Spot, x, y, z)

/// An entry as they are in vision, with a picture that nobody should touch.
struct Thing {
  std::string label;
  double confidence = 0;
  Spot position;
  std::vector<std::uint8_t> picture = std::vector<std::uint8_t>(100'000);
};
CASTOR_REFLECT(Thing, label, confidence, position, picture)

/// A kind of filter: of the i-th of all filters, those match in which i is 0.
struct Kind {
  std::string name;
  std::function<ChangeFilter(std::size_t i)> filter;
};

const std::vector<Kind> kinds{
  {"type",
   [](std::size_t i) {
     auto result = any_change().anywhere();
     result.type = i == 0 ? type_name<Thing>() : "Type" + std::to_string(i);
     return result;
   }},
  {"address",
   [](std::size_t i) {
     return changes_of({"vision", std::to_string(i)});
   }},
  {"equality in content",
   [](std::size_t i) {
     return changed<Thing>().anywhere().where(&Thing::label, "label " + std::to_string(i));
   }},
  {"range with one end",
   [](std::size_t i) {
     return changed<Thing>().anywhere().where(field(&Thing::confidence) <
                                              0.5 - static_cast<double>(i));
   }},
  {"range with two ends",
   [](std::size_t i) {
     auto low = static_cast<double>(i) - 0.5;
     return changed<Thing>().anywhere().where(field(&Thing::confidence) >= low &&
                                              field(&Thing::confidence) < low + 1);
   }},
  {"near a point",
   [](std::size_t i) {
     Spot centre{static_cast<double>(i % 300), static_cast<double>(i / 300), 0};
     return changed<Thing>().anywhere().where(distance(field(&Thing::position), centre) < 0.5);
   }},
  {"changed field",
   [](std::size_t i) {
     return i == 0 ? changed(&Thing::label).anywhere()
                   : changed(&Thing::confidence, &Thing::position).anywhere();
   }},
  {"changed field, address",
   [](std::size_t i) {
     return changed(&Thing::label).at({"vision", std::to_string(i)});
   }},
};

/// Nanoseconds for one search, the least of several runs: whatever disturbs only adds.
double cost(FilterIndex& index, const ChangeEvent& event, const Value& content,
            std::size_t matching) {
  constexpr int runs = 15;
  constexpr int searches = 3000;
  auto least = Clock::duration::max();
  std::vector<FilterIndex::Key> found;
  for (int run = 0; run < runs; ++run) {
    auto begin = Clock::now();
    for (int i = 0; i < searches; ++i) {
      found.clear();
      index.match(event, content, found);
    }
    least = std::min(least, Clock::now() - begin);
    if (found.size() != matching) {
      fmt::print(stderr, "{} filters found instead of {}\n", found.size(), matching);
      std::exit(1);
    }
  }
  return std::chrono::duration<double, std::nano>(least).count() / searches;
}

void measure(const Kind& kind, std::size_t matching, std::size_t most) {
  auto content = Value::of(Thing{"label 0", 0, {}, std::vector<std::uint8_t>(100'000)});
  ChangeEvent event;
  event.operation = Operation::overwrite;
  event.address = {"vision", "0"};
  event.source = "tracker";
  event.type = content.type_ptr();
  event.changed = field_bit(*event.type, "label");
  FilterIndex index;
  std::size_t registered = 0;
  double first = 0;
  fmt::print("{:<24}{:>9}", kind.name, matching);
  for (std::size_t count = 10; count <= most; count *= 10) {
    for (; registered < count; ++registered)
      index.insert(registered, kind.filter(registered < matching ? 0 : registered));
    auto ns = cost(index, event, content, matching);
    first = count == 10 ? ns : first;
    fmt::print("{:>8.0f} ({:.2f})", ns, ns / first);
  }
  fmt::print("\n");
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  auto most = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 100'000;
  fmt::print(
    "ns for one search (and its ratio to that among ten filters), by filters registered\n");
  fmt::print("{:<24}{:>9}", "filters by", "matching");
  for (std::size_t count = 10; count <= most; count *= 10)
    fmt::print("{:>15}", count);
  fmt::print("\n");
  for (auto& kind : kinds)
    for (std::size_t matching : {1, 10})
      measure(kind, matching, most);
}
