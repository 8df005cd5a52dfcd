#include "castor/tests/tools/chaos/support.hpp"

#include "castor/actors/cast/parser.hpp"

#include <utility>

namespace castor::faults::test {

namespace {

FaultTargets targets_of_text(std::string_view text, std::vector<std::string> nodes) {
  auto result = cast::parse_string(text, "test.cast");
  EXPECT_EQ(render(result.diagnostics), "");
  return targets_of(result.architecture.value(), std::move(nodes));
}

} // namespace

PlanResult parse(std::string_view text) {
  cast::ParseOptions options;
  options.load = [](const std::string& path, std::size_t) -> FileContent {
    if (path == "more.plan")
      return {"at 9s crash tracker\n", {}};
    return {std::nullopt, "no such file"};
  };
  return parse_plan(text, "test.plan", options);
}

FaultPlan plan_of(std::string_view text) {
  auto result = parse(text);
  EXPECT_EQ(render(result.diagnostics), "");
  return result.plan.value_or(FaultPlan{});
}

std::string flaws_of(std::string_view text) {
  return render(parse(text).diagnostics);
}

const FaultTargets& table_top() {
  static const auto result = targets_of_text("HOST localhost\n"
                                             "SUBARCHITECTURE vision\n"
                                             "CPP WM SubarchitectureWorkingMemory --journal full\n"
                                             "CPP TM AlwaysPositiveTaskManager\n"
                                             "CPP MG segmentor Segmentor --isolate off\n"
                                             "CPP MG tracker Tracker --isolate\n"
                                             "SUBARCHITECTURE binding\n"
                                             "CPP WM SubarchitectureWorkingMemory --journal off\n"
                                             "CPP TM AlwaysPositiveTaskManager\n"
                                             "CPP UM binder Binder\n"
                                             "COMPONENT CPP camera Camera\n",
                                             {"node1", "node2"});
  return result;
}

const FaultTargets& small_system() {
  static const auto result = targets_of_text("HOST localhost\n"
                                             "SUBARCHITECTURE only\n"
                                             "CPP WM SubarchitectureWorkingMemory\n"
                                             "CPP TM AlwaysPositiveTaskManager\n"
                                             "CPP MG worker Worker\n",
                                             {});
  return result;
}

} // namespace castor::faults::test
