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

/// Base class of binding monitors, which represent a subarchitecture's knowledge as binding
/// proxies. Derive from it in the folder of the modality; it needs `ACCESS <that subarchitecture>
/// WRITES binding`.
///
/// A monitor sets and deletes its proxies with `tell` and `withdraw`, and then writes all of them
/// in one batch with `publish`, so no relation is ever incomplete. The write is made under a lease
/// of the binder's status, to avoid conflicts with the binder and other monitors. While there is no
/// binder, the proxies are kept and published later; in a system without binding nothing happens.
class BindingMonitor : public UnmanagedComponent {
protected:
  void start() override {
    on_binding_change(changed<BinderStatus>(), [this](const ChangeEvent& event) {
      if (event.operation == Operation::add)
        tell_again();
    });
  }

  /// As `on_change`, for changes in the binding subarchitecture; no effect in a system without it.
  void on_binding_change(ChangeFilter filter, ChangeCallback callback) {
    try {
      on_change(std::move(filter).in(binding_), std::move(callback));
    } catch (const UnknownSubarchitectureException&) {
      debug("there is no binding in this system");
    }
  }

  /// Sets a proxy, to be written by `publish`; fields that binding writes are ignored. Other
  /// proxies can refer to a basic one by its id (`existing_proxy_id`).
  void tell(const std::string& id, BindingProxy proxy) {
    proxy.source = subarchitecture();
    if (proxy.type == ProxyType::basic)
      proxy.features.push_back(feature(FeatureKind::this_proxy_id, id));
    for (auto& port : proxy.out_ports)
      port.owner = id;
    wanted_[id] = std::move(proxy);
  }

  /// Deletes a proxy at the next `publish`.
  void withdraw(const std::string& id) { wanted_[id] = std::nullopt; }

  /// Writes all proxies set or deleted since the last call. If there is no binder yet, they are
  /// written once there is one.
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

  /// This subarchitecture's proxies on working memory by id, including those of an earlier
  /// incarnation.
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

  /// Declares that this subarchitecture knows what there is of a kind, a concept such as "room": it
  /// tells of all of that by its proxies. With `answers_calls` it is called with a KnowledgeRequest
  /// whenever somebody asks, and with `learns_names` with a ToldName when somebody says what
  /// something is called; it serves these by `on_call`.
  void declare_knowledge_of(const std::string& kind, bool answers_calls = false,
                            bool learns_names = false) {
    competences_[kind] = {subarchitecture(), kind, answers_calls, learns_names};
    write_competences();
  }

  const std::string& binding() const { return binding_.get(); }

private:
  /// Publishes everything again for a new binder, whose working memory may be new and empty.
  void tell_again() {
    for (auto& [id, proxy] : told_)
      wanted_.try_emplace(id, proxy);
    publish();
    write_competences();
  }

  void write_competences() {
    try {
      for (auto& [kind, x] : competences_)
        put({binding_, "knowledge of " + kind + " in " + subarchitecture()}, x);
    } catch (const UnknownSubarchitectureException&) {
      debug("there is no binding in this system");
    }
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

  /// The proxy on binding's working memory; null if it does not exist.
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

  /// Proxies still to be written, by id; nothing for one to be deleted.
  std::map<std::string, std::optional<BindingProxy>> wanted_;
  std::map<std::string, BindingProxy> told_;
  std::map<std::string, KnowledgeCompetence> competences_;
};

} // namespace castor::binding
