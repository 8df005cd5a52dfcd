#include "castor/actors/node/inspection.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/node/inspection_json.hpp"
#include "castor/actors/node/replay.hpp"
#include "castor/actors/supervision/health.hpp"
#include "castor/wm/change_filter_parser.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// How long processes may take to answer.
constexpr auto patience = 2s;

/// How many events of a working memory may be on their way to whoever looks on; more are merged.
constexpr std::uint32_t event_limit = 1024;

/// Byte fields are shown up to this length, unless everything is wanted.
constexpr std::size_t shown_bytes = 64;

/// How many of a byte field the request wants to see.
std::size_t bytes_shown(const Json& request) {
  return request.value("full", false) ? std::numeric_limits<std::size_t>::max() : shown_bytes;
}

/// A system that was just started, or a request that makes no sense.
class InspectionError : public std::runtime_error {
public:
  using runtime_error::runtime_error;
};

class Inspection : public std::enable_shared_from_this<Inspection> {
public:
  Inspection(caf::event_based_actor* self, InspectionParts parts)
    : self_(self), parts_(std::move(parts)) {}

  caf::behavior begin() {
    auto inspection = shared_from_this();
    return {
      [inspection](const InspectionRequest& x) { inspection->answer(x.text); },
      [inspection](const SystemRosterPtr& x) {
        inspection->parts_.roster = x;
        if (inspection->filter_)
          inspection->subscribe();
      },
      [inspection](const ChangeNotice& x) { inspection->hear({x}); },
      [inspection](const ChangeNotices& x) { inspection->hear(x.notices); },
      [inspection](InspectionTaken) { inspection->taken(); },
      [](const Outcome<Acknowledged>&) {},
    };
  }

private:
  void answer(const std::string& text) {
    try {
      if (!parts_.roster)
        throw InspectionError("the system is not ready yet");
      auto request = Json::parse(text);
      auto what = request.value("do", "");
      if (std::exchange(is_asked_, true))
        return control(what);
      if (what == "ps")
        report();
      else if (what == "wm")
        look_into(request);
      else if (what == "events")
        watch(request);
      else if (what == "graph")
        tell_accesses();
      else if (what == "replay")
        replay_into_system(request);
      else if (what == "add")
        add(request);
      else if (what == "remove")
        order(request.at("name").get<std::string>());
      else
        throw InspectionError("there is no request " + what +
                              "; there are: ps, wm, events, graph, replay, add, remove");
    } catch (const Json::exception& e) {
      refuse(std::string{"the request cannot be read: "} + e.what());
    } catch (const std::runtime_error& e) {
      refuse(e.what());
    }
  }

  // -- what is said

  void say(std::string text, bool last = false) {
    self_->send(parts_.endpoint, InspectionReply{parts_.connection, std::move(text), last});
  }

  void end() { say({}, true); }
  void refuse(const std::string& why) { say(Json{{"error", why}}.dump() + '\n', true); }

  /// Calls `f` once after everything that it was handed to was called or dropped.
  template <class F>
  std::shared_ptr<void> when_all_have_answered(F&& f) {
    return {nullptr, [inspection = shared_from_this(), f = std::forward<F>(f)](void*) { f(); }};
  }

  // -- ps

  void report() {
    auto result = std::make_shared<SystemReport>();
    result->parts.resize(parts_.roster->processes.size());
    auto done = when_all_have_answered([this, result] {
      std::sort(result->working_memories.begin(), result->working_memories.end(),
                [](auto& a, auto& b) { return a.subarchitecture < b.subarchitecture; });
      say(to_json(*result, *parts_.roster).dump() + '\n', true);
    });
    for (std::size_t i = 0; i < result->parts.size(); ++i)
      if (auto& agent = parts_.roster->agents[i])
        self_->request(agent, patience, PartStatusQuery{})
          .then([=](const PartStatus& x) { result->parts[i] = x; }, [done](const caf::error&) {});
    for (auto& [name, wm] : parts_.roster->working_memories)
      self_->request(wm, patience, StatusQuery{})
        .then([=](const WorkingMemoryStatus& x) { result->working_memories.push_back(x); },
              [done](const caf::error&) {});
  }

