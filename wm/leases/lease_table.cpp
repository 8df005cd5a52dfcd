#include "castor/wm/leases/lease_table.hpp"

#include <algorithm>
#include <utility>

namespace castor {

std::string_view to_string(LockLevel x) {
  switch (x) {
    case LockLevel::o:
      return "O";
    case LockLevel::od:
      return "OD";
    case LockLevel::odr:
      return "ODR";
  }
  return "?";
}

std::optional<Lease> LeaseTable::try_lock(const std::string& id, const ClientPtr& client,
                                          LockLevel level, WaitNumber number, Timestamp now) {
  auto row = rows_.try_emplace(id).first;
  auto& [holding, queue, expiry, is_excluded, overtaken_until] = row->second;
  auto waits_itself = [&](auto& x) { return x.level && *x.client == *client; };
  // Nobody overtakes himself, and nobody waits for an entry that is free: so the first gets it.
  if (!holding && std::any_of(queue.begin(), queue.end(), waits_itself))
    grant_first(row, now);
  if (!holding)
    return grant(row, client, level, number, now);
  if (!(*holding->holder == *client))
    return std::nullopt;
  holding->levels.push_back(level);
  holding->lease.level = std::max(holding->lease.level, level);
  note_exclusion(row);
  return holding->lease;
}

std::optional<Lease> LeaseTable::lock(const std::string& id, const ClientPtr& client,
                                      LockLevel level, WaitNumber number, Timestamp now,
                                      Timestamp deadline, bool can_claim) {
  if (auto lease = try_lock(id, client, level, number, now))
    return lease;
  Waiter waiter{client, number, level, deadline};
  waiter.can_claim = can_claim;
  enqueue(rows_.find(id), std::move(waiter));
  return std::nullopt;
}

void LeaseTable::claim(const std::string& id, const Client& client, WaitNumber number,
                       Timestamp now) {
  auto row = rows_.find(id);
  if (row == rows_.end() || row->second.queue.empty())
    return;
  auto& first = row->second.queue.front();
  if (first.number != number || !(*first.client == client))
    return;
  first.has_claimed = true;
  if (!row->second.holding)
    serve(row, now);
}

bool LeaseTable::may_read(const std::string& id, const Client& client) const {
  auto* x = holding(id);
  return !x || x->lease.level != LockLevel::odr || *x->holder == client;
}

void LeaseTable::wait_to_read(const std::string& id, const ClientPtr& client, WaitNumber number,
                              Timestamp deadline) {
  enqueue(rows_.try_emplace(id).first, {client, number, std::nullopt, deadline});
}

LeaseTable::Verdict LeaseTable::check(const std::string& id, const Client& client,
                                      Operation operation, LeaseToken token) const {
  auto* x = holding(id);
  if (token != 0)
    return x && *x->holder == client && x->lease.token == token ? Verdict::permitted
                                                                : Verdict::stale;
  bool forbidden = x && (operation != Operation::remove || x->lease.level != LockLevel::o);
  return forbidden ? Verdict::leased : Verdict::permitted;
}

bool LeaseTable::unlock(const std::string& id, const Client& client, LeaseToken token,
                        Timestamp now) {
  auto row = rows_.find(id);
  if (row == rows_.end() || !is_holder(row->second, client, token))
    return false;
  auto& holding = *row->second.holding;
  holding.levels.pop_back();
  if (holding.levels.empty()) {
    end_lease(row, now);
    return true;
  }
  holding.lease.level = *std::max_element(holding.levels.begin(), holding.levels.end());
  note_exclusion(row);
  serve_reads(row->second);
  return true;
}

bool LeaseTable::renew(const std::string& id, const Client& client, LeaseToken token,
                       Timestamp now) {
  auto row = rows_.find(id);
  if (row == rows_.end() || !is_holder(row->second, client, token))
    return false;
  auto& [holding, queue, expiry, is_excluded, overtaken_until] = row->second;
  holding->lease.expires = now + options_.duration;
  auto node = expiries_.extract(expiry);
  node.key() = holding->lease.expires;
  expiry = expiries_.insert(expiries_.end(), std::move(node));
  return true;
}

void LeaseTable::cancel(const std::string& id, const Client& client, WaitNumber number,
                        Timestamp now) {
  auto row = rows_.find(id);
  if (row == rows_.end())
    return;
  auto& [holding, queue, expiry, is_excluded, overtaken_until] = row->second;
  if (holding && holding->number == number && *holding->holder == client) {
    end_lease(row, now);
    return;
  }
  forget_waits(row->second, [&](auto& x) { return x.number == number && *x.client == client; });
  if (!holding)
    serve(row, now);
}

void LeaseTable::drop(const Client& client, Timestamp now) {
  std::vector<std::string> held;
  std::vector<std::string> offered;
  auto forget_client = [&](Row& row) {
    forget_waits(row, [&](auto& x) { return *x.client == client; });
  };
  for (auto& [expires, id] : expiries_) {
    auto& row = rows_.at(id);
    forget_client(row);
    if (*row.holding->holder == client)
      held.push_back(id);
  }
  for (auto& [until, id] : overtakings_) {
    auto& row = rows_.at(id);
    if (row.holding)
      continue;
    forget_client(row);
    offered.push_back(id);
  }
  for (auto& id : held)
    end_lease(rows_.find(id), now);
  for (auto& id : offered)
    serve(rows_.find(id), now);
}

void LeaseTable::erase(const std::string& id) {
  auto row = rows_.find(id);
  if (row == rows_.end())
    return;
  if (row->second.holding)
    expiries_.erase(row->second.expiry);
  end_overtaking(row);
  for (auto& waiter : row->second.queue)
    settle(waiter, SettledWait::Result::deleted);
  rows_.erase(row);
}

void LeaseTable::expire(Timestamp now) {
  // First the waits: one whose time is over gets no lease that ends at the same moment.
  while (!deadlines_.empty() && deadlines_.begin()->first.first <= now) {
    auto& [due, id] = *deadlines_.begin();
    auto& queue = rows_.find(id)->second.queue;
    auto waiter = std::find_if(queue.begin(), queue.end(),
                               [arrival = due.second](auto& x) { return x.arrival == arrival; });
    settle(*waiter, SettledWait::Result::timed_out);
    queue.erase(waiter);
  }
  while (!expiries_.empty()) {
    auto& [expires, id] = *expiries_.begin();
    if (expires > now)
      break;
    end_lease(rows_.find(id), now);
  }
  while (!overtakings_.empty() && overtakings_.begin()->first <= now) {
    auto row = rows_.find(overtakings_.begin()->second);
    overtakings_.erase(overtakings_.begin());
    // Whatever the clock says later.
    row->second.overtaken_until = Timestamp::min();
    if (!row->second.holding)
      serve(row, now);
  }
}

std::optional<Timestamp> LeaseTable::next_deadline() const {
  auto result = Timestamp::max();
  if (!expiries_.empty())
    result = expiries_.begin()->first;
  if (!deadlines_.empty())
    result = std::min(result, deadlines_.begin()->first.first);
  if (!overtakings_.empty())
    result = std::min(result, overtakings_.begin()->first);
  return result < Timestamp::max() ? std::optional{result} : std::nullopt;
}

const LeaseTable::Holding* LeaseTable::holding(const std::string& id) const {
  auto row = rows_.find(id);
  return row != rows_.end() && row->second.holding ? &*row->second.holding : nullptr;
}

const std::deque<LeaseTable::Waiter>* LeaseTable::waiting(const std::string& id) const {
  auto row = rows_.find(id);
  return row != rows_.end() && !row->second.queue.empty() ? &row->second.queue : nullptr;
}

bool LeaseTable::is_holder(const Row& row, const Client& client, LeaseToken token) const {
  return row.holding && row.holding->lease.token == token && *row.holding->holder == client;
}

const Lease& LeaseTable::grant(Rows::iterator row, const ClientPtr& client, LockLevel level,
                               WaitNumber number, Timestamp now) {
  auto& [holding, queue, expiry, is_excluded, overtaken_until] = row->second;
  holding = Holding{{next_token_++, level, now + options_.duration}, client, number, {level}};
  expiry = expiries_.emplace_hint(expiries_.end(), holding->lease.expires, row->first);
  note_exclusion(row);
  return holding->lease;
}

void LeaseTable::end_lease(Rows::iterator row, Timestamp now) {
  row->second.holding.reset();
  expiries_.erase(row->second.expiry);
  note_exclusion(row);
  serve(row, now);
}

void LeaseTable::note_exclusion(Rows::iterator row) {
  auto& [holding, queue, expiry, was_excluded, overtaken_until] = row->second;
  bool is_excluded = holding && holding->lease.level == LockLevel::odr;
  if (std::exchange(was_excluded, is_excluded) != is_excluded && options_.on_exclusion)
    options_.on_exclusion(row->first, is_excluded);
}

void LeaseTable::serve(Rows::iterator row, Timestamp now) {
  auto& queue = row->second.queue;
  while (!queue.empty() && !queue.front().level) {
    settle(queue.front(), SettledWait::Result::readable);
    queue.pop_front();
  }
  if (!queue.empty()) {
    if (may_be_overtaken(row->second, now))
      offer_lease(row, now);
    else
      grant_first(row, now);
    serve_reads(row->second);
  }
  remove_if_idle(row);
}

bool LeaseTable::may_be_overtaken(const Row& row, Timestamp now) const {
  auto& first = row.queue.front();
  if (!first.can_claim || first.has_claimed || options_.overtaking <= Timestamp{0})
    return false;
  return !row.overtaken_until || now < *row.overtaken_until;
}

void LeaseTable::offer_lease(Rows::iterator row, Timestamp now) {
  auto& overtaken_until = row->second.overtaken_until;
  if (!overtaken_until) {
    overtaken_until = now + options_.overtaking;
    overtakings_.emplace(*overtaken_until, row->first);
  }
  if (auto& first = row->second.queue.front(); !std::exchange(first.was_offered, true))
    offers_.push_back({first.client, first.number});
}

void LeaseTable::grant_first(Rows::iterator row, Timestamp now) {
  auto waiter = std::move(row->second.queue.front());
  row->second.queue.pop_front();
  end_overtaking(row);
  settle(waiter, SettledWait::Result::granted,
         grant(row, waiter.client, *waiter.level, waiter.number, now));
}

void LeaseTable::end_overtaking(Rows::iterator row) {
  if (auto until = std::exchange(row->second.overtaken_until, std::nullopt))
    overtakings_.erase({*until, row->first});
}

void LeaseTable::serve_reads(Row& row) {
  auto& holding = row.holding;
  std::erase_if(row.queue, [&](auto& waiter) {
    if (waiter.level)
      return false;
    if (holding && holding->lease.level == LockLevel::odr && !(*waiter.client == *holding->holder))
      return false;
    settle(waiter, SettledWait::Result::readable);
    return true;
  });
}

void LeaseTable::enqueue(Rows::iterator row, Waiter waiter) {
  waiter.arrival = ++arrivals_;
  deadlines_.emplace(std::pair{waiter.deadline, waiter.arrival}, row->first);
  row->second.queue.push_back(std::move(waiter));
}

void LeaseTable::settle(const Waiter& waiter, SettledWait::Result result, Lease lease) {
  deadlines_.erase({waiter.deadline, waiter.arrival});
  settled_.push_back({waiter.client, waiter.number, result, lease});
}

template <class F>
void LeaseTable::forget_waits(Row& row, F&& unwanted) {
  std::erase_if(row.queue, [&](auto& x) {
    if (!unwanted(x))
      return false;
    deadlines_.erase({x.deadline, x.arrival});
    return true;
  });
}

void LeaseTable::remove_if_idle(Rows::iterator row) {
  if (row->second.holding || !row->second.queue.empty())
    return;
  end_overtaking(row);
  rows_.erase(row);
}

} // namespace castor
