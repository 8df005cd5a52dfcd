#include "castor/benchmarks/performance/castor_system.hpp"

#include "castor/actors/cast/parser.hpp"

#include <fmt/core.h>

#include <stdexcept>

namespace castor::benchmark {

std::string subarchitecture_text(const std::string& name, const std::string& host) {
  return "SUBARCHITECTURE " + name + ' ' + host +
         "\nCPP WM SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n";
}

void run_system(const std::string& text, const SystemOptions& options,
                const std::function<void(System&)>& before_stop) {
  std::string hosts;
  for (auto& [name, endpoint] : options.nodes)
    hosts += fmt::format("HOSTNAME {0} {0}\n", name);
  auto parsed = cast::parse_string(hosts + "ACCESS * WRITES *\n" + text, "benchmark");
  // Warnings, too: what is measured is what was meant.
  if (!parsed.architecture || !parsed.diagnostics.empty())
    throw std::runtime_error(render(parsed.diagnostics));
  System system{*parsed.architecture, options};
  system.start();
  if (before_stop)
    before_stop(system);
  else
    system.wait({});
  system.stop();
}

std::unique_ptr<MeasuringComponent::Meeting> MeasuringComponent::meeting_;

void MeasuringComponent::run_components(const Arguments& arguments, const std::string& type,
                                        int components, const std::string& others,
                                        const SystemOptions& options) {
  meeting_ = std::make_unique<Meeting>(arguments, components);
  auto text = others + subarchitecture_text("a");
  for (int i = 0; i < components; ++i)
    text += fmt::format("CPP UM c{} {} --index {} --deadline 1h --budget 1h\n", i, type, i);
  run_system(text, options);
}

void MeasuringComponent::measure(const std::string& figure, std::size_t operations,
                                 const std::function<void()>& prepare,
                                 const std::function<void()>& work) {
  auto rate =
    meeting_->race.measure_for(arguments().duration(), index(), operations, prepare, work);
  if (is_first())
    print_figure(figure, rate);
}

void MeasuringComponent::measure_freely(const std::string& figure, std::size_t operations,
                                        const std::function<void()>& work) {
  auto rate = meeting_->race.measure_freely(arguments().duration(), index(), operations, work);
  if (is_first())
    print_figure(figure, rate);
}

} // namespace castor::benchmark
