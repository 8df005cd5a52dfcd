#include "castor/tools/testing/test_system.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/system/system.hpp"
#include "castor/tools/chaos/injector.hpp"
#include "castor/tools/chaos/journal_faults.hpp"
#include "castor/tools/chaos/plan_parser.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"
#include "castor/wm/values/json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

namespace castor {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

/// How often a condition is looked at.
constexpr Milliseconds poll_interval{2};

/// Simulated time from one look at a condition to the next, and the most looks at one.
constexpr Milliseconds simulated_poll_interval{10};
constexpr int most_simulated_polls = 1000;

/// Real time that simulated time may stand before that is taken for a failure.
constexpr std::chrono::seconds longest_standstill{30};

/// Entries that are shown where another one was expected.
constexpr std::size_t most_shown = 10;

/// Everything runs here, where no component can take its process with it.
ArchitectureDescription in_this_process(std::string_view text, const TestSystemOptions& options) {
  cast::ParseOptions parse_options;
  parse_options.variables = options.variables;
  auto result = cast::parse_string(text, options.file, parse_options);
  if (!result.architecture)
    throw std::invalid_argument(render(result.diagnostics));
  for_each_component(*result.architecture, [](ComponentDescription& x) {
    std::erase_if(x.options, [](auto& option) { return option.name() == "isolate"; });
  });
  return *std::move(result.architecture);
}

/// A fault of a plan, with names instead of every `any`.
faults::Fault read_fault(std::string_view text, const faults::FaultTargets& targets,
                         std::uint64_t seed) {
  auto read = faults::parse_plan("at 0s " + std::string{text}, "inject");
  auto problems = std::move(read.diagnostics);
  if (read.ok())
    problems = faults::check_plan(*read.plan, targets);
  if (!problems.empty())
    throw std::invalid_argument(render(problems));
  if (read.plan->statements.size() != 1)
    throw std::invalid_argument(fmt::format("\"{}\" is not one fault", text));
  faults::FaultSchedule schedule{*read.plan, targets, seed, Timestamp{1}};
  auto fault = schedule.timed().front().fault;
  bool blocks =
    std::holds_alternative<faults::Hang>(fault) || std::holds_alternative<faults::Block>(fault);
  if (blocks && !faults::duration_of(fault))
    throw std::invalid_argument(
      fmt::format("\"{}\" has no end, and so had the test: write for how long", text));
  return fault;
}

/// Only statements that are triggered by changes: the time of others would be real time since the
/// start, which tests are not to depend on.
faults::FaultPlan read_plan(std::string_view text, const faults::FaultTargets& targets) {
  auto read = faults::parse_plan(text, "faults");
  auto problems = std::move(read.diagnostics);
  if (read.ok())
    problems = faults::check_plan(*read.plan, targets);
  if (!problems.empty())
    throw std::invalid_argument(render(problems));
  for (const auto& x : read.plan->statements)
    if (!std::holds_alternative<faults::After>(x.trigger))
      throw std::invalid_argument(
        fmt::format("faults:{}: \"{}\" is not triggered by a change: write \"after FILTER: FAULT\", or "
                    "use inject() at a moment of the test",
                    x.where.line(), x.line));
  return *std::move(read.plan);
}

/// What has been noticed of components, by the supervisor's thread while the test looks.
class Notes {
public:
  using News = std::variant<ComponentDown, ComponentUp>;

  void add(News x) {
    std::lock_guard guard{mutex_};
    notes_.push_back({Clock::now() - begin_, std::move(x)});
  }

  /// The last that is a T about the component.
  template <class T>
  std::optional<T> last(const std::string& component) const {
    std::lock_guard guard{mutex_};
    for (auto i = notes_.rbegin(); i != notes_.rend(); ++i)
      if (auto x = std::get_if<T>(&i->news); x && x->component == component)
        return *x;
    return std::nullopt;
  }

  std::vector<std::string> all_down() const {
    std::lock_guard guard{mutex_};
    std::vector<std::string> result;
    for (auto& x : notes_)
      if (auto down = std::get_if<ComponentDown>(&x.news))
        result.push_back(down->component);
    return result;
  }

