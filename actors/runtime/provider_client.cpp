#include "castor/actors/runtime/provider_client.hpp"

#include "castor/actors/component/option.hpp"
#include "castor/base/suggestion.hpp"

#include <string_view>
#include <vector>

namespace castor {

namespace {

/// Where the reply to a request arrives; gives it back at the end of its life.
class ReplySlot {
public:
  ReplySlot(PumpedActor& actor, std::uint64_t id) : actor_(actor), id_(id) {
    actor_.open_slot(id_);
  }
  ReplySlot(const ReplySlot&) = delete;
  ReplySlot& operator=(const ReplySlot&) = delete;
  ~ReplySlot() { actor_.close_slot(id_); }

  /// Null until it has arrived.
  caf::mailbox_element_ptr& reply() const { return actor_.slot(id_); }

private:
  PumpedActor& actor_;
  std::uint64_t id_;
};

} // namespace

caf::actor ProviderClient::find(const std::string& name) const {
  auto& neighbours = parts_.context.neighbours();
  if (auto i = neighbours.providers.find(name); i != neighbours.providers.end())
    return i->second;
  if (neighbours.known_providers.contains(name))
    return nullptr;
  std::vector<std::string_view> names;
  for (auto& [known, restarts] : neighbours.known_providers)
    names.push_back(known);
  auto guess = did_you_mean(name, names);
  throw ConnectionError(
    "there is no stand-alone component " + name + "; " +
    (guess.empty() ? "add a COMPONENT line for it to the system's .cast file" : guess));
}

caf::actor ProviderClient::await(const std::string& name, const caf::actor_addr& gone,
                                 const std::string& task, Clock::time_point until) const {
  auto cannot = [&] { return "cannot " + task + " " + name + ": "; };
  auto& known = parts_.context.neighbours().known_providers;
  if (auto i = known.find(name); gone && i != known.end() && !i->second)
    throw ConnectionError(cannot() + "it has ended with no result, and is not started again");
  caf::actor result;
  auto failure = parts_.client.wait_until(
    [&] {
      result = find(name);
      return result && result.address() != gone;
    },
    until, {});
  if (!failure)
    return result;
  if (failure->kind != FailureKind::no_answer)
    throw ConnectionError(cannot() + failure->message);
  throw ProviderDown(name, cannot() + name + " is down, and was not started again within " +
                             detail::print_option(parts_.context.deadline()) +
                             ". The --deadline of " + parts_.context.identity().full_name() +
                             " can be raised");
}

std::string ProviderClient::remedy_at_start(const std::string& provider) const {
  const auto& self = parts_.context.identity().full_name();
  if (parts_.context.record().state() != ComponentState::configured)
    return {};
  return "; if " + provider + " starts after " + self + ", put its COMPONENT line before that of " +
         self + " in the .cast file";
}

caf::mailbox_element_ptr ProviderClient::send(const std::string& name, const caf::actor& provider,
                                              const caf::message& request, const std::string& task,
                                              Clock::time_point until) const {
  const ReplySlot slot{parts_.actor,
                       parts_.actor.request(provider, caf::infinite, request).id().integer_value()};
  // If its process is lost, nobody answers.
  auto failure =
    parts_.client.wait_until([&] { return slot.reply() || find(name) != provider; }, until, {});
  if (auto& reply = slot.reply()) {
    auto& content = reply->content();
    bool has_ended = content.match_elements<caf::error>() &&
                     content.get_as<caf::error>(0) == caf::sec::request_receiver_down;
    return has_ended ? nullptr : std::move(reply);
  }
  if (failure)
    throw ConnectionError("cannot " + task + " " + name + ": " +
                          (failure->kind == FailureKind::no_answer
                             ? parts_.context.identity().full_name() + " got no answer within " +
                                 detail::print_option(parts_.context.deadline()) +
                                 ". Its --deadline can be raised" + remedy_at_start(name)
                             : failure->message));
  return nullptr;
}

} // namespace castor
