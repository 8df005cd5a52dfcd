#pragma once

#include "castor/tests/binding/proxies.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <random>
#include <string>

namespace castor::binding::test {

using Proxies = std::map<std::string, BindingProxy>;

/// Proxies as chance has it: few words, so that they have to do with each other. With every other
/// seed it is mostly relations that they differ by.
class Chance {
public:
  explicit Chance(int seed)
    : random_(static_cast<std::mt19937::result_type>(seed)), relational_(seed % 2 == 1) {}

  int below(int limit) { return std::uniform_int_distribution<>(0, limit - 1)(random_); }

  bool once_in(int times) { return below(times) == 0; }

  std::string word(std::initializer_list<const char*> words) {
    return *(words.begin() + below(static_cast<int>(words.size())));
  }

  template <class T>
  void shuffle(T& x) {
    std::shuffle(x.begin(), x.end(), random_);
  }

  Feature some_feature() {
    Feature result;
    if (relational_ && !once_in(5))
      return once_in(2) ? concept_of("thing") : colour(word({"unknown", "red"}));
    switch (below(9)) {
      case 0:
      case 1:
        result = concept_of(word({"thing", "ball", "box", "toy", "place"}));
        break;
      case 2:
      case 3:
        result = colour(word({"red", "blue", "unknown"}));
        break;
      case 4:
        result = shape(word({"square", "round"}));
        break;
      case 5:
        return location_at(0.04 * below(6), 0, 0, "table");
      case 6:
        return frame(word({"perceived", "desired"}));
      case 7:
        return salient_from(below(5), below(5) + 5);
      default:
        return feature(FeatureKind::existing_proxy_id, id(below(12)));
    }
    result.negated = once_in(6);
    return result;
  }

  static std::string id(int number) { return "p" + std::to_string(number); }

  BindingProxy some_proxy(int others) {
    const auto source = word({"vision", "spatial", "comsys"});
    BindingProxy result;
    if (once_in(relational_ ? 2 : 4)) {
      result = relation_from(source, relational_ ? "left" : word({"left", "near"}),
                             id(below(others)), id(below(others)));
      if (once_in(8))
        result.out_ports.pop_back();
    } else {
      const int count = below(4);
      for (int i = 0; i < count; ++i)
        result.features.push_back(some_feature());
      result.source = source;
      if (once_in(10))
        result.type = ProxyType::group;
    }
    if (!once_in(3))
      result.features.push_back(not_from(source));
    result.precedence = once_in(3) ? 1 : 0;
    return result;
  }

  Proxies some_proxies(int count) {
    Proxies result;
    for (int i = 0; i < count; ++i)
      result.emplace(id(i), some_proxy(count));
    return result;
  }

private:
  std::mt19937 random_;
  bool relational_;
};

} // namespace castor::binding::test