  void tell_accesses() {
    auto result = std::make_shared<std::vector<Access>>();
    auto done = when_all_have_answered([this, result] {
      std::string text;
      for (auto& x : *result)
        text += to_json(x).dump() + '\n';
      say(text, true);
    });
    for (auto& [name, wm] : parts_.roster->working_memories)
      self_->request(wm, patience, AccessQuery{})
        .then(
          [=](const AccessReport& x) {
            result->insert(result->end(), x.accesses.begin(), x.accesses.end());
          },
          [done](const caf::error&) {});
  }

  // -- wm

  void look_into(const Json& request) {
    auto name = request.at("subarchitecture").get<std::string>();
    auto what = request.value("what", "");
    bool with_values = request.value("values", false);
    auto max_bytes = bytes_shown(request);
    self_->request(working_memory(name), patience, QueryRequest{{name, {}, 0, false}, {}})
      .then(
        [=, this](const Outcome<std::vector<EntryPtr>>& found) {
          if (!found)
            return refuse(found.failure().message);
          auto entries = select(*found, what);
          if (entries.empty() && !what.empty())
            return refuse(nothing_found(name, what, *found));
          std::string text;
          for (auto& x : entries)
            text += entry_as_json(*x, with_values, max_bytes) + '\n';
          say(std::move(text), true);
        },
        [=, this](const caf::error&) {
          refuse("the working memory of " + name + " does not answer");
        });
  }

  const WorkingMemoryActor& working_memory(const std::string& name) const {
    auto i = parts_.roster->working_memories.find(name);
    if (i != parts_.roster->working_memories.end())
      return i->second;
    std::string known;
    for (auto& [other, wm] : parts_.roster->working_memories)
      known += (known.empty() ? "" : ", ") + other;
    throw InspectionError("there is no subarchitecture " + name + "; there are: " + known);
  }

  /// The entry of that id, or those of that type; all if neither is asked for.
  static std::vector<EntryPtr> select(std::vector<EntryPtr> entries, const std::string& what) {
    if (what.empty())
      return entries;
    auto is_it = [&](const EntryPtr& x) { return x->address.id == what; };
    if (auto i = std::find_if(entries.begin(), entries.end(), is_it); i != entries.end())
      return {*i};
    std::erase_if(entries, [&](const EntryPtr& x) { return !x->value.type().is_a(what); });
    return entries;
  }

  static std::string nothing_found(const std::string& name, const std::string& what,
                                   const std::vector<EntryPtr>& entries) {
    std::set<std::string> types;
    for (auto& x : entries)
      types.insert(x->type_name());
    std::string known;
    for (auto& x : types)
      known += (known.empty() ? "" : ", ") + x;
    return "in " + name + " there is neither an entry nor a type of the name " + what +
           (known.empty() ? "; it is empty" : "; there are entries of the types " + known);
  }

  // -- events

  void watch(const Json& request) {
    filter_ = parse_change_filter(request.value("filter", ""));
    if (!filter_->subarchitecture->empty())
      working_memory(*filter_->subarchitecture);
    what_ = request.value("what", "");
    with_values_ = request.value("values", false);
    max_bytes_ = bytes_shown(request);
    subscribe();
  }

  void subscribe() {
    for (auto& [name, wm] : parts_.roster->working_memories) {
      if ((!filter_->subarchitecture->empty() && *filter_->subarchitecture != name) ||
          watched_[name].actor == wm)
        continue;
      watched_[name] = {wm, Receipts{event_limit}, 0};
      for (auto& filter : filters_for(name)) {
        Subscribe x{++last_filter_, filter};
        x.queue_limit = event_limit;
        self_->send(wm, std::move(x));
      }
    }
  }

  std::vector<ChangeFilter> filters_for(const std::string& name) const {
    auto filter = filter_->in(name);
    if (what_.empty())
      return {filter};
    auto by_id = filter;
    by_id.id = what_;
    auto by_type = filter;
    by_type.type = what_;
    return {by_id, by_type};
  }

  void hear(const std::vector<ChangeNotice>& notices) {
    for (auto& x : notices)
      hear(x.event);
  }

  void hear(const ChangeEventPtr& event) {
    auto& address = event->address;
    auto& watched = watched_[address.subarchitecture];
    if (!with_values_ || event->operation == Operation::remove) {
      ++watched.told;
      say(change_as_json(*event, {}, max_bytes_) + '\n');
      return;
    }
    auto tell = [this, event](const Value& value) {
      ++watched_[event->address.subarchitecture].told;
      say(change_as_json(*event, value, max_bytes_) + '\n');
    };
    self_->request(watched.actor, patience, ReadRequest{address, {}})
      .then([tell](const Outcome<EntryPtr>& x) { tell(x ? (*x)->value : Value{}); },
            [tell](const caf::error&) { tell({}); });
  }

