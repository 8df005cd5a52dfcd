#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/binding/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace castor::binding {

/// What a binding monitor is made of: says in binding's words what a subarchitecture knows. Derive
/// from it in the folder of the modality; it needs `ACCESS <that subarchitecture> WRITES binding`.
///
/// A monitor says what its proxies are to be, with `tell` and `withdraw`, and then `publish`es that
/// in one step: nobody sees half a relation. Meanwhile it holds a lease of the binder's status, so
/// it does not come in the way of the binder or of other monitors. As long as there is no binder,
/// everything is kept until there is one; a system without binding is none the worse for it.
class BindingMonitor : public UnmanagedComponent {
protected:
  void start() override {
    on_binding_change(changed<BinderStatus>(), [this](const ChangeEvent& event) {
      if (event.operation == Operation::add)
        tell_again();
    });
  }

  /// The same as `on_change`, for what happens in binding; nothing in a system without it.
  void on_binding_change(ChangeFilter filter, ChangeCallback callback) {
    try {
      on_change(std::move(filter).in(binding_), std::move(callback));
    } catch (const UnknownSubarchitectureException&) {
      debug("there is no binding in this system");
    }
  }

  /// The proxy is to be like this; what binding writes into it does not count. Others can say that
  /// they mean this very thing, by its id.
  void tell(const std::string& id, BindingProxy proxy) {
    proxy.source = subarchitecture();
    if (proxy.type == ProxyType::basic)
      proxy.features.push_back(feature(FeatureKind::this_proxy_id, id));
    for (auto& port : proxy.out_ports)
      port.owner = id;
    wanted_[id] = std::move(proxy);
  }

  /// The proxy is to go.
  void withdraw(const std::string& id) { wanted_[id] = std::nullopt; }

  /// Writes what has been told since. What cannot be written now is written later.
  void publish() {
    while (is_running() && !wanted_.empty()) {
      try {
        write_wanted();
        for (auto& [id, proxy] : std::exchange(wanted_, {}))
          if (proxy)
            told_[id] = std::move(*proxy);
          else
            told_.erase(id);
      } catch (const ConsistencyException& e) {
        debug("once more: {}", e.what());
      } catch (const AlreadyExistsOnWM& e) {
        debug("once more: {}", e.what());
      } catch (const DoesNotExistOnWM&) {
        debug("there is no binder yet");
        return;
      } catch (const UnknownSubarchitectureException&) {
        debug("there is no binding in this system");
        return;
      }
    }
  }

  /// Own proxies on working memory, such as those of a predecessor, by their ids.
  std::map<std::string, EntryOf<BindingProxy>> own_proxies() {
    std::map<std::string, EntryOf<BindingProxy>> result;
    try {
      for (auto& x :
           read_where_in<BindingProxy>(binding_, field(&BindingProxy::source) == subarchitecture()))
        result.emplace(x.address.id, x);
    } catch (const UnknownSubarchitectureException&) {
      debug("there is no binding in this system");
    }
    return result;
  }

  const std::string& binding() const { return binding_.get(); }

private:
  /// There is a new binder, perhaps because binding's working memory is a new, empty one.
  void tell_again() {
    for (auto& [id, proxy] : told_)
      wanted_.try_emplace(id, proxy);
    publish();
  }

  void write_wanted() {
    auto phase = lock({binding_, binder_status}, LockLevel::od);
    std::map<std::string, Address> going;
    for (auto& x : read_all_in<BindingProxyDeletionTask>(binding_))
      going.emplace(x->proxy, x.address);
    WriteBatch batch;
    for (auto& [id, proxy] : wanted_) {
      auto old = known(id);
      if (!old && proxy)
        batch.add({binding_, id}, *proxy);
      else if (old && !proxy && !going.contains(id))
        batch.add({binding_, new_id()}, BindingProxyDeletionTask{id});
      else if (old && proxy && !says_the_same(*old, *proxy))
        batch.overwrite({binding_, id}, updated(*old, *proxy));
      if (auto task = going.find(id); proxy && task != going.end())
        batch.delete_entry(task->second);
    }
    if (!batch.items().empty())
      write(batch);
  }

  /// The proxy as it stands there; null if it does not.
  std::shared_ptr<const BindingProxy> known(const std::string& id) {
    try {
      return read<BindingProxy>({binding_, id}).object;
    } catch (const DoesNotExistOnWM&) {
      return nullptr;
    }
  }

  static bool says_the_same(const BindingProxy& a, const BindingProxy& b) {
    return a.type == b.type && a.precedence == b.precedence && a.features == b.features &&
           a.out_ports == b.out_ports && a.hypothetical == b.hypothetical;
  }

  static BindingProxy updated(const BindingProxy& old, BindingProxy x) {
    x.union_id = old.union_id;
    x.proxy_ids = old.proxy_ids;
    x.binding_count = old.binding_count;
    x.updates = old.updates + 1;
    x.state = ProxyState::updated;
    return x;
  }

  Option<SubarchitectureName> binding_{this, "binding", "binding", "the binding subarchitecture"};

  /// What is still to be written; nothing for what is to go.
  std::map<std::string, std::optional<BindingProxy>> wanted_;
  std::map<std::string, BindingProxy> told_;
};

} // namespace castor::binding
