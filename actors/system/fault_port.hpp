#pragma once

#include "castor/actors/link/link_fault.hpp"
#include "castor/actors/node/part_protocol.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <string>

namespace castor {

/// Interface by which tests and fault plans inject faults into a running system: `System::faults`.
class FaultPort {
public:
  virtual ~FaultPort() = default;

  /// Injects a fault into a component or a working memory; false if there is none of that name in
  /// reach. A working memory crashes, whatever the fault is. In this process, later actions take
  /// effect after the fault.
  virtual bool inject(const std::string& component, const ComponentFault& x) = 0;

  /// Injects a fault into the link between two processes, by their numbers.
  virtual void inject(ProcessNumber a, ProcessNumber b, const LinkFault& x) = 0;

  /// Injects a fault into the journal of a working memory, until that has ended; false if there is
  /// no such working memory in reach.
  virtual bool inject(const std::string& subarchitecture, const JournalFault& x) = 0;

  /// Lets the clock of a working memory jump; false if there is none in reach.
  virtual bool jump_clock(const std::string& subarchitecture, Timestamp by) = 0;
};

} // namespace castor
