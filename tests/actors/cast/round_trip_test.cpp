#include "castor/actors/cast/writer.hpp"
#include "castor/base/duration.hpp"
#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace castor::cast {

namespace {

/// A word that means nothing to the language.
rc::Gen<std::string> word() {
  static const std::string letters = "abcdefghijklmnopqrstuvwxyz0123456789._:@/+=,()%";
  return rc::gen::map(
    rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::elementOf(letters))),
    [](std::string text) {
      // Neither a variable nor something that a keyword begins with.
      text.erase(std::remove(text.begin(), text.end(), '%'), text.end());
      return "x" + text;
    });
}

/// A value that survives the joining of words: single blanks inside, anything else but quotes.
rc::Gen<std::string> value() {
  return rc::gen::map(
    rc::gen::container<std::vector<std::string>>(rc::gen::oneOf(
      word(), rc::gen::element<std::string>("-5", "#", "a#b", "--k", "it's", "HOST", "[M]"))),
    [](const std::vector<std::string>& words) {
      std::string text;
      for (const auto& part : words)
        text += (text.empty() ? "" : " ") + part;
      return text;
    });
}

rc::Gen<std::vector<OptionSetting>> options() {
  auto option = rc::gen::build<OptionSetting>(
    rc::gen::set(&OptionSetting::key,
                 rc::gen::map(word(), [](const std::string& name) { return "--" + name; })),
    rc::gen::set(&OptionSetting::value, value()));
  return rc::gen::uniqueBy<std::vector<OptionSetting>>(
    option, [](const OptionSetting& setting) { return setting.key; });
}

rc::Gen<ComponentDescription> component() {
  return rc::gen::build<ComponentDescription>(
    rc::gen::set(&ComponentDescription::kind,
                 rc::gen::element(ComponentKind::managed, ComponentKind::unmanaged)),
    rc::gen::set(&ComponentDescription::name, word()),
    rc::gen::set(&ComponentDescription::class_name, word()),
    rc::gen::set(&ComponentDescription::host, word()),
    rc::gen::set(&ComponentDescription::options, options()));
}

rc::Gen<SubarchitectureDescription> subarchitecture() {
  return rc::gen::build<SubarchitectureDescription>(
    rc::gen::set(&SubarchitectureDescription::name, word()),
    rc::gen::set(&SubarchitectureDescription::host, word()),
    rc::gen::set(&SubarchitectureDescription::working_memory, component()),
    rc::gen::set(&SubarchitectureDescription::task_manager, component()),
    rc::gen::set(&SubarchitectureDescription::components,
                 rc::gen::container<std::vector<ComponentDescription>>(component())));
}

/// Makes all names different, whatever they end with, and fills in what follows from the place of a
/// line.
void complete(ArchitectureDescription& architecture) {
  std::size_t number = 0;
  std::size_t names = 0;
  for (auto& sa : architecture.subarchitectures) {
    sa.name += "_" + std::to_string(names++);
    sa.working_memory.kind = ComponentKind::working_memory;
    sa.working_memory.name = sa.name + "_wm";
    sa.task_manager.kind = ComponentKind::task_manager;
    sa.task_manager.name = sa.name + "_tm";
    for (auto component : {&sa.working_memory, &sa.task_manager}) {
      component->subarchitecture = sa.name;
      component->number = number++;
    }
    for (auto& each : sa.components) {
      each.subarchitecture = sa.name;
      each.name += "_" + std::to_string(names++);
      each.number = number++;
    }
  }
  for (auto& each : architecture.standalone) {
    each.kind = ComponentKind::standalone;
    each.name += "_" + std::to_string(names++);
    each.number = number++;
  }
}

