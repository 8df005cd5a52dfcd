#include "castor/tests/tools/chaos/random_faults.hpp"

#include "castor/wm/filters/change_filter_parser.hpp"

#include <ostream>
#include <utility>

namespace castor::faults::test {

namespace {

using rc::gen::build;

rc::Gen<std::string> name() {
  auto letters =
    rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '\x7f')));
  return rc::gen::oneOf(letters, rc::gen::element<std::string>("node1", "segmentor", "any", "or",
                                                               "for", "#x", ",", "a,b", "\"", "\\",
                                                               "x: y", "journal",
                                                               "Gr\xc3\xb6\xc3\x9f"
                                                               "e"));
}

rc::Gen<std::string> name_or_any() {
  return rc::gen::oneOf(rc::gen::just(std::string{}), name());
}

rc::Gen<Timestamp> time() {
  return rc::gen::map(rc::gen::inRange<std::int64_t>(1, 10'000'000),
                      [](auto x) { return Timestamp{x * (x % 3 == 0 ? 1000 : 1)}; });
}

rc::Gen<Lasting> lasting() {
  return rc::gen::oneOf(rc::gen::just(Lasting{}),
                        rc::gen::map(time(), [](Timestamp x) { return Lasting{x}; }));
}

rc::Gen<ComponentTarget> component() {
  return rc::gen::oneOf(rc::gen::map(name(),
                                     [](std::string x) {
                                       return ComponentTarget{std::move(x), {}};
                                     }),
                        rc::gen::map(name_or_any(), [](std::string x) {
                          return ComponentTarget{{}, std::move(x)};
                        }));
}

rc::Gen<ProcessTarget> process() {
  return rc::gen::map(name_or_any(), [](std::string x) { return ProcessTarget{std::move(x)}; });
}

rc::Gen<MemoryTarget> memory() {
  return rc::gen::map(name_or_any(), [](std::string x) { return MemoryTarget{std::move(x)}; });
}

rc::Gen<LinkTarget> link() {
  return rc::gen::oneOf(rc::gen::just(LinkTarget{}),
                        rc::gen::apply(
                          [](std::string a, std::string b) {
                            return LinkTarget{std::move(a), std::move(b)};
                          },
                          name(), name()));
}

rc::Gen<Percent> percent() {
  return rc::gen::map(rc::gen::inRange<std::uint32_t>(1, everything.thousandths + 1),
                      [](auto x) { return Percent{x}; });
}

rc::Gen<std::vector<std::string>> names() {
  return rc::gen::resize(3, rc::gen::container<std::vector<std::string>>(name()));
}

/// Made of its parts, each drawn by one of the generators.
template <class T, class... Parts>
rc::Gen<Fault> of(rc::Gen<Parts>... parts) {
  return rc::gen::apply([](Parts... x) { return Fault{T{std::move(x)...}}; }, std::move(parts)...);
}

rc::Gen<Rate> rate() {
  return rc::gen::map(rc::gen::inRange<std::uint32_t>(1, highest_rate.per_thousand_seconds + 1),
                      [](auto x) { return Rate{x}; });
}

rc::Gen<Trigger> trigger() {
  auto filter = rc::gen::map(
    rc::gen::element<std::string>("", "added A", "in vision", "overwritten B from x changing a,b",
                                  "deleted at 0:3", "where x == \"a: b\\\" \" || y < 2"),
    [](const std::string& text) { return parse_change_filter(text); });
  return rc::gen::oneOf(
    rc::gen::map(time(), [](Timestamp x) { return Trigger{At{x}}; }),
    rc::gen::map(time(), [](Timestamp x) { return Trigger{Every{x + Timestamp{1000}}}; }),
    rc::gen::map(rate(), [](Rate x) { return Trigger{AtRandom{x}}; }),
    rc::gen::apply(
      [](ChangeFilter x, std::uint32_t count, bool repeated) {
        return Trigger{After{std::move(x), count, repeated}};
      },
      filter, rc::gen::inRange<std::uint32_t>(1, 100), rc::gen::arbitrary<bool>()));
}

} // namespace

rc::Gen<Fault> any_fault() {
  auto number = rc::gen::inRange<std::uint32_t>(1, 1000);
  auto signed_time = rc::gen::apply([](Timestamp x, bool back) { return back ? -x : x; }, time(),
                                    rc::gen::arbitrary<bool>());
  return rc::gen::oneOf(
    of<Crash>(component()), of<Throw>(component(), number), of<Hang>(component(), lasting()),

    of<Block>(component(), rc::gen::element(Block::Phase::configure, Block::Phase::start),
              lasting()),
    of<Slow>(component(), time(), lasting()), of<Kill>(process()), of<Stop>(process(), lasting()),
    of<Continue>(process()), of<UseUpDescriptors>(process(), lasting()),
    of<Flood>(process(), rate(), lasting()),
    of<Partition>(rc::gen::nonEmpty(names()), names(), lasting()),
    of<Delay>(time(), link(), lasting()), of<Drop>(percent(), link(), lasting()),
    of<Duplicate>(percent(), link(), lasting()), of<Reorder>(percent(), link(), lasting()),
    of<FailJournal>(memory(), lasting()), of<SlowJournal>(memory(), time(), lasting()),
    of<RemoveJournal>(memory()), of<ClaimJournal>(memory()), of<JumpClock>(memory(), signed_time));
}

rc::Gen<FaultPlan> any_plan() {
  auto faults =
    rc::gen::nonEmpty(rc::gen::resize(3, rc::gen::container<std::vector<Fault>>(any_fault())));
  auto statement = build<Statement>(rc::gen::set(&Statement::trigger, trigger()),
                                    rc::gen::set(&Statement::faults, faults));
  auto seed = rc::gen::apply(
    [](bool given, std::uint64_t x) { return given ? std::optional{x} : std::nullopt; },
    rc::gen::arbitrary<bool>(), rc::gen::arbitrary<std::uint64_t>());
  return build<FaultPlan>(
    rc::gen::set(&FaultPlan::seed, seed),
    rc::gen::set(&FaultPlan::statements,
                 rc::gen::resize(10, rc::gen::container<std::vector<Statement>>(statement))));
}

} // namespace castor::faults::test

namespace castor::faults {

void showValue(const FaultPlan& x, std::ostream& out) {
  out << to_string(x);
}

} // namespace castor::faults
