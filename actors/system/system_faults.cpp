#include "castor/actors/system/system_faults.hpp"

#include <caf/scoped_actor.hpp>
#include <caf/send.hpp>

#include <chrono>

namespace castor {

/// The fault, with somebody to tell when it takes effect if it has a number.
template <class InjectedFault>
InjectedFault SystemFaults::observed(InjectedFault x) const {
  if constexpr (requires { x.ticket; })
    if (x.ticket.number != 0)
      x.ticket.observer = listener_;
  return x;
}

bool SystemFaults::inject(const std::string& component, const ComponentFault& x) {
  auto known = roster_.newest();
  auto i = known->placement.find(component);
  if (i == known->placement.end())
    return false;
  InjectComponentFault order{component, observed(x)};
  if (x.kind == ComponentFault::Kind::blocked_configure ||
      x.kind == ComponentFault::Kind::blocked_start) {
    supervisor_.tell(order);
    return true;
  }
  if (!processes_.is_up(i->second))
    return false;
  auto agent = processes_.agent(i->second);
  if (i->second != 0) {
    caf::anon_send(agent, order);
    return true;
  }
  // Whatever is done next comes after the fault.
  caf::scoped_actor self{system_};
  self->request(agent, std::chrono::seconds{1}, order)
    .receive([](Acknowledged) {}, [](const caf::error&) {});
  return true;
}

void SystemFaults::inject(ProcessNumber a, ProcessNumber b, const LinkFault& x) {
  caf::anon_send(processes_.agent(a), InjectLinkFault{b, observed(x)});
  caf::anon_send(processes_.agent(b), InjectLinkFault{a, observed(x)});
}

bool SystemFaults::inject(const std::string& subarchitecture, const JournalFault& x) {
  return inject_into_working_memory(subarchitecture, x);
}

bool SystemFaults::jump_clock(const std::string& subarchitecture, Timestamp by) {
  return inject_into_working_memory(subarchitecture, JumpClock{by});
}

/// A fault that a working memory brings about itself.
template <class WorkingMemoryFault>
bool SystemFaults::inject_into_working_memory(const std::string& subarchitecture,
                                              const WorkingMemoryFault& x) {
  auto known = roster_.newest();
  auto i = known->working_memories.find(subarchitecture);
  if (i == known->working_memories.end() ||
      !processes_.is_up(process_of(known->placement, working_memory_of(subarchitecture))))
    return false;
  caf::anon_send(i->second, observed(x));
  return true;
}

} // namespace castor
