#include "castor/tools/chaos/minimise.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <numeric>
#include <set>

namespace castor::faults {

namespace {

using Items = std::vector<int>;
using testing::ElementsAre;
using testing::IsEmpty;

Items up_to(int n) {
  Items result(static_cast<std::size_t>(n));
  std::iota(result.begin(), result.end(), 0);
  return result;
}

bool has_all(const Items& items, const Items& wanted) {
  return std::ranges::all_of(wanted, [&](int x) { return std::ranges::count(items, x) > 0; });
}

TEST(Minimise, FindsTheItemsThatMatter) {
  EXPECT_THAT(minimise<int>(up_to(8),
                            [](auto& x) {
                              return has_all(x, {1, 6});
                            }),
              ElementsAre(1, 6));
  EXPECT_THAT(minimise<int>(up_to(100), [](auto& x) { return has_all(x, {42}); }), ElementsAre(42));
  EXPECT_THAT(minimise<int>(up_to(5), [](auto& x) { return has_all(x, up_to(5)); }),
              ElementsAre(0, 1, 2, 3, 4));
}

TEST(Minimise, FindsThatNothingMatters) {
  EXPECT_THAT(minimise<int>(up_to(5), [](auto&) { return true; }), IsEmpty());
  EXPECT_THAT(minimise<int>({}, [](auto&) { return true; }), IsEmpty());
}

TEST(Minimise, StopsAfterSoManyTries) {
  std::size_t asked = 0;
  auto result = minimise<int>(
    up_to(1000),
    [&](auto& x) {
      ++asked;
      return has_all(x, {1, 500, 900});
    },
    20);
  EXPECT_EQ(asked, 20U);
  EXPECT_TRUE(has_all(result, {1, 500, 900}));
}

TEST(Minimise, AsksRarelyForOneItemOfMany) {
  std::size_t asked = 0;
  minimise<int>(up_to(1024), [&](auto& x) {
    ++asked;
    return has_all(x, {700});
  });
  EXPECT_LE(asked, 25U);
}

/// Whatever it is that has to come together, of several ways.
RC_GTEST_PROP(Minimise, LeavesNothingThatCouldBeLeftOut, ()) {
  auto ways = *rc::gen::nonEmpty(
    rc::gen::container<std::vector<Items>>(rc::gen::container<Items>(rc::gen::inRange(0, 20))));
  auto holds = [&](const Items& x) {
    return std::ranges::any_of(ways, [&](auto& way) { return has_all(x, way); });
  };
  auto result = minimise<int>(up_to(20), holds);
  RC_ASSERT(holds(result));
  RC_ASSERT(std::ranges::is_sorted(result));
  for (std::size_t i = 0; i < result.size(); ++i) {
    auto smaller = result;
    smaller.erase(smaller.begin() + static_cast<std::ptrdiff_t>(i));
    RC_ASSERT(!holds(smaller));
  }
}

} // namespace

} // namespace castor::faults
