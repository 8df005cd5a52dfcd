#include "castor/tools/chaos/moments.hpp"

#include "castor/tools/chaos/seeded_random.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace castor::faults {

namespace {

/// Of one statement.
constexpr std::size_t most_moments = 1'000'000;

/// Collects them by the kind of the trigger.
class Moments {
public:
  Moments(std::uint64_t seed, std::string_view purpose, Timestamp duration)
    : random_(seed, purpose), duration_(duration) {}

  std::vector<Timestamp> take() { return std::move(moments_); }

  void operator()(const At& x) { add(x.time); }

  void operator()(const Every& x) {
    for (auto t = x.period; t < duration_; t += x.period)
      add(t);
  }

  /// Each millisecond has the same chance, exactly the same on every machine, as would not be with
  /// logarithms.
  void operator()(const AtRandom& x) {
    constexpr std::uint64_t milliseconds_per_thousand_seconds = 1'000'000;
    for (Timestamp t{0}; t < duration_; t += millisecond)
      if (random_.below(milliseconds_per_thousand_seconds) < x.rate.per_thousand_seconds)
        add(t);
  }

  void operator()(const After&) {}

private:
  void add(Timestamp x) {
    if (moments_.size() == most_moments)
      throw std::length_error{"something would happen more than " + std::to_string(most_moments) +
                              " times"};
    if (x < duration_)
      moments_.push_back(x);
  }

  SeededRandom random_;
  Timestamp duration_;
  std::vector<Timestamp> moments_;
};

} // namespace

std::vector<Timestamp> moments_of(const Trigger& trigger, std::uint64_t seed,
                                  std::string_view purpose, Timestamp duration) {
  Moments result{seed, "moments of " + std::string{purpose}, duration};
  std::visit(result, trigger);
  return result.take();
}

} // namespace castor::faults