  /// One line for each.
  std::string text() const {
    std::lock_guard guard{mutex_};
    std::string result;
    for (auto& x : notes_)
      result += fmt::format("\n  {:7.3f} s  {}", std::chrono::duration<double>(x.at).count(),
                            std::visit([](auto& y) { return line(y); }, x.news));
    return result.empty() ? "\n  nobody went down" : result;
  }

private:
  struct Note {
    Clock::duration at;
    News news;
  };

  static std::string line(const ComponentDown& x) {
    return fmt::format("{} went down in life {}, {}: {}", x.component, x.incarnation,
                       x.will_restart ? "to be started again" : "for good", x.reason);
  }

  static std::string line(const ComponentUp& x) {
    return fmt::format("{} was back in life {}, after {:.1f} ms", x.component, x.incarnation,
                       static_cast<double>(x.down_us) / 1000);
  }

  const Clock::time_point begin_ = Clock::now();
  mutable std::mutex mutex_;
  std::vector<Note> notes_;
};

/// Which entries are meant.
class EntryQuestion {
public:
  explicit EntryQuestion(std::string_view text) : text_(text), filter_(read(text)) {}

  const std::string& text() const { return text_; }

  bool is_answered_by(const Entry& x) const { return matches(filter_, as_event(x), x.value); }

  /// Of entries where the wanted one was looked for, those that come nearest.
  bool comes_near(const Entry& x) const {
    auto nearest = filter_;
    nearest.predicate = {};
    nearest.source.clear();
    nearest.id.clear();
    return matches(nearest, as_event(x), x.value);
  }

  bool looks_into(const std::string& subarchitecture) const {
    return filter_.subarchitecture->empty() || *filter_.subarchitecture == subarchitecture;
  }

private:
  static ChangeFilter read(std::string_view text) {
    try {
      auto result = parse_change_filter(text);
      if (result.operation || !result.changing.empty())
        throw std::invalid_argument(fmt::format(
          "\"{}\" asks for a change, not for an entry: write TYPE in SUBARCHITECTURE where ...",
          text));
      return result;
    } catch (const ChangeFilterError& e) {
      throw std::invalid_argument(e.what());
    }
  }

  static ChangeEvent as_event(const Entry& x) {
    ChangeEvent result;
    result.address = x.address;
    result.source = x.writer;
    result.type = x.value.type_ptr();
    return result;
  }

  std::string text_;
  ChangeFilter filter_;
};

std::string line(const Entry& x) {
  return fmt::format("\n  {} of {}, version {}, by {}: {}", x.type_name(), to_string(x.address),
                     x.version, x.writer, to_json(x.value));
}

} // namespace

class TestSystem::Implementation {
public:
  Implementation(std::string_view text, TestSystemOptions options)
    : options_(options), architecture_(in_this_process(text, options)),
      targets_(faults::targets_of(architecture_, {})), plan_(read_plan(options_.faults, targets_)),
      system_(architecture_, system_options()),
      injector_({&system_, {}, faults::journals_of(architecture_)},
                faults::FaultSchedule{plan_, targets_, options_.seed, Timestamp{0}}) {
    system_.start();
  }

  ~Implementation() {
    injector_.stop();
    system_.stop();
  }

  System& system() { return system_; }

  void inject(std::string_view text) {
    auto fault = read_fault(text, targets_, options_.seed + injector_.records().size());
    auto record = injector_.inject(fault);
    if (record.state == faults::FaultState::not_injected)
      throw std::runtime_error(record.fault + ": " + record.outcome);
  }

  void advance(Timestamp by) {
    if (options_.simulated_time) {
      auto now = system_.now();
      let_pass(by);
      if (auto passed = system_.now() - now; passed < by && !system_.ended())
        throw ExpectationFailed(
          fmt::format("simulated time stands {} us before the end of advance({} us): a component "
                      "does not wait",
                      (by - passed).count(), by.count()) +
          history());
      return;
    }
    for (auto& x : architecture_.subarchitectures) {
      injector_.inject(faults::JumpClock{{x.name}, by});
      // What is asked after that is answered after that.
      system_.entries(x.name);
    }
  }

