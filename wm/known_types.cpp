#include "castor/wm/known_types.hpp"

#include <mutex>

namespace castor {

namespace {

struct KnownTypes {
  std::mutex mutex;
  TypeCatalogue own;
  TypeCatalogue foreign;

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

TypeCatalogue known_types() {
  auto& types = KnownTypes::instance();
  std::lock_guard guard{types.mutex};
  auto result = types.own;
  result.insert(types.foreign.begin(), types.foreign.end());
  return result;
}

} // namespace castor
