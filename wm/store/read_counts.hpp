#pragma once

#include "castor/wm/store/spin_lock.hpp"
#include "castor/wm/values/type_descriptor.hpp"

#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Counts of the entries that components have read without a message, by component and type of
/// entry. Components count on their own threads.
class ReadCounts {
public:
  /// The counts of one component.
  class OfComponent {
  public:
    explicit OfComponent(std::string component) : component_(std::move(component)) {}

    void add(const TypeDescriptorPtr& type) {
      std::lock_guard guard{lock_};
      for (auto& x : counts_)
        if (x.type == type) {
          ++x.count;
          return;
        }
      counts_.push_back({type, 1});
    }

  private:
    friend class ReadCounts;

    struct Count {
      TypeDescriptorPtr type;
      std::uint64_t count = 0;
    };

    const std::string component_;
    SpinLock lock_;
    std::vector<Count> counts_;
  };

  /// Lives as long as the counts do.
  OfComponent& of_component(const std::string& component) {
    std::lock_guard guard{lock_};
    for (auto& x : components_)
      if (x.component_ == component)
        return x;
    return components_.emplace_back(component);
  }

  /// Calls `f` with each component, type and count.
  template <class F>
  void for_each(F&& f) {
    std::lock_guard guard{lock_};
    for (auto& x : components_) {
      std::lock_guard counts_guard{x.lock_};
      for (auto& y : x.counts_)
        f(x.component_, y.type->name(), y.count);
    }
  }

private:
  SpinLock lock_;
  std::list<OfComponent> components_;
};

} // namespace castor
