#include "castor/actors/system/operator_client.hpp"
#include "castor/actors/system/operator_requests.hpp"

#include "castor/actors/runtime/effector_clock.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/actors/system/value_from_json.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace castor {

namespace {

/// A day: longer than this nobody commands.
constexpr double longest_command = 86400;

/// A command that an operator gives to an effector, once or again and again, under the lease that
/// the effector demands. It ends with the connection, and the effector then takes its safe state.
class OperatorCommand : public std::enable_shared_from_this<OperatorCommand> {
public:
  OperatorCommand(InspectionContextPtr context, const Json& request)
    : context_(std::move(context)), effector_(request.at("effector")), type_(request.at("type")),
      json_(request.at("command")), client_(new_operator_client()) {
    if (request.contains("for"))
      duration_ = seconds(request.at("for"), "for");
    if (request.contains("valid_for"))
      valid_for_ = seconds(request.at("valid_for"), "valid_for");
  }

  void begin() {
    auto& providers = context_->parts.roster->providers;
    auto i = providers.find(effector_);
    if (i == providers.end()) {
      std::set<std::string> names;
      for (auto& [name, actor] : providers)
        names.insert(name);
      throw InspectionError("there is no stand-alone component " + effector_ +
                            nearest_known(effector_, names));
    }
    actor_ = i->second;
    auto self = shared_from_this();
    context_->with_types(
      [self](const TypeCatalogue& types) { self->guarded([&] { self->ask_terms(types); }); });
  }

private:
  static Timestamp seconds(double x, const std::string& name) {
    if (!(x > 0) || x > longest_command)
      throw InspectionError(name + " has to be between 0 and 86400 seconds");
    return std::chrono::duration_cast<Timestamp>(std::chrono::duration<double>(x));
  }

  void ask_terms(const TypeCatalogue& types) {
    auto type = find_type(type_, types);
    if (!type)
      throw InspectionError("the type " + type_ + " is not known here");
    value_ = value_from_json(type, json_);
    ask<CommandTermsReply>(CommandTermsQuery{type}, [self = shared_from_this()](auto& x) {
      self->terms_ = x.terms;
      self->clock_.synchronise(x.clock, std::chrono::steady_clock::now());
      self->lock();
    });
  }

  /// Sends a request to the effector, and calls `f` with the result.
  template <class Reply, class Request, class F>
  void ask(const Request& request, F f) {
    auto self = shared_from_this();
    context_->self->request(actor_, inspection_patience, request)
      .then(
        [self, f](const Outcome<Reply>& x) {
          if (!x)
            return self->fail(x.failure().message);
          self->guarded([&] { f(*x); });
        },
        [self](const caf::error&) { self->fail(self->effector_ + " does not answer"); });
  }

  void lock() {
    if (!terms_.lease)
      return command();
    auto self = shared_from_this();
    auto& entry = *terms_.lease;
    context_->ask<Lease>(
      context_->working_memory(entry.subarchitecture), client_,
      LockRequest{entry, LockLevel::o, {client_, 1, Timestamp{0}}},
      [self](const Outcome<Lease>& x) {
        if (!x)
          return self->fail(x.failure().message);
        self->token_ = x->token;
        self->renew();
        self->command();
      },
      [self] {
        self->fail("the working memory of " + self->terms_.lease->subarchitecture +
                   " does not answer");
      });
  }

  /// Keeps the lease as long as the connection lives.
  void renew() {
    constexpr std::chrono::milliseconds period{250};
    auto self = shared_from_this();
    auto& entry = *terms_.lease;
    guarded([&] {
      context_->self
        ->request(context_->working_memory(entry.subarchitecture), inspection_patience,
                  RenewRequest{client_, {{entry.id, token_}}})
        .then([](const RenewReply&) {},
              [](const caf::error&) {
                // The lease expires, and the effector will say so.
              });
      after(period, [self] { self->renew(); });
    });
  }

  void command() {
    auto now = std::chrono::steady_clock::now();
    auto valid_for = std::min(valid_for_.value_or(terms_.valid_for), terms_.valid_for);
    if (number_ == 0)
      end_ = now + duration_.value_or(valid_for);
    CommandMessage message{value_, client_, token_, clock_.at(now), valid_for, ++number_};
    ask<CommandDone>(message, [self = shared_from_this(), valid_for](auto& x) {
      if (x.result == CommandResult::refused)
        return self->fail(x.reason);
      if (x.result == CommandResult::failed)
        return self->fail(self->effector_ + " failed: " + x.reason);
      self->clock_.synchronise(x.clock, std::chrono::steady_clock::now());
      self->go_on(valid_for);
    });
  }

  /// Commands again while the time lasts, before the last command has expired.
  void go_on(Timestamp valid_for) {
    auto left = std::chrono::duration_cast<Timestamp>(end_ - std::chrono::steady_clock::now());
    auto self = shared_from_this();
    if (duration_ && left > valid_for / 2)
      after(valid_for / 2, [self] { self->command(); });
    else
      after(left, [self] {
        self->end(
          {{"effector", self->effector_}, {"type", self->type_}, {"commands", self->number_}});
      });
  }

  void after(Timestamp delay, std::function<void()> f) {
    context_->self->delayed_send(context_->self, std::max(delay, Timestamp{0}),
                                 InspectionTimeout{[self = shared_from_this(), f] {
                                   if (!self->is_over_)
                                     f();
                                 }});
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

  InspectionContextPtr context_;
  std::string effector_;
  std::string type_;
  Json json_;
  ClientPtr client_;
  /// How long to command; once if there is none.
  std::optional<Timestamp> duration_;
  std::optional<Timestamp> valid_for_;
  caf::actor actor_;
  Value value_;
  CommandTerms terms_;
  EffectorClock clock_;
  LeaseToken token_ = 0;
  std::uint64_t number_ = 0;
  EffectorClock::Time end_;
  bool is_over_ = false;
};

} // namespace

void command_effector(const InspectionContextPtr& context, const Json& request) {
  std::make_shared<OperatorCommand>(context, request)->begin();
}

} // namespace castor