  /// Waits until the condition holds; false if it does not in time, or will not because the system
  /// has ended.
  bool wait(const std::function<bool()>& condition, Patience within) {
    auto time = [&] {
      return options_.simulated_time ? Clock::duration{system_.now()}
                                     : Clock::now().time_since_epoch();
    };
    auto until = time() + patience(within);
    const auto step = std::max(simulated_poll_interval, patience(within) / most_simulated_polls);
    while (!condition()) {
      if (time() > until || system_.ended())
        return condition();
      if (!options_.simulated_time)
        std::this_thread::sleep_for(poll_interval);
      else if (!let_pass(step))
        return condition();
    }
    return true;
  }

  ComponentDown expect_down(const std::string& component, bool for_good, Patience within) {
    check_name(component);
    std::optional<ComponentDown> found;
    auto is_down = [&] {
      found = notes_.last<ComponentDown>(component);
      return found && !(for_good && found->will_restart);
    };
    if (!wait(is_down, within))
      fail(component + " to go down" + (for_good ? " for good" : ""), within,
           found ? "it was to be started again" : "it did not go down");
    return *found;
  }

  ComponentUp expect_back(const std::string& component, std::uint64_t incarnation,
                          Patience within) {
    check_name(component);
    std::optional<ComponentUp> up;
    auto is_back = [&] {
      up = notes_.last<ComponentUp>(component);
      return up && up->incarnation >= incarnation;
    };
    auto is_settled = [&] {
      auto down = notes_.last<ComponentDown>(component);
      return is_back() || (down && !down->will_restart);
    };
    if (wait(is_settled, within) && is_back() && up->incarnation == incarnation)
      return *up;
    auto down = notes_.last<ComponentDown>(component);
    fail(fmt::format("{} to be back in life {}", component, incarnation), within,
         !down                 ? "it did not go down"
         : !down->will_restart ? "it was given up"
         : up                  ? fmt::format("it was last back in life {}", up->incarnation)
                               : "it was not back");
  }

  void expect_nobody_else_down(const std::vector<std::string>& known) {
    std::string others;
    std::string names;
    for (auto& x : known) {
      check_name(x);
      names += (names.empty() ? "" : ", ") + x;
    }
    auto down = notes_.all_down();
    std::sort(down.begin(), down.end());
    down.erase(std::unique(down.begin(), down.end()), down.end());
    for (auto& x : down)
      if (std::find(known.begin(), known.end(), x) == known.end())
        others += (others.empty() ? "" : ", ") + x;
    if (!others.empty())
      throw ExpectationFailed("expected nobody" + (names.empty() ? "" : " but " + names) +
                              " to go down, but so did " + others + history());
  }

  void expect_end(int status, std::string_view reason, Patience within) {
    auto wanted = fmt::format("the system to end with status {}", status) +
                  (reason.empty() ? "" : fmt::format(" and \"{}\"", reason));
    if (!wait([this] { return system_.ended().has_value(); }, within))
      fail(wanted, within, "it goes on");
    auto [got, why] = *system_.ended();
    if (got != status || why.find(reason) == why.npos)
      throw ExpectationFailed(
        fmt::format("expected {}, but it ended with status {}: {}", wanted, got, why) + history());
  }

  EntryPtr expect_entry(std::string_view wanted, Patience within) {
    EntryQuestion question{wanted};
    EntryPtr result;
    if (!wait([&] { return (result = find(question)) != nullptr; }, within))
      fail("an entry " + question.text(), within, "there is none" + nearest(question));
    return result;
  }

  void expect_no_entry(std::string_view unwanted, Patience within) {
    EntryQuestion question{unwanted};
    EntryPtr found;
    if (!wait([&] { return (found = find(question)) == nullptr; }, within))
      fail("no entry " + question.text(), within, "there is one" + line(*found));
  }

