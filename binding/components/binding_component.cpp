#include "castor/binding/components/binding_component.hpp"

#include <map>
#include <type_traits>
#include <utility>

namespace castor::binding {

void BindingComponent::start() {
  on_change(changed<BindingProxy>(),
            [this](const ChangeEvent& event) { changes_.proxies.insert(event.address.id); });
  on_change(changed<BindingUnion>(),
            [this](const ChangeEvent& event) { changes_.unions.insert(event.address.id); });
  on_change(changed<ConceptStatements>(), [this](const ChangeEvent&) { is_ontology_new_ = true; });
  for (auto& x : read_all<BindingProxy>())
    changes_.proxies.insert(x.address.id);
  for (auto& x : read_all<BindingUnion>())
    changes_.unions.insert(x.address.id);
}

void BindingComponent::run() {
  do
    work(catch_up());
  while (wait_for_changes() || is_running());
}

BindingComponent::Changes BindingComponent::catch_up() {
  auto changes = std::exchange(changes_, {});
  look_at<BindingProxy>(changes.proxies);
  look_at<BindingUnion>(changes.unions);
  return changes;
}

bool BindingComponent::update_ontology(FeatureComparator& comparator) {
  if (!std::exchange(is_ontology_new_, false))
    return false;
  std::map<std::string, ConceptStatements> entries;
  for (auto& x : read_all<ConceptStatements>())
    entries.emplace(x.address.id, *x);
  auto stated = stated_ontology(entries);
  const bool is_changed = stated.version != ontology_.version;
  ontology_ = std::move(stated);
  comparator.set_ontology(ontology_.ontology);
  if (is_changed)
    for (auto& problem : ontology_.problems)
      warning("{}", problem);
  return is_changed;
}

void BindingComponent::drop(const std::string& id) {
  // Mostly it is not there, and to look is cheap.
  if (!exists(here(id)))
    return;
  try {
    delete_entry(here(id));
  } catch (const DoesNotExistOnWM&) {
    trace("{} is gone already", id);
  }
}

template <class T>
void BindingComponent::look_at(const std::set<std::string>& ids) {
  for (auto& id : ids)
    try {
      view_.set(id, read<T>(here(id)).object);
    } catch (const DoesNotExistOnWM&) {
      if constexpr (std::is_same_v<T, BindingProxy>)
        view_.remove_proxy(id);
      else
        view_.remove_union(id);
    }
}

} // namespace castor::binding
