#include "castor/actors/supervision/failover.hpp"

#include "castor/actors/node/working_memory_class.hpp"

#include <algorithm>
#include <utility>

namespace castor {

void Failover::set(Placement placement) {
  auto known = std::exchange(placement_, std::move(placement));
  for (auto& [host, process] : known.hosts)
    if (auto i = placement_.hosts.find(host); i != placement_.hosts.end()) {
      auto replaced = i->second;
      i->second = process;
      for (auto& [name, of] : placement_.of)
        if (of == replaced)
          of = process;
    }
  for (auto& [name, process] : known.of)
    if (auto i = placement_.of.find(name); i != placement_.of.end())
      i->second = process;
}

Failover::Loss Failover::lose(ProcessNumber lost, const std::vector<std::string>& names,
                              const ArchitectureDescription& architecture,
                              const std::function<bool(ProcessNumber)>& is_up) {
  awaited_.erase(lost);
  Loss result;
  for (auto& name : names)
    if (auto substitute = substitute_for(name, architecture, is_up)) {
      placement_.of[name] = *substitute;
      result.moved.push_back(name);
    } else {
      result.left.push_back(name);
    }
  result.needs_successor = !result.left.empty() || is_substitute(lost, architecture);
  return result;
}

void Failover::set_successor(ProcessNumber lost, ProcessNumber successor, Awaited awaited) {
  for (auto& [host, process] : placement_.hosts)
    if (process == lost)
      process = successor;
  for (auto& name : awaited.names)
    placement_.of[name] = successor;
  if (!awaited.names.empty())
    awaited_[successor] = std::move(awaited);
}

std::optional<Failover::Awaited> Failover::take_awaited(ProcessNumber process) {
  auto result = awaited_.extract(process);
  return result ? std::optional{std::move(result.mapped())} : std::nullopt;
}

void Failover::begin_move(const std::vector<std::string>& names) {
  moving_.insert(names.begin(), names.end());
}

bool Failover::is_awaited(const std::string& name) const {
  return std::any_of(awaited_.begin(), awaited_.end(),
                     [&](auto& x) { return std::ranges::count(x.second.names, name) > 0; });
}

std::optional<ProcessNumber>
Failover::substitute_for(const std::string& name, const ArchitectureDescription& architecture,
                         const std::function<bool(ProcessNumber)>& is_up) const {
  auto* x = architecture.component(name);
  if (!x)
    return std::nullopt;
  if (x->kind == ComponentKind::working_memory && !WorkingMemoryClass{*x}.outlives_its_node())
    return std::nullopt;
  for (auto& host : architecture.failover_of(*x)) {
    auto i = placement_.hosts.find(host);
    auto process = i == placement_.hosts.end() ? ProcessNumber{0} : i->second;
    if (is_up(process))
      return process;
  }
  return std::nullopt;
}

bool Failover::is_substitute(ProcessNumber x, const ArchitectureDescription& architecture) const {
  for (auto& rule : architecture.failover)
    for (auto& host : rule.hosts)
      if (auto i = placement_.hosts.find(host); i != placement_.hosts.end() && i->second == x)
        return true;
  return false;
}

} // namespace castor
