#pragma once

#include "castor/actors/component/registry.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/benchmarks/performance/measurement.hpp"
#include "castor/benchmarks/race.hpp"

#include <functional>
#include <memory>
#include <string>

namespace castor::benchmark {

struct Payload {
  std::string text;
};
CASTOR_REFLECT(Payload, text)

inline Payload payload_of(std::size_t bytes) {
  return {std::string(bytes, 'x')};
}

/// The beginning of a subarchitecture in a .cast file.
std::string subarchitecture_text(const std::string& name, const std::string& host = "localhost");

/// Runs the system that a .cast file of this text describes until one of its components ends it.
/// The text may place components at the nodes of the options, by their names.
/// `before_stop` may look at it, or do what there is to do without such a component.
void run_system(const std::string& text, const SystemOptions& options = {},
                const std::function<void(System&)>& before_stop = {});

/// A component that measures, at the same time as its siblings `--index` 0 and up. That with index
/// 0 ends the system when the measurement is over.
class MeasuringComponent : public UnmanagedComponent {
protected:
  /// Where the measuring components of the running system meet.
  struct Meeting {
    Meeting(const Arguments& a, int components) : arguments(a), race(components) {}

    const Arguments& arguments;
    Race race;
  };

public:
  /// Runs a system with so many of these components in subarchitecture `a`.
  static void run_components(const Arguments& arguments, const std::string& type, int components,
                             const std::string& others = "", const SystemOptions& options = {});

protected:
  static const Arguments& arguments() { return meeting_->arguments; }
  int index() const { return static_cast<int>(index_.get()); }
  bool is_first() const { return index() == 0; }

  /// Payloads of the size that the arguments give, as many as a batch has.
  void prepare_payloads() {
    payloads_.assign(batch_of(arguments().count("bytes")), payload_of(arguments().count("bytes")));
  }

  /// Operations per second of all components, in batches of `operations` each; printed as a figure.
  void measure(const std::string& figure, std::size_t operations,
               const std::function<void()>& prepare, const std::function<void()>& work);

  /// The same, each component as fast as it can: `work` of so many operations, over and over.
  void measure_freely(const std::string& figure, std::size_t operations,
                      const std::function<void()>& work);

  std::vector<Payload> payloads_;

private:
  static std::unique_ptr<Meeting> meeting_;

  Option<std::int64_t> index_{this, "index", 0, "which of the components this is"};
};

} // namespace castor::benchmark
