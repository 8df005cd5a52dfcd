#include "castor/actors/link/actor_names.hpp"

#include "castor/actors/link/remote_actor.hpp"

#include <caf/make_actor.hpp>

#include <utility>

namespace castor {

void ActorNames::set(WellKnownActor number, const caf::strong_actor_ptr& who) {
  {
    std::lock_guard guard{mutex_};
    numbers_[who->id()] = static_cast<std::uint32_t>(number);
    locals_[static_cast<std::uint32_t>(number)] = who;
  }
  watch(who, make_actor_name(self_, number));
}

ActorName ActorNames::name_of(const caf::strong_actor_ptr& x) {
  if (!x)
    return 0;
  if (auto* remote = as_remote(x))
    return remote->actor();
  std::unique_lock guard{mutex_};
  if (closed_)
    return 0;
  auto [i, is_new] = numbers_.try_emplace(x->id(), 0u);
  if (!is_new)
    return make_actor_name(self_, i->second);
  i->second = ++last_number_;
  auto name = make_actor_name(self_, i->second);
  locals_[i->second] = x;
  guard.unlock();
  watch(x, name);
  return name;
}

void ActorNames::watch(const caf::strong_actor_ptr& who, ActorName name) {
  who->get()->attach_functor([names = weak_from_this(), name] {
    if (auto self = names.lock())
      self->end_of_local(name);
  });
}

caf::strong_actor_ptr ActorNames::actor_of(ActorName name) {
  if (name == 0)
    return nullptr;
  auto number = static_cast<std::uint32_t>(name);
  std::lock_guard guard{mutex_};
  if (process_of(name) == self_) {
    auto i = locals_.find(number);
    return i == locals_.end() ? nullptr : i->second;
  }
  auto process = processes_.find(process_of(name));
  if (process == processes_.end() || !process->second.port)
    return nullptr;
  auto& representative = process->second.representatives[number];
  if (!representative) {
    caf::actor_config config;
    representative = caf::make_actor<RemoteActor, caf::strong_actor_ptr>(
      system_.next_actor_id(), system_.node(), &system_, config, process->second.port, name);
    if (process->second.ended.count(number) > 0)
      end_remote(representative, caf::exit_reason::unknown);
  }
  return representative;
}

TypeDescriptorPtr ActorNames::type_of(std::uint64_t hash) {
  std::lock_guard guard{mutex_};
  auto i = types_.find(hash);
  return i == types_.end() ? nullptr : i->second;
}

void ActorNames::add_type(TypeDescriptorPtr type) {
  std::lock_guard guard{mutex_};
  auto hash = type->hash;
  types_.emplace(hash, std::move(type));
}

void ActorNames::add_port(std::shared_ptr<LinkPort> port) {
  std::lock_guard guard{mutex_};
  auto process = port->peer();
  processes_[process].port = std::move(port);
}

std::shared_ptr<LinkPort> ActorNames::port(ProcessNumber process) const {
  std::lock_guard guard{mutex_};
  auto i = processes_.find(process);
  return i == processes_.end() ? nullptr : i->second.port;
}

void ActorNames::end_of_local(ActorName name) {
  std::vector<std::shared_ptr<LinkPort>> ports;
  {
    std::lock_guard guard{mutex_};
    auto local = locals_.extract(static_cast<std::uint32_t>(name));
    if (!local)
      return;
    numbers_.erase(local.mapped()->id());
    for (auto& [number, process] : processes_)
      if (process.port)
        ports.push_back(process.port);
  }
  for (auto& port : ports)
    port->tell_end(name);
}

void ActorNames::end_of_remote(ActorName name) {
  auto number = static_cast<std::uint32_t>(name);
  caf::strong_actor_ptr representative;
  {
    std::lock_guard guard{mutex_};
    auto i = processes_.find(process_of(name));
    if (i == processes_.end())
      return;
    i->second.ended.insert(number);
    if (auto known = i->second.representatives.find(number);
        known != i->second.representatives.end())
      representative = known->second;
  }
  if (representative)
    end_remote(representative, caf::exit_reason::unknown);
}

std::vector<caf::strong_actor_ptr> ActorNames::remove_process(ProcessNumber process) {
  std::vector<caf::strong_actor_ptr> result;
  Process lost;
  {
    std::lock_guard guard{mutex_};
    if (auto x = processes_.extract(process))
      lost = std::move(x.mapped());
  }
  for (auto& [number, representative] : lost.representatives)
    result.push_back(std::move(representative));
  return result;
}

std::vector<ProcessNumber> ActorNames::close() {
  std::vector<ProcessNumber> result;
  // Their last references may end them, which is told to this object: not under the lock.
  std::unordered_map<std::uint32_t, caf::strong_actor_ptr> locals;
  std::lock_guard guard{mutex_};
  closed_ = true;
  for (auto& [number, process] : processes_)
    result.push_back(number);
  locals = std::move(locals_);
  numbers_.clear();
  return result;
}

} // namespace castor
