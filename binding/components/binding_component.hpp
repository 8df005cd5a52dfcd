#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/binding_view.hpp"
#include "castor/binding/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace castor::binding {

/// Followed by the proxy, the ids of the entries that say how well it fits, and where best.
inline constexpr std::string_view scores_prefix = "scores of ";
inline constexpr std::string_view best_prefix = "best unions for ";

/// What the components of the binding subarchitecture have in common: each sees the proxies and the
/// unions, and works whenever something has changed, on all that has changed since. So one that is
/// started again catches up by itself.
class BindingComponent : public UnmanagedComponent {
protected:
  /// Ids of what has come, changed or gone.
  struct Changes {
    std::set<std::string> proxies;
    std::set<std::string> unions;
  };

  void start() override;
  void run() override;

  /// Does what there is to do. Everything is in `changes` the first time.
  virtual void work(const Changes& changes) = 0;

  const BindingView& view() const { return view_; }

  /// For what the component itself has just written.
  BindingView& view() { return view_; }

  /// Looks at all that has changed since this was last called.
  Changes catch_up();

  /// Puts an entry into the own working memory, if it is to say something else than it does.
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

  /// Deletes an entry of the own working memory, if it is there.
  void drop(const std::string& id);

private:
  template <class T>
  void look_at(const std::set<std::string>& ids);

  Changes changes_;
  BindingView view_;
};

} // namespace castor::binding
