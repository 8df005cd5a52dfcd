#include "castor/actors/system/inspection.hpp"

#include "castor/actors/cast/parser.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/actors/node/check.hpp"
#include "castor/actors/system/inspection_context.hpp"
#include "castor/actors/system/operator_requests.hpp"
#include "castor/actors/system/replay.hpp"
#include "castor/actors/system/request_lines.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"

#include <algorithm>
#include <cctype>
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

/// How many events of a working memory may be on their way to whoever looks on; more are merged.
constexpr std::uint32_t event_limit = 1024;

class Inspection : public std::enable_shared_from_this<Inspection> {
public:
  Inspection(caf::event_based_actor* self, InspectionParts parts)
    : self_(self), context_(std::make_shared<InspectionContext>(self, std::move(parts))),
      parts_(context_->parts) {}

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
      [](const InspectionTimeout& x) { x.then(); },
      [](const Outcome<Acknowledged>&) {},
    };
  }

private:
  void answer(const std::string& text) {
    context_->guarded([&] {
      if (!parts_.roster)
        throw InspectionError("the system is not ready yet");
      auto request = parse_request(text);
      auto what = request.value("do", "");
      if (std::exchange(is_asked_, true))
        return control(what);
      auto handler = handlers().find(what);
      if (handler == handlers().end())
        throw InspectionError("there is no request " + what + "; there are: " + request_names());
      handler->second(*this, request);
    });
  }

  using Handler = std::function<void(Inspection&, const Json&)>;

  static const std::map<std::string, Handler>& handlers() {
    static const std::map<std::string, Handler> result{
      {"ps", [](Inspection& x, const Json&) { x.report(); }},
      {"types", [](Inspection& x, const Json& request) { x.tell_types(request); }},
      {"wm", [](Inspection& x, const Json& request) { x.look_into(request); }},
      {"events", [](Inspection& x, const Json& request) { x.watch(request); }},
      {"graph", [](Inspection& x, const Json&) { x.tell_accesses(); }},
      {"replay", [](Inspection& x, const Json& request) { x.replay_into_system(request); }},
      {"add", [](Inspection& x, const Json& request) { x.add(request); }},
      {"remove", [](Inspection& x, const Json& request) { x.remove(request); }},
      {"write", [](Inspection& x, const Json& request) { add_entry(x.context_, request); }},
      {"overwrite",
       [](Inspection& x, const Json& request) { overwrite_entry(x.context_, request); }},
      {"delete", [](Inspection& x, const Json& request) { delete_entry(x.context_, request); }},
      {"call", [](Inspection& x, const Json& request) { call_component(x.context_, request); }},
    };
    return result;
  }

  static std::string request_names() {
    std::string result;
    for (auto& [name, handler] : handlers())
      result += (result.empty() ? "" : ", ") + name;
    return result;
  }

  // -- what is said

  void say(std::string text, bool last = false) { context_->say(std::move(text), last); }
  void refuse(const std::string& why) { context_->refuse(why); }

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
      say(as_line(to_json(*result, *parts_.roster)), true);
    });
    for (std::size_t i = 0; i < result->parts.size(); ++i)
      if (auto& agent = parts_.roster->agents[i])
        self_->request(agent, inspection_patience, PartStatusQuery{})
          .then([=](const PartStatus& x) { result->parts[i] = x; }, [done](const caf::error&) {});
    for (auto& [name, wm] : parts_.roster->working_memories)
      self_->request(wm, inspection_patience, StatusQuery{})
        .then([=](const WorkingMemoryStatus& x) { result->working_memories.push_back(x); },
              [done](const caf::error&) {});
  }

  void tell_accesses() {
    auto result = std::make_shared<std::vector<Usage>>();
    auto done = when_all_have_answered([this, result] {
      std::string text;
      for (auto& x : *result)
        text += as_line(to_json(x));
      say(text, true);
    });
    for (auto& [name, wm] : parts_.roster->working_memories)
      self_->request(wm, inspection_patience, UsageQuery{})
        .then(
          [=](const UsageReport& x) {
            result->insert(result->end(), x.usages.begin(), x.usages.end());
          },
          [done](const caf::error&) {});
  }

  // -- wm

  void look_into(const Json& request) {
    auto name = request.at("subarchitecture").get<std::string>();
    auto what = request.value("what", "");
    bool with_values = request.value("values", false);
    auto max_bytes = bytes_shown(request);
    self_
      ->request(context_->working_memory(name), inspection_patience,
                QueryRequest{{name, {}, 0, false}, {}})
      .then(
        [=, this](const Outcome<std::vector<EntryPtr>>& found) {
          if (!found)
            return refuse(found.failure().message);
          auto entries = select(*found, what);
          if (entries.empty() && !what.empty())
            return check_what(name, what, *found);
          std::string text;
          for (auto& x : entries)
            text += entry_as_json(*x, with_values, max_bytes) + '\n';
          say(std::move(text), true);
        },
        [=, this](const caf::error&) {
          refuse("the working memory of " + name + " does not answer");
        });
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

  /// Answers that there is nothing if `what` is a type that there may be entries of.
  void check_what(const std::string& name, const std::string& what,
                  const std::vector<EntryPtr>& entries) {
    context_->with_types([=, this](const TypeCatalogue& types) {
      if (!is_known_type(what, types))
        throw InspectionError(nothing_found(name, what, entries, types));
      say({}, true);
    });
  }

  static std::string nothing_found(const std::string& name, const std::string& what,
                                   const std::vector<EntryPtr>& entries,
                                   const TypeCatalogue& types) {
    std::vector<std::string_view> candidates;
    std::set<std::string> here;
    for (auto& [type, descriptor] : types)
      candidates.push_back(type);
    for (auto& x : entries) {
      candidates.push_back(x->address.id);
      here.insert(x->type_name());
    }
    // Of an id and a type that are as near, the one that is written like it.
    if (!what.empty() && std::islower(static_cast<unsigned char>(what.front())))
      std::reverse(candidates.begin(), candidates.end());
    auto guess = did_you_mean(what, candidates);
    return "in " + name + " there is neither an entry nor a type of the name " + what +
           (!guess.empty() ? "; " + guess
            : here.empty() ? "; it is empty"
                           : "; there are entries of the types" +
                               nearest_known({}, here).substr(sizeof("; there are:") - 1));
  }

  void tell_types(const Json& request) {
    auto name = request.value("type", "");
    context_->with_types([=, this](const TypeCatalogue& types) {
      std::string text;
      if (!name.empty())
        find_type(name, types);
      for (auto& [other, type] : types)
        if (name.empty() || type->is_a(name))
          text += as_line(to_json(*type));
      say(std::move(text), true);
    });
  }

  // -- events

  void watch(const Json& request) {
    auto filter = parse_change_filter(request.value("filter", ""));
    what_ = request.value("what", "");
    with_values_ = request.value("values", false);
    max_bytes_ = bytes_shown(request);
    if (request.value("wait", false))
      return subscribe_to(filter);
    context_->with_types([=, this](TypeCatalogue types) {
      auto known = context_->known_names(std::move(types));
      check_names(filter, known);
      if (what_.empty() || is_known_type(what_, known.types))
        return subscribe_to(filter);
      // So it has to be an entry.
      auto& name = *filter.subarchitecture;
      self_
        ->request(context_->working_memory(name), inspection_patience,
                  QueryRequest{{name, {}, 0, false}, {}})
        .then(
          [=, this](const Outcome<std::vector<EntryPtr>>& found) {
            if (found && select(*found, what_).empty())
              return refuse(nothing_found(name, what_, *found, known.types) +
                            ". With --wait it may come later");
            subscribe_to(filter);
          },
          [=, this](const caf::error&) { subscribe_to(filter); });
    });
  }

  void subscribe_to(const ChangeFilter& filter) {
    filter_ = filter;
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
    if (context_->on_event)
      return context_->on_event(event);
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
    self_->request(watched.actor, inspection_patience, ReadRequest{address, {}})
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
      caf::anon_send(to, InspectionReply{connection, as_line(x), last});
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
      say(outcome_as_json({{}, all_findings(result, Classes::on_this_machine, running_names())}),
          true);
      return;
    }
    if (!result.diagnostics.empty())
      say(as_line(Json{{"remarks", render(result.diagnostics)}}));
    auto news = members_of(*result.architecture);
    order(*std::move(result.architecture), std::move(news));
  }

  void remove(const Json& request) {
    auto name = request.at("name").get<std::string>();
    order(name, members_of(*parts_.roster, name));
  }

  /// What the lines that are added may name.
  SystemNames running_names() const {
    SystemNames result;
    for (auto& [name, wm] : parts_.roster->working_memories)
      result.subarchitectures.insert(name);
    for (auto& x : parts_.roster->components)
      (x.identity.subarchitecture.empty() ? result.standalone : result.in_subarchitectures)
        .insert(x.identity.name);
    return result;
  }

  /// @param news what is said of a change that was made
  static std::string outcome_as_json(const OrderOutcome& x, const Json& news = Json::object()) {
    Json result;
    if (!x.findings.empty())
      result["findings"] = render(x.findings);
    else if (!x.problem.empty())
      result["error"] = x.problem;
    else {
      result["done"] = true;
      result.update(news);
    }
    return as_line(result);
  }

  void order(std::variant<ArchitectureDescription, std::string> what, Json news) {
    auto done = [to = parts_.endpoint, connection = parts_.connection,
                 news = std::move(news)](const OrderOutcome& x) {
      caf::anon_send(to, InspectionReply{connection, outcome_as_json(x, news), true});
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
  InspectionContextPtr context_;
  InspectionParts& parts_;
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
