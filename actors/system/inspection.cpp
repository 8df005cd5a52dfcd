#include "castor/actors/system/inspection.hpp"

#include "castor/actors/system/change_requests.hpp"
#include "castor/actors/system/clock_requests.hpp"
#include "castor/actors/system/entry_queries.hpp"
#include "castor/actors/system/event_watch.hpp"
#include "castor/actors/system/inspection_context.hpp"
#include "castor/actors/system/operator_requests.hpp"
#include "castor/actors/system/replay.hpp"
#include "castor/actors/system/request_lines.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace castor {

namespace {

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
        inspection->watch_.update();
      },
      [inspection](const ChangeNotice& x) { inspection->hear(x.event); },
      [inspection](const ChangeNotices& x) {
        for (auto& notice : x.notices)
          inspection->hear(notice.event);
      },
      [inspection](InspectionTaken) { inspection->watch_.taken(); },
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
      {"types", [](Inspection& x, const Json& request) { show_types(x.context_, request); }},
      {"wm", [](Inspection& x, const Json& request) { show_entries(x.context_, request); }},
      {"events", [](Inspection& x, const Json& request) { x.watch_.begin(request); }},
      {"clock", [](Inspection& x, const Json& request) { show_or_set_clock(x.context_, request); }},
      {"graph", [](Inspection& x, const Json&) { x.tell_accesses(); }},
      {"replay", [](Inspection& x, const Json& request) { x.replay_into_system(request); }},
      {"add", [](Inspection& x, const Json& request) { add_components(x.context_, request); }},
      {"remove", [](Inspection& x, const Json& request) { remove_component(x.context_, request); }},
      {"write", [](Inspection& x, const Json& request) { add_entry(x.context_, request); }},
      {"overwrite",
       [](Inspection& x, const Json& request) { overwrite_entry(x.context_, request); }},
      {"delete", [](Inspection& x, const Json& request) { delete_entry(x.context_, request); }},
      {"call", [](Inspection& x, const Json& request) { call_component(x.context_, request); }},
      {"command",
       [](Inspection& x, const Json& request) { command_effector(x.context_, request); }},
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

  void say(std::string text, bool last = false) { context_->send(std::move(text), last); }

  void hear(const ChangeEventPtr& event) {
    if (context_->on_event)
      context_->on_event(event);
    else
      watch_.on_event(event);
  }

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
      auto report = to_json(*result, *parts_.roster);
      report["clock"] = clock_report(parts_.clock.get());
      say(as_line(report), true);
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

  caf::event_based_actor* self_;
  InspectionContextPtr context_;
  InspectionParts& parts_;
  EventWatch watch_{*context_};
  bool is_asked_ = false;
  caf::actor replay_;
};

} // namespace

caf::behavior inspection(caf::event_based_actor* self, InspectionParts parts) {
  return std::make_shared<Inspection>(self, std::move(parts))->begin();
}

} // namespace castor