/// Everything but the places in the file, line by line.
std::string facts(const ArchitectureDescription& architecture) {
  std::string text;
  auto add = [&text](const ComponentDescription& component) {
    text += std::to_string(component.number) + "|" + std::string(to_string(component.kind)) + "|" +
            component.subarchitecture + "|" + component.name + "|" + component.class_name + "|" +
            component.host + "|";
    for (const auto& option : component.options)
      text += option.key + "=" + option.value + "|";
    text += "\n";
  };
  for (const auto& sa : architecture.subarchitectures) {
    text += sa.name + "@" + sa.host + "\n";
    add(sa.working_memory);
    add(sa.task_manager);
    std::for_each(sa.components.begin(), sa.components.end(), add);
  }
  std::for_each(architecture.standalone.begin(), architecture.standalone.end(), add);
  for (const auto& rule : architecture.access_rules)
    text += rule.writer + ">" + rule.owner + "\n";
  for (const auto& rule : architecture.read_rules)
    text += rule.reader + "<" + rule.owner + "\n";
  for (const auto& [who, policy, where] : architecture.supervision)
    text += who + "|" + std::string(to_string(policy.strategy)) + "|" +
            std::to_string(policy.restarts) + "|" + to_string(policy.period) + "|" +
            to_string(policy.first_delay) + "|" + to_string(policy.longest_delay) + "\n";
  for (const auto& rule : architecture.failover) {
    text += rule.who;
    for (const auto& host : rule.hosts)
      text += ">" + host;
    text += "\n";
  }
  return text;
}

SupervisionPolicy policy() {
  auto some = [](int most) { return std::chrono::milliseconds{*rc::gen::inRange(0, most)}; };
  SupervisionPolicy result;
  result.strategy = *rc::gen::element(RestartStrategy::one_for_one, RestartStrategy::one_for_all,
                                      RestartStrategy::rest_for_one);
  result.restarts = *rc::gen::arbitrary<std::uint32_t>();
  result.period = std::chrono::milliseconds{1} + some(100'000);
  result.first_delay = some(5000);
  result.longest_delay = result.first_delay + some(5000);
  return result;
}

RC_GTEST_PROP(RoundTrip, OfADescriptionThroughItsTextChangesNothing, ()) {
  // Lists within lists within lists: small ones make large systems already.
  constexpr int list_size = 5;
  ArchitectureDescription architecture;
  architecture.subarchitectures = *rc::gen::resize(
    list_size, rc::gen::container<std::vector<SubarchitectureDescription>>(subarchitecture()));
  architecture.standalone =
    *rc::gen::resize(list_size, rc::gen::container<std::vector<ComponentDescription>>(component()));
  RC_PRE(!architecture.subarchitectures.empty() || !architecture.standalone.empty());
  complete(architecture);
  for (const auto& sa : architecture.subarchitectures)
    architecture.access_rules.push_back({sa.name, "*", {}});
  for (const auto& sa : architecture.subarchitectures)
    architecture.read_rules.push_back({architecture.subarchitectures.front().name, sa.name, {}});
  for (const auto& sa : architecture.subarchitectures) {
    architecture.supervision.push_back({sa.name, policy(), {}});
    architecture.failover.push_back({sa.name, {"h1", "h2"}, {}});
  }
  auto result = test::parse(to_cast(architecture));
  RC_ASSERT(render(result.diagnostics) == "");
  RC_ASSERT(facts(*result.architecture) == facts(architecture));
}

/// Any text at all: what comes back is either a description or an error.
RC_GTEST_PROP(AnyText, IsEitherDescribedOrRefused, ()) {
  auto piece = rc::gen::oneOf(
    rc::gen::element<std::string>(
      "\n", " ", "HOST h", "SUBARCHITECTURE s", "CPP WM W", "CPP TM T", "CPP MG a A",
      "COMPONENT CPP b B", "ACCESS * WRITES s", "ACCESS * READS s",
      "SUPERVISE s one_for_all RESTARTS 1 IN 2s", "FAILOVER s TO h",
      "SETVAR a=", "SETOPT a=", "%(a)", "%(", ")", "<multiline>", "</multiline>", "IFEQ(a, %(a))",
      "IFTRUE(", "ELSE", "ENDIF", "HOSTNAME A", "[A]", "$A", "#", "\"", "-x", "!", "INCLUDE x"),
    rc::gen::arbitrary<std::string>());
  std::string text;
  for (const auto& each : *rc::gen::container<std::vector<std::string>>(piece))
    text += each;
  auto result = test::parse(text, {{{"x", "HOST x\n"}}, {{"A", "value"}}});
  RC_ASSERT(result.ok() == (test::count(result, Severity::error) == 0));
}

} // namespace

} // namespace castor::cast
