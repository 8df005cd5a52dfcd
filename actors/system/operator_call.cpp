#include "castor/actors/system/operator_client.hpp"
#include "castor/actors/system/operator_requests.hpp"

#include "castor/actors/component/call_types.hpp"
#include "castor/actors/system/value_from_json.hpp"
#include "castor/wm/values/json.hpp"

#include <caf/atom.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace castor {

namespace {

/// Longer than this nobody waits.
constexpr double longest_wait = 86400;

/// A call that an operator makes, as components make theirs (actors/component/calls.hpp), with the
/// difference that its entries stand in the working memory of the server: operators have none of
/// their own. They are ephemeral, and end with the connection.
class OperatorCall : public std::enable_shared_from_this<OperatorCall> {
public:
  OperatorCall(InspectionContextPtr context, const Json& request)
    : context_(std::move(context)), subarchitecture_(request.at("subarchitecture")),
      type_(request.at("type")), value_(request.at("request")), max_bytes_(bytes_shown(request)),
      timeout_(request.value("timeout", 5.0)), client_(new_operator_client()) {
    if (!(timeout_ > 0) || timeout_ > longest_wait)
      throw InspectionError("timeout has to be between 0 and 86400 seconds");
    id_ = "call:" + std::to_string(client_->incarnation) + ':' + operator_source();
  }

  void begin() {
    auto call = shared_from_this();
    wm_ = context_->working_memory(subarchitecture_);
    query("CallServer", [call](const std::vector<EntryPtr>& servers) { call->choose(servers); });
  }

private:
  /// Calls `f` with the entries of a type in the server's working memory.
  template <class F>
  void query(const std::string& type, F f) {
    ask<std::vector<EntryPtr>>(QueryRequest{{subarchitecture_, type, 0, false}, {}}, std::move(f));
  }

  template <class Reply, class Request, class F>
  void ask(const Request& request, F f) {
    auto call = shared_from_this();
    context_->ask<Reply>(
      wm_, client_, request,
      [call, f](const Outcome<Reply>& x) {
        if (call->is_over_)
          return;
        if (!x)
          return call->fail(x.failure().message);
        call->guarded([&] { f(*x); });
      },
      [call] {
        call->fail("the working memory of " + call->subarchitecture_ + " does not answer");
      });
  }

  /// Finds out what the reply is to be.
  void choose(const std::vector<EntryPtr>& servers) {
    std::set<std::string> served;
    for (auto& entry : servers) {
      auto server = entry->value.as<CallServer>();
      served.insert(server->request_type);
      if (server->request_type == type_)
        reply_type_ = server->reply_type;
    }
    if (served.empty())
      return fail("no component of " + subarchitecture_ + " serves calls");
    if (reply_type_.empty())
      return fail("no component of " + subarchitecture_ + " serves calls of the type " + type_ +
                  nearest_known(type_, served));
    auto call = shared_from_this();
    context_->with_types(
      [call](const TypeCatalogue& types) { call->guarded([&] { call->subscribe(types); }); });
  }

  void subscribe(const TypeCatalogue& types) {
    auto type = find_type(type_, types);
    if (!type)
      throw InspectionError("the type " + type_ + " is not known here");
    auto request = value_from_json(type, value_);
    auto call = shared_from_this();
    // The timer keeps the call, which keeps the context.
    context_->on_event = [weak = std::weak_ptr{call}](const ChangeEventPtr& x) {
      if (auto alive = weak.lock())
        alive->note_progress(*x);
    };
    Subscribe wish{
      1, changed<CallProgress>().in(subarchitecture_).at({subarchitecture_, progress_id()})};
    ask<Acknowledged>(wish, [call, request](const Acknowledged&) { call->make(request); });
  }

  void make(const Value& request) {
    constexpr EntryLife with_the_connection{.ephemeral = true};
    BatchRequest batch{subarchitecture_, {}};
    auto add = [&](const std::string& id, Value value) {
      WriteRequest x;
      x.address = {subarchitecture_, id};
      x.value = std::move(value);
      x.client = client_;
      x.life = with_the_connection;
      batch.writes.push_back(std::move(x));
    };
    add(id_ + ":request", request);
    add(id_, Value::of(Call{subarchitecture_,
                            type_,
                            reply_type_,
                            {subarchitecture_, id_ + ":request"},
                            operator_source()}));
    auto call = shared_from_this();
    context_->self->delayed_send(context_->self,
                                 std::chrono::duration_cast<std::chrono::milliseconds>(
                                   std::chrono::duration<double>(timeout_)),
                                 InspectionTimeout{[call] { call->give_up(); }});
    ask<std::vector<Version>>(batch, [](const std::vector<Version>&) {});
  }

  void note_progress(const ChangeEvent& event) {
    if (is_over_ || event.address.id != progress_id())
      return;
    taken_ = true;
    if (event.operation == Operation::remove)
      return fail("the component of " + subarchitecture_ + " that served the " + type_ +
                  " ended while it worked on it");
    auto call = shared_from_this();
    ask<EntryPtr>(ReadRequest{event.address, {}},
                  [call](const EntryPtr& x) { call->look_at(*x->value.as<CallProgress>()); });
  }

  void look_at(const CallProgress& progress) {
    server_ = progress.server;
    if (progress.state == CallState::failed)
      return fail(progress.server + " of " + subarchitecture_ + " could not serve the " + type_ +
                  ": " + progress.error);
    if (progress.state != CallState::done)
      return;
    auto call = shared_from_this();
    ask<EntryPtr>(ReadRequest{progress.reply, {}}, [call](const EntryPtr& x) {
      JsonOptions options;
      options.max_bytes = call->max_bytes_;
      call->end({{"subarchitecture", call->subarchitecture_},
                 {"server", call->server_},
                 {"type", x->type_name()},
                 {"value", Json::parse(to_json(x->value, options))}});
    });
  }

  void give_up() {
    if (is_over_)
      return;
    auto seconds = Json(timeout_).dump();
    if (seconds.ends_with(".0"))
      seconds.resize(seconds.size() - 2);
    auto who =
      server_.empty() ? "a component of " + subarchitecture_ : server_ + " of " + subarchitecture_;
    fail("no reply to the " + type_ + " in " + seconds + " s: " +
         (taken_
            ? who + " is still at work on it"
            : "no component of " + subarchitecture_ + " took it; those that serve it are busy") +
         ". Wait longer with a --timeout");
  }

  template <class F>
  void guarded(F&& f) {
    try {
      f();
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }

  void fail(const std::string& why) { end({{"error", why}}); }

  void end(const Json& answer) {
    if (!std::exchange(is_over_, true))
      context_->answer(answer);
  }

  std::string progress_id() const { return id_ + ":progress"; }

  InspectionContextPtr context_;
  std::string subarchitecture_;
  std::string type_;
  Json value_;
  std::size_t max_bytes_;
  /// Seconds.
  double timeout_;
  ClientPtr client_;
  std::string id_;
  std::string reply_type_;
  std::string server_;
  WorkingMemoryActor wm_;
  bool taken_ = false;
  bool is_over_ = false;
};

} // namespace

void call_component(const InspectionContextPtr& context, const Json& request) {
  std::make_shared<OperatorCall>(context, request)->begin();
}

} // namespace castor