  void taken() {
    for (auto& [name, x] : watched_) {
      std::uint64_t count = 0;
      for (; x.told > 0; --x.told)
        count += x.receipts.take();
      if (count > 0)
        self_->send(x.actor, EventsTaken{EventStream::component, count});
    }
  }

  // -- replay

  void replay_into_system(const Json& request) {
    auto parts = std::make_shared<ReplayParts>();
    auto files = [&](const char* name) {
      auto names = request.value(name, std::vector<std::string>{});
      return std::vector<std::filesystem::path>(names.begin(), names.end());
    };
    auto time = [&](const char* name) { return UnixTime{request.value(name, std::int64_t{0})}; };
    parts->selection.journals = files("files");
    parts->selection.pushes = files("pushes");
    if (request.contains("sources"))
      parts->selection.sources = request["sources"].get<std::set<std::string>>();
    parts->selection.from = time("from");
    parts->to = time("to");
    parts->end = time("end");
    parts->working_memories = parts_.roster->working_memories;
    parts->providers = parts_.roster->providers;
    parts->speed = request.value("speed", 1.0);
    parts->rounds = request.value("rounds", std::uint64_t{1});
    auto reply = [to = parts_.endpoint, connection = parts_.connection](Json x, bool last) {
      caf::anon_send(to, InspectionReply{connection, x.dump() + '\n', last});
    };
    if (request.value("progress", false))
      parts->on_progress = [reply](const ReplayProgress& x) { reply(to_json(x), false); };
    parts->done = [reply](const ReplayOutcome& x) { reply(to_json(x), true); };
    // Ends with whoever wants it, and has its own thread to read files.
    replay_ = self_->spawn<caf::linked + caf::detached>(castor::replay, std::move(parts));
  }

  /// Something that was asked for is under way.
  void control(const std::string& what) {
    static const std::map<std::string, ReplayControl> controls{{"pause", ReplayControl::pause},
                                                               {"go on", ReplayControl::go_on},
                                                               {"end", ReplayControl::end}};
    if (auto i = controls.find(what); i != controls.end() && replay_)
      self_->send(replay_, i->second);
  }

  // -- changes of the system

  void add(const Json& request) {
    cast::ParseOptions options;
    for (auto& [name, wm] : parts_.roster->working_memories)
      if (name != health_subarchitecture)
        options.running_subarchitectures.insert(name);
    options.variables = request.value("variables", std::map<std::string, std::string>{});
    options.working_directory = request.value("directory", "");
    auto result = cast::parse_file(request.at("file").get<std::string>(), options);
    if (!result.ok()) {
      say(outcome_as_json({{}, result.diagnostics}), true);
      return;
    }
    if (!result.diagnostics.empty())
      say(Json{{"remarks", cast::render(result.diagnostics)}}.dump() + '\n');
    order(*std::move(result.architecture));
  }

  static std::string outcome_as_json(const OrderOutcome& x) {
    Json result;
    if (!x.findings.empty())
      result["findings"] = cast::render(x.findings);
    else if (!x.problem.empty())
      result["error"] = x.problem;
    else
      result["done"] = true;
    return result.dump() + '\n';
  }

  void order(std::variant<ArchitectureDescription, std::string> what) {
    auto done = [to = parts_.endpoint, connection = parts_.connection](const OrderOutcome& x) {
      caf::anon_send(to, InspectionReply{connection, outcome_as_json(x), true});
    };
    parts_.give_order({std::move(what), std::move(done)});
  }

  struct Watched {
    WorkingMemoryActor actor;
    Receipts receipts{event_limit};
    /// Events that were said and not yet taken.
    std::uint64_t told = 0;
  };

  caf::event_based_actor* self_;
  InspectionParts parts_;
  bool is_asked_ = false;
  caf::actor replay_;
  std::optional<ChangeFilter> filter_;
  /// Only entries of this id, or of this type.
  std::string what_;
  bool with_values_ = false;
  std::size_t max_bytes_ = shown_bytes;
  FilterId last_filter_ = 0;
  std::map<std::string, Watched> watched_;
};

} // namespace

caf::behavior inspection(caf::event_based_actor* self, InspectionParts parts) {
  return std::make_shared<Inspection>(self, std::move(parts))->begin();
}

} // namespace castor
