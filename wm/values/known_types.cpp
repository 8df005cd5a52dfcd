#include "castor/wm/values/known_types.hpp"

#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

namespace castor {

namespace {

struct KnownTypes {
  std::mutex mutex;
  TypeCatalogue own;
  TypeCatalogue foreign;
  /// Make the descriptors of types of loaded libraries, and with that make them known.
  std::vector<const TypeDescriptorPtr& (*)()> announced;
  /// Held while that happens, so that nobody else is answered without these types.
  std::mutex describing;

  static KnownTypes& instance() {
    // Never destroyed: threads may outlive the static objects.
    static auto& result = *new KnownTypes;
    return result;
  }
};

} // namespace

void make_own_type_known(const TypeDescriptorPtr& type) {
  auto& types = KnownTypes::instance();
  std::lock_guard guard{types.mutex};
  types.own.emplace(type->name(), type);
}

void make_foreign_type_known(const TypeDescriptorPtr& type) {
  auto& types = KnownTypes::instance();
  std::lock_guard guard{types.mutex};
  if (types.foreign.size() < most_foreign_types || types.foreign.count(type->name()) > 0)
    types.foreign[type->name()] = type;
}

bool detail::announce_type(const TypeDescriptorPtr& (*descriptor)()) {
  auto& types = KnownTypes::instance();
  std::lock_guard guard{types.mutex};
  types.announced.push_back(descriptor);
  return true;
}

TypeCatalogue known_types() {
  auto& types = KnownTypes::instance();
  std::lock_guard one_at_a_time{types.describing};
  decltype(types.announced) announced;
  {
    std::lock_guard guard{types.mutex};
    announced = std::exchange(types.announced, {});
  }
  for (auto* descriptor : announced) {
    try {
      descriptor();
    } catch (const std::logic_error&) {
      // A type that is ill-formed is refused where it is used.
    }
  }
  std::lock_guard guard{types.mutex};
  auto result = types.own;
  result.insert(types.foreign.begin(), types.foreign.end());
  return result;
}

} // namespace castor
