#include "castor/tools/chaos/fault.hpp"

#include "castor/tools/chaos/fault_words.hpp"

#include <algorithm>

namespace castor::faults {

namespace {

std::string text_of(const ComponentTarget& x) {
  if (!x.is_any())
    return name_in_plan(x.name);
  return x.subarchitecture.empty() ? "any component"
                                   : "any component of " + name_in_plan(x.subarchitecture);
}

std::string text_of(const ProcessTarget& x) {
  return x.is_any() ? "any node" : name_in_plan(x.name);
}

std::string text_of(const MemoryTarget& x) {
  return x.is_any() ? "any" : name_in_plan(x.subarchitecture);
}

std::string text_of(const LinkTarget& x) {
  return x.is_any() ? "on any link"
                    : "between " + name_in_plan(x.first) + " and " + name_in_plan(x.second);
}

std::string text_of(const std::vector<std::string>& names) {
  std::string result;
  for (auto& x : names)
    result += (result.empty() ? "" : ", ") + name_in_plan(x);
  return result;
}

std::string text_of(const Lasting& x) {
  return x ? " for " + to_text(*x) : std::string{};
}

struct Printer {
  std::string operator()(const Crash& x) const { return "crash " + text_of(x.component); }
  std::string operator()(const Throw& x) const {
    auto callback = x.callback == 1 ? "" : "callback " + std::to_string(x.callback) + " of ";
    return "throw in " + callback + text_of(x.component);
  }
  std::string operator()(const Hang& x) const {
    return "hang " + text_of(x.component) + text_of(x.duration);
  }
  std::string operator()(const Block& x) const {
    return "block " + std::string{x.phase == Block::Phase::start ? "start" : "configure"} + " of " +
           text_of(x.component) + text_of(x.duration);
  }
  std::string operator()(const Slow& x) const {
    return "slow " + text_of(x.component) + " by " + to_text(x.by) + text_of(x.duration);
  }
  std::string operator()(const Kill& x) const { return "kill " + text_of(x.process); }
  std::string operator()(const Stop& x) const {
    return "stop " + text_of(x.process) + text_of(x.duration);
  }
  std::string operator()(const Continue& x) const { return "continue " + text_of(x.process); }
  std::string operator()(const UseUpDescriptors& x) const {
    return "use up descriptors of " + text_of(x.process) + text_of(x.duration);
  }
  std::string operator()(const Flood& x) const {
    return "flood " + text_of(x.process) +
           (x.rate == flood_rate ? "" : " with " + to_text(x.rate)) + text_of(x.duration);
  }
  std::string operator()(const Partition& x) const {
    return "partition " + text_of(x.group) + (x.from.empty() ? "" : " from " + text_of(x.from)) +
           text_of(x.duration);
  }
  std::string operator()(const Delay& x) const { return disturbance("delay", to_text(x.by), x); }
  std::string operator()(const Drop& x) const { return disturbance("drop", to_text(x.part), x); }
  std::string operator()(const Duplicate& x) const {
    return disturbance("duplicate", to_text(x.part), x);
  }
  std::string operator()(const Reorder& x) const {
    return disturbance("reorder", to_text(x.part), x);
  }
  std::string operator()(const FailJournal& x) const {
    return "fail journal of " + text_of(x.memory) + text_of(x.duration);
  }
  std::string operator()(const SlowJournal& x) const {
    return "slow journal of " + text_of(x.memory) + " by " + to_text(x.by) + text_of(x.duration);
  }
  std::string operator()(const RemoveJournal& x) const {
    return "remove journal of " + text_of(x.memory);
  }
  std::string operator()(const ClaimJournal& x) const {
    return "claim journal of " + text_of(x.memory);
  }
  std::string operator()(const JumpClock& x) const {
    return "jump clock of " + text_of(x.memory) + " by " + to_text(x.by);
  }

private:
  template <class T>
  static std::string disturbance(std::string_view verb, const std::string& amount, const T& x) {
    return std::string{verb} + " " + amount + " " + text_of(x.link) + text_of(x.duration);
  }
};

} // namespace

std::string to_string(const Fault& x) {
  return std::visit(Printer{}, x);
}

std::string_view kind_of(const Fault& fault) noexcept {
  return std::visit([](const auto& x) { return x.kind; }, fault);
}

std::string target_of(const Fault& fault) {
  return std::visit(
    [](const auto& x) -> std::string {
      if constexpr (requires { x.component; })
        return x.component.is_any() ? text_of(x.component) : x.component.name;
      else if constexpr (requires { x.process; })
        return x.process.is_any() ? text_of(x.process) : x.process.name;
      else if constexpr (requires { x.memory; })
        return x.memory.is_any() ? "any subarchitecture" : x.memory.subarchitecture;
      else if constexpr (requires { x.link; })
        return x.link.is_any() ? "any link"
                               : std::min(x.link.first, x.link.second) + " and " +
                                   std::max(x.link.first, x.link.second);
      else
        return text_of(x.group);
    },
    fault);
}

namespace {

struct MissedOccasion {
  static constexpr const char* nothing_passed = "nothing passed its link meanwhile";
  static constexpr const char* nothing_written = "nothing was written to its journal";
  static constexpr const char* no_callback = "its component had no such callback";

  const char* operator()(const Crash&) const { return "its component has not ended"; }
  const char* operator()(const Throw&) const { return no_callback; }
  const char* operator()(const Hang&) const { return no_callback; }
  const char* operator()(const Slow&) const { return no_callback; }
  const char* operator()(const Block&) const { return "its component was not started again"; }
  const char* operator()(const Partition&) const { return nothing_passed; }
  const char* operator()(const Delay&) const { return nothing_passed; }
  const char* operator()(const Drop&) const { return "nothing was lost on its link"; }
  const char* operator()(const FailJournal&) const { return nothing_written; }
  const char* operator()(const SlowJournal&) const { return nothing_written; }

  template <class T>
  const char* operator()(const T&) const {
    return nullptr;
  }
};

} // namespace

const char* missed_occasion(const Fault& x) noexcept {
  return std::visit(MissedOccasion{}, x);
}

Lasting duration_of(const Fault& fault) {
  return std::visit(
    [](const auto& x) -> Lasting {
      if constexpr (requires { x.duration; })
        return x.duration;
      else
        return std::nullopt;
    },
    fault);
}

std::string name_in_plan(const std::string& name) {
  if (!name.empty() && std::ranges::all_of(name, continues_name) && !is_reserved(name))
    return name;
  return quoted_in_plan(name);
}

} // namespace castor::faults
