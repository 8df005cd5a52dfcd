#include "castor/tools/simulation/simulated_client.hpp"

#include <algorithm>
#include <utility>

namespace castor::linearizability {

void SimulatedClient::lock(OperationRecord x) {
  x.level = LockLevel(1 + world_.pick(3));
  auto record = world_.recorder.invoked(x);
  auto number = ++last_wait_;
  auto wait = patience(number);
  if (x.kind == OperationKind::try_lock)
    wait.at_most = Timestamp{0};
  ask<castor::Lease>(route_to(x.entry),
                     LockRequest{world_.entries[x.entry].address, level_of(x.level), wait,
                                 world_.overtaking > Timestamp{0}},
                     {record}, number,
                     [this, record](const Outstanding& out, const Outcome<castor::Lease>& answer) {
                       if (answer)
                         obtained(out, answer->token);
                       else
                         failed(record, answer.failure());
                     });
}

void SimulatedClient::unlock(const OperationRecord& x) {
  auto record = world_.recorder.invoked(x);
  ask<Acknowledged>(route_to(x.entry),
                    UnlockRequest{world_.entries[x.entry].address, identity_, x.token}, {record}, 0,
                    [this, record](const Outstanding&, const Outcome<Acknowledged>& answer) {
                      if (!answer)
                        return failed(record, answer.failure());
                      world_.recorder.returned(record, {});
                      auto& operation = world_.recorder[record];
                      auto& view = views_[operation.entry];
                      if (view.token == operation.token && --view.times == 0) {
                        view.returned_tokens.push_back(view.token);
                        view.lose_lease();
                      }
                    });
}

/// Directly, as the keeper does.
void SimulatedClient::renew() {
  auto& recorder = world_.recorder;
  for (std::size_t owner = 0; owner < world_.working_memories.size(); ++owner) {
    RenewRequest message{identity_, {}};
    std::vector<std::pair<std::uint32_t, Token>> renewed;
    for (std::uint32_t entry = 0; entry < views_.size(); ++entry) {
      auto& view = views_[entry];
      if (world_.entries[entry].owner != owner)
        continue;
      for (auto token : {view.token, view.returned_tokens.empty() ? 0 : view.returned_tokens[0]}) {
        if (token == 0)
          continue;
        message.leases.push_back({world_.entries[entry].address.id, token});
        renewed.emplace_back(entry, token);
        recorder.renewing(entry, token);
      }
    }
    auto to = way_to(owner);
    if (renewed.empty() || !to)
      continue;
    request(to, deadline(), message)
      .then([this, renewed, sent = recorder.now()](
              const RenewReply& answer) { renewal_answered(renewed, sent, answer); },
            // Whether they were renewed is not known then.
            [](const caf::error&) {});
  }
}

void SimulatedClient::renewal_answered(const std::vector<std::pair<std::uint32_t, Token>>& renewed,
                                       Timestamp sent, const RenewReply& answer) {
  for (auto& [entry, token] : renewed) {
    auto is_lost = std::ranges::count(answer.lost, token, &HeldToken::token) > 0;
    if (is_lost)
      world_.recorder.not_renewed(entry, token);
    else
      world_.recorder.renewed(entry, token, sent);
    if (!is_lost && !may_hold_unawares(entry) &&
        std::ranges::count(views_[entry].returned_tokens, token) > 0)
      world_.find("client " + std::to_string(number_) + " renewed token " + std::to_string(token) +
                  ", which it had given back");
  }
}

bool SimulatedClient::may_hold_unawares(std::uint32_t entry) const {
  return views_[entry].unsure || (deadline() != caf::infinite && outstanding_.concern(entry));
}

void SimulatedClient::claim(const LeaseOffer& offer) {
  auto entry =
    std::ranges::find(world_.entries, offer.address, &SimulatedWorld::SimulatedEntry::address);
  send(way_to(entry->owner), ClaimLease{offer.address, identity_, offer.number});
}

void SimulatedClient::give_up_something() {
  // What comes through another working memory may overtake.
  if (parts_.traits.uses_any_memory)
    return;
  auto* x = outstanding_.find_to_give_up(views_);
  if (!x)
    return;
  outstanding_.give_up(*x);
  auto& address = world_.entries[world_.recorder[x->records.front()].entry].address;
  send(way_to(x->route.via), CancelWait{address, identity_, x->wait});
}

void SimulatedClient::obtained(const Outstanding& x, Token token) {
  auto& recorder = world_.recorder;
  auto record = x.records.front();
  recorder.returned(record, {.token = token});
  recorder.obtained(record);
  auto entry = recorder[record].entry;
  world_.entries[entry].last_token = token;
  if (x.given_up_by != 0) {
    outstanding_.grant_unwanted(x, entry, token);
    return;
  }
  auto& view = views_[entry];
  view.present = true;
  if (view.token != token) {
    view.lose_lease();
    view.token = token;
  }
  ++view.times;
}

} // namespace castor::linearizability
