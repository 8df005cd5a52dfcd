#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/binding_view.hpp"
#include "castor/binding/feature_comparator.hpp"
#include "castor/binding/ontology/stated_ontology.hpp"
#include "castor/binding/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace castor::binding {

/// Prefixes of the entry ids of a proxy's scores and of its best unions, followed by the proxy's
/// id.
inline constexpr std::string_view scores_prefix = "scores of ";
inline constexpr std::string_view best_prefix = "best unions for ";

/// Base class of the components of the binding subarchitecture: observes the proxies and the
/// unions, and processes all changes since its last turn. A restarted component therefore catches
/// up by itself.
class BindingComponent : public UnmanagedComponent {
protected:
  /// Ids of added, changed and deleted proxies and unions.
  struct Changes {
    std::set<std::string> proxies;
    std::set<std::string> unions;
  };

  void start() override;
  void run() override;

  /// Processes changes. The first call gets all proxies and unions.
  virtual void work(const Changes& changes) = 0;

  const BindingView& view() const { return view_; }

  /// For updates with the component's own writes.
  BindingView& view() { return view_; }

  /// Updates the view and returns the changes since the last call.
  Changes catch_up();

  /// Has concepts compared by what is stated on working memory now.
  /// \returns whether that has changed since the last call
  bool update_ontology(FeatureComparator& comparator);

  const StatedOntology& ontology() const { return ontology_; }

  /// Adds or overwrites an entry of the own working memory, unless it has this value already.
  template <class T>
  void put(const std::string& id, T x) {
    try {
      if (*read<T>(here(id)) == x)
        return;
    } catch (const DoesNotExistOnWM&) {
      trace("{} is new", id);
    }
    UnmanagedComponent::put(here(id), std::move(x));
  }

  /// Deletes an entry of the own working memory, if it exists.
  void drop(const std::string& id);

private:
  template <class T>
  void look_at(const std::set<std::string>& ids);

  Changes changes_;
  BindingView view_;
  StatedOntology ontology_;
  bool is_ontology_new_ = true;
};

} // namespace castor::binding