  [[noreturn]] void fail(const std::string& expected, Patience within, const std::string& instead) {
    auto ended = system_.ended();
    throw ExpectationFailed(
      fmt::format("expected {} within {} ms, but {}", expected, patience(within).count(), instead) +
      (ended ? fmt::format("\nthe system has ended with status {}: {}", ended->first, ended->second)
             : "") +
      history());
  }

private:
  SystemOptions system_options() {
    SystemOptions result;
    result.open_access = options_.open_access;
    result.on_down = [this](const ComponentDown& x) { notes_.add(x); };
    result.on_up = [this](const ComponentUp& x) { notes_.add(x); };
    result.watched = faults::watched_by(plan_);
    result.on_watched = [this](std::size_t filter, const ChangeEvent&) {
      injector_.on_change(filter);
    };
    if (options_.simulated_time)
      result.clock.pace = Pace{};
    return result;
  }

  /// False if simulated time stood, or the system has ended.
  bool let_pass(Timestamp by) {
    auto until = system_.now() + by;
    RunLimits limits;
    limits.at_most = by;
    limits.at_most_real = longest_standstill;
    return system_.wait(limits) == EndReason::time_over && system_.now() >= until;
  }

  Milliseconds patience(Patience x) const { return x.value_or(options_.patience); }

  void check_name(const std::string& component) const {
    auto is_it = [&](auto& x) { return x.name == component; };
    if (std::none_of(targets_.components.begin(), targets_.components.end(), is_it))
      throw std::invalid_argument("there is no component " + component);
  }

  std::vector<EntryPtr> entries_for(const EntryQuestion& question) {
    std::vector<EntryPtr> result;
    for (auto& name : system_.subarchitectures())
      if (question.looks_into(name))
        for (auto& x : system_.entries(name))
          result.push_back(x);
    return result;
  }

  EntryPtr find(const EntryQuestion& question) {
    for (auto& x : entries_for(question))
      if (question.is_answered_by(*x))
        return x;
    return nullptr;
  }

  std::string nearest(const EntryQuestion& question) {
    std::string result;
    std::size_t count = 0;
    for (auto& x : entries_for(question))
      if (question.comes_near(*x) && ++count <= most_shown)
        result += line(*x);
    if (count > most_shown)
      result += fmt::format("\n  and {} more", count - most_shown);
    return result.empty() ? ", nor any other of that kind" : "; there are" + result;
  }

  std::string history() const { return "\nuntil then:" + notes_.text(); }

  const TestSystemOptions options_;
  Notes notes_;
  const ArchitectureDescription architecture_;
  const faults::FaultTargets targets_;
  const faults::FaultPlan plan_;
  System system_;
  faults::Injector injector_;
};

TestSystem::TestSystem(std::string_view cast, TestSystemOptions options)
  : implementation_(std::make_unique<Implementation>(cast, options)) {}

TestSystem::~TestSystem() = default;

void TestSystem::inject(std::string_view fault) {
  implementation_->inject(fault);
}

void TestSystem::advance(Timestamp by) {
  implementation_->advance(by);
}

void TestSystem::wait_until(std::string_view what, const std::function<bool()>& condition,
                            Patience within) {
  if (!implementation_->wait(condition, within))
    implementation_->fail(std::string{what}, within, "that did not happen");
}

ComponentDown TestSystem::expect_down(const std::string& component, Patience within) {
  return implementation_->expect_down(component, false, within);
}

ComponentUp TestSystem::expect_back(const std::string& component, std::uint64_t incarnation,
                                    Patience within) {
  return implementation_->expect_back(component, incarnation, within);
}

ComponentDown TestSystem::expect_given_up(const std::string& component, Patience within) {
  return implementation_->expect_down(component, true, within);
}

void TestSystem::expect_nobody_else_down(const std::vector<std::string>& known) {
  implementation_->expect_nobody_else_down(known);
}

void TestSystem::expect_end(int status, std::string_view reason, Patience within) {
  implementation_->expect_end(status, reason, within);
}

EntryPtr TestSystem::expect_entry(std::string_view wanted, Patience within) {
  return implementation_->expect_entry(wanted, within);
}

void TestSystem::expect_no_entry(std::string_view unwanted, Patience within) {
  implementation_->expect_no_entry(unwanted, within);
}

System& TestSystem::system() {
  return implementation_->system();
}

} // namespace castor
