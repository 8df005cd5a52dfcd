#include "castor/tests/communication/table_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::communication::test::oracle {

Verdict verdict(bool x) {
  return x ? Verdict::yes : Verdict::no;
}

Verdict opposite(Verdict x) {
  if (x == Verdict::unknown)
    return x;
  return x == Verdict::yes ? Verdict::no : Verdict::yes;
}

std::vector<World> completions(const std::vector<Thing>& scene) {
  std::vector<World> worlds{{}};
  for (auto& thing : scene) {
    std::vector<Thing> versions;
    const std::vector<std::string> colours =
      thing.colour.empty() ? std::vector<std::string>{"red", "blue", "green", "pink"}
                           : std::vector{thing.colour};
    const std::vector<std::string> shapes =
      thing.shape.empty() ? std::vector<std::string>{"cube", "ball", "cylinder", "pyramid"}
                          : std::vector{thing.shape};
    for (auto& colour : colours)
      for (auto& shape : shapes) {
        versions.push_back(thing);
        versions.back().colour = colour;
        versions.back().shape = shape;
      }
    std::vector<World> larger;
    for (auto& world : worlds)
      for (auto& version : versions) {
        larger.push_back(world);
        larger.back().push_back(version);
      }
    worlds = std::move(larger);
  }
  return worlds;
}

// -- space and size

bool is_left_of(const Thing& a, const Thing& b) {
  return b.x - a.x >= 0.08 && b.x - a.x >= std::abs(b.y - a.y) / 2;
}

bool is_behind(const Thing& a, const Thing& b) {
  return a.y - b.y >= 0.08 && a.y - b.y >= std::abs(b.x - a.x) / 2;
}

bool is_near(const Thing& a, const Thing& b) {
  return std::hypot(a.x - b.x, a.y - b.y) <= 0.105;
}

bool is_larger(const Thing& a, const Thing& b) {
  return a.extent > 1.1 * b.extent;
}

Verdict is_same(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? Verdict::unknown : verdict(a == b);
}

// -- predicates

Predicate anything() {
  return [](auto&, auto&) { return Verdict::yes; };
}

Predicate has_colour(const std::string& word) {
  return [word](auto&, auto& x) { return is_same(x.colour, word); };
}

Predicate has_shape(const std::string& word) {
  return [word](auto&, auto& x) { return is_same(x.shape, word); };
}

Predicate has_size(const std::string& word) {
  return [word](auto&, auto& x) { return is_same(x.size, word); };
}

Predicate all_of(std::vector<Predicate> predicates) {
  return [predicates = std::move(predicates)](auto& world, auto& x) {
    auto result = Verdict::yes;
    for (auto& is : predicates)
      result = std::min(result, is(world, x));
    return result;
  };
}

Predicate any_of(std::vector<Predicate> predicates) {
  return [predicates = std::move(predicates)](auto& world, auto& x) {
    auto result = Verdict::no;
    for (auto& is : predicates)
      result = std::max(result, is(world, x));
    return result;
  };
}

Predicate is_not(Predicate predicate) {
  return [is = std::move(predicate)](auto& world, auto& x) { return opposite(is(world, x)); };
}

// -- counting

Number number_of(const World& world, const Predicate& what) {
  Number result;
  for (auto& x : world) {
    auto is_so = what(world, x);
    result.least += is_so == Verdict::yes ? 1 : 0;
    result.most += is_so == Verdict::no ? 0 : 1;
  }
  return result;
}

Verdict is_from_to(const Number& x, std::size_t least, std::size_t most) {
  std::size_t fitting = 0;
  for (auto number = x.least; number <= x.most; ++number)
    fitting += number >= least && number <= most ? 1 : 0;
  if (fitting == 0)
    return Verdict::no;
  return fitting == x.most - x.least + 1 ? Verdict::yes : Verdict::unknown;
}

Predicate in_order(Predicate kind, Before before, std::size_t rank) {
  return [kind = std::move(kind), before = std::move(before), rank](auto& world, auto& x) {
    Number earlier;
    for (auto& other : world) {
      const auto is_one = kind(world, other);
      if (other.id == x.id || is_one == Verdict::no)
        continue;
      const bool is_earlier = before(world, other, x);
      const bool is_close = !is_earlier && !before(world, x, other);
      earlier.least += is_earlier && is_one == Verdict::yes ? 1 : 0;
      earlier.most += is_earlier || is_close ? 1 : 0;
    }
    return std::min(kind(world, x), is_from_to(earlier, rank - 1, rank - 1));
  };
}

} // namespace castor::communication::test::oracle
