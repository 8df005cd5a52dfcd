#include "castor/tests/communication/grid_fillers.hpp"

#include <cmath>

namespace castor::communication::test {

using namespace oracle;

const Relation left = [](auto& a, auto& b) { return verdict(is_left_of(a, b)); };
const Relation near = [](auto& a, auto& b) { return verdict(is_near(a, b)); };

namespace {

const Relation right = [](auto& a, auto& b) { return verdict(is_left_of(b, a)); };
const Relation behind = [](auto& a, auto& b) { return verdict(is_behind(a, b)); };
const Relation in_front = [](auto& a, auto& b) { return verdict(is_behind(b, a)); };
const Relation larger = [](auto& a, auto& b) { return verdict(is_larger(a, b)); };
const Relation smaller = [](auto& a, auto& b) { return verdict(is_larger(b, a)); };
const Relation as_large = [](auto& a, auto& b) {
  return verdict(!is_larger(a, b) && !is_larger(b, a));
};

std::vector<Scope> comparisons() {
  const auto same_colour = [](auto& a, auto& b) { return is_same(a.colour, b.colour); };
  const auto same_shape = [](auto& a, auto& b) { return is_same(a.shape, b.shape); };
  // "Not as large" is smaller, and not whatever is of another size.
  auto equally_large = related_to_the("as large as", as_large, "cylinder");
  auto not_as_large = related_to_the("not as large as", smaller, "cylinder");
  equally_large.is_plain = false;
  not_as_large.is_plain = false;
  return {related_to_the("larger than", larger, "red ball"),
          related_to_the("smaller than", smaller, "cube"),
          equally_large,
          not_as_large,
          related_to("larger than", larger, all("every", false), "ball"),
          related_to("smaller than", smaller, some("a", false), "cube"),
          related_to_the("the same colour as", same_colour, "ball"),
          related_to_the("the same shape as", same_shape, "red cube")};
}

} // namespace

// -- orders

Before by_size(bool largest_first) {
  return [largest_first](auto&, auto& a, auto& b) {
    return largest_first ? is_larger(a, b) : is_larger(b, a);
  };
}

Before from_the_left() {
  return [](auto&, auto& a, auto& b) { return a.x < b.x - 0.02; };
}

Before from_the_right() {
  return [](auto&, auto& a, auto& b) { return a.x > b.x + 0.02; };
}

Before nearer_to(const NounPhrase& to) {
  return [to](auto& world, auto& a, auto& b) {
    for (auto& x : world)
      if (to.is(world, x) == Verdict::yes)
        return std::hypot(a.x - x.x, a.y - x.y) < std::hypot(b.x - x.x, b.y - x.y) - 0.02;
    return false;
  };
}

// -- phrases

std::vector<NounPhrase> nouns() {
  std::vector<NounPhrase> result;
  for (const auto* words : {"thing", "cube", "ball", "cylinder", "red thing", "red cube",
                            "blue ball", "large cube", "small thing", "small red ball"})
    result.push_back(noun(words));
  return result;
}

std::vector<Scope> places() {
  return {related_to_the("left of", left, "red ball"),
          related_to_the("left of", left, "cube"),
          related_to_the("to the right of", right, "blue cube"),
          related_to_the("behind", behind, "cylinder"),
          related_to_the("in front of", in_front, "ball"),
          related_to_the("near", near, "red cube"),
          related_to("left of", left, some("a", false), "ball"),
          related_to("right of", right, all("every", false), "ball"),
          related_to("behind", behind, counted("two", true, 2, 2), "cube"),
          related_to("in front of", in_front, none("no", false), "cube"),
          related_to("near", near, all("all", true), "cube"),
          related_to("behind", behind, counted("at least two", true, 2, 1000), "thing")};
}

std::vector<Scope> scopes() {
  std::vector<Scope> result{adjective("red"),
                            adjective("blue"),
                            adjective("small"),
                            adjective("large"),
                            no_such(adjective("red")),
                            no_such(adjective("large")),
                            and_both(adjective("red"), adjective("small")),
                            and_both(adjective("large"), adjective("blue")),
                            nor_any(adjective("red"), adjective("blue")),
                            nor_any(adjective("green"), adjective("small")),
                            a_kind("cube"),
                            a_kind("red thing"),
                            a_kind("small ball"),
                            no_such(a_kind("ball"))};
  for (auto& x : places())
    result.push_back(x);
  for (auto& x : comparisons())
    result.push_back(x);
  result.push_back(no_such(related_to_the("left of", left, "cube")));
  result.push_back(no_such(related_to("near", near, some("a", false), "ball")));
  result.push_back(and_both(related_to_the("left of", left, "red ball"),
                            related_to_the("behind", behind, "cube")));
  result.push_back(and_both(adjective("red"), related_to_the("left of", left, "cube")));
  return result;
}

std::vector<Scope> scopes_of_several() {
  auto result = scopes();
  result.push_back(or_one(adjective("red"), adjective("blue")));
  result.push_back(or_one(adjective("green"), adjective("small")));
  result.push_back(or_one(a_kind("cube"), a_kind("ball")));
  result.push_back(
    or_one(related_to_the("left of", left, "cube"), related_to_the("behind", behind, "cube")));
  return result;
}

} // namespace castor::communication::test
