#include "castor/actors/cast/description.hpp"

#include "castor/actors/component/health.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/client.hpp"

#include <algorithm>

namespace castor {

namespace {

template <class Range>
auto find_named(const Range& range, std::string_view name) noexcept -> decltype(&*range.begin()) {
  auto found = std::find_if(range.begin(), range.end(),
                            [name](const auto& element) { return element.name == name; });
  return found == range.end() ? nullptr : &*found;
}

std::string_view without_dashes(std::string_view key) noexcept {
  auto begin = key.find_first_not_of('-');
  return begin == std::string_view::npos ? std::string_view{} : key.substr(begin);
}

bool is_of_operators(const AccessRule& x) noexcept {
  return x.writer == operators;
}

} // namespace

std::string_view OptionSetting::name() const noexcept {
  return without_dashes(key);
}

std::string_view to_string(ComponentKind kind) noexcept {
  switch (kind) {
    case ComponentKind::working_memory:
      return "working memory";
    case ComponentKind::task_manager:
      return "task manager";
    case ComponentKind::managed:
      return "managed";
    case ComponentKind::unmanaged:
      return "unmanaged";
    case ComponentKind::standalone:
      return "stand-alone";
  }
  return "unknown";
}

std::string_view to_string(Language language) noexcept {
  switch (language) {
    case Language::cpp:
      return "C++";
    case Language::java:
      return "Java";
    case Language::python:
      return "Python";
  }
  return "unknown";
}

const OptionSetting* ComponentDescription::option(std::string_view key_or_name) const noexcept {
  auto wanted = without_dashes(key_or_name);
  auto found = std::find_if(options.begin(), options.end(), [wanted](const OptionSetting& setting) {
    return setting.name() == wanted;
  });
  return found == options.end() ? nullptr : &*found;
}

bool ComponentDescription::is_on(std::string_view key_or_name) const noexcept {
  auto found = option(key_or_name);
  return found != nullptr && parse_truth(found->value).value_or(false);
}

const ComponentDescription*
SubarchitectureDescription::component(std::string_view wanted) const noexcept {
  if (working_memory.name == wanted)
    return &working_memory;
  if (task_manager.name == wanted)
    return &task_manager;
  return find_named(components, wanted);
}

const SubarchitectureDescription*
ArchitectureDescription::subarchitecture(std::string_view name) const noexcept {
  return find_named(subarchitectures, name);
}

const ComponentDescription*
ArchitectureDescription::component(std::string_view name) const noexcept {
  for (const auto& subarchitecture : subarchitectures)
    if (auto found = subarchitecture.component(name))
      return found;
  return find_named(standalone, name);
}

bool ArchitectureDescription::may_write(std::string_view writer,
                                        std::string_view owner) const noexcept {
  auto covers = [](const std::string& pattern, std::string_view name) {
    return pattern == "*" || pattern == name;
  };
  if (writer == operators)
    return owner != health_subarchitecture &&
           (std::none_of(access_rules.begin(), access_rules.end(), is_of_operators) ||
            std::any_of(access_rules.begin(), access_rules.end(), [&](const AccessRule& rule) {
              return is_of_operators(rule) && covers(rule.owner, owner);
            }));
  return writer == owner ||
         std::any_of(access_rules.begin(), access_rules.end(), [&](const AccessRule& rule) {
           return covers(rule.writer, writer) && covers(rule.owner, owner);
         });
}

std::optional<std::set<std::string>>
ArchitectureDescription::readers(std::string_view owner) const {
  if (std::none_of(read_rules.begin(), read_rules.end(),
                   [&](const ReadRule& rule) { return rule.owner == owner; }))
    return std::nullopt;
  std::set<std::string> result;
  for (const auto& rule : read_rules)
    if (rule.owner == owner || rule.owner == "*")
      result.insert(rule.reader);
  return result;
}

bool ArchitectureDescription::may_read(std::string_view reader, std::string_view owner) const {
  auto listed = readers(owner);
  return !listed || reader == owner || listed->count("*") > 0 ||
         listed->count(std::string{reader}) > 0;
}

SupervisionPolicy ArchitectureDescription::supervision_of(std::string_view who) const noexcept {
  const SupervisionRule* found = nullptr;
  for (const auto& rule : supervision)
    if (rule.who == who || (rule.who == "*" && !found && who != SupervisionRule::system))
      found = &rule;
  return found ? found->policy : SupervisionPolicy{};
}

std::vector<std::string>
ArchitectureDescription::failover_of(const ComponentDescription& component) const {
  const FailoverRule* found = nullptr;
  for (const auto& rule : failover)
    if (rule.who == component.name || (rule.who == component.subarchitecture && !found))
      found = &rule;
  return found ? found->hosts : std::vector<std::string>{};
}

} // namespace castor
