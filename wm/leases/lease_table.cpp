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
  auto& holding = row->second.holding;
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
                                      Timestamp deadline) {
  if (auto lease = try_lock(id, client, level, number, now))
    return lease;
  enqueue(rows_.find(id), {client, number, level, deadline});
  return std::nullopt;
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
  auto& [holding, queue, expiry, is_excluded] = row->second;
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
  auto& [holding, queue, expiry, is_excluded] = row->second;
  if (holding && holding->number == number && *holding->holder == client) {
    end_lease(row, now);
    return;
  }
  forget_waits(row->second, [&](auto& x) { return x.number == number && *x.client == client; });
  remove_if_idle(row);
}

void LeaseTable::drop(const Client& client, Timestamp now) {
  std::vector<std::string> held;
  for (auto& [expires, id] : expiries_) {
    auto& row = rows_.at(id);
    forget_waits(row, [&](auto& x) { return *x.client == client; });
    if (*row.holding->holder == client)
      held.push_back(id);
  }
  for (auto& id : held)
    end_lease(rows_.find(id), now);
}

void LeaseTable::erase(const std::string& id) {
  auto row = rows_.find(id);
  if (row == rows_.end())
    return;
  if (row->second.holding)
    expiries_.erase(row->second.expiry);
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
}

std::optional<Timestamp> LeaseTable::next_deadline() const {
  std::optional<Timestamp> result;
  if (!expiries_.empty())
    result = expiries_.begin()->first;
  if (!deadlines_.empty())
    result = std::min(result.value_or(Timestamp::max()), deadlines_.begin()->first.first);
  return result;
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
  auto& [holding, queue, expiry, is_excluded] = row->second;
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
  auto& [holding, queue, expiry, was_excluded] = row->second;
  bool is_excluded = holding && holding->lease.level == LockLevel::odr;
  if (std::exchange(was_excluded, is_excluded) != is_excluded && options_.on_exclusion)
    options_.on_exclusion(row->first, is_excluded);
}

void LeaseTable::serve(Rows::iterator row, Timestamp now) {
  auto& [holding, queue, expiry, is_excluded] = row->second;
  while (!queue.empty() && !holding) {
    auto waiter = std::move(queue.front());
    queue.pop_front();
    if (waiter.level)
      settle(waiter, SettledWait::Result::granted,
             grant(row, waiter.client, *waiter.level, waiter.number, now));
    else
      settle(waiter, SettledWait::Result::readable);
  }
  if (holding)
    serve_reads(row->second);
  remove_if_idle(row);
}

void LeaseTable::serve_reads(Row& row) {
  auto& holding = *row.holding;
  std::erase_if(row.queue, [&](auto& waiter) {
    if (waiter.level)
      return false;
    if (holding.lease.level == LockLevel::odr && !(*waiter.client == *holding.holder))
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
  if (!row->second.holding && row->second.queue.empty())
    rows_.erase(row);
}

} // namespace castor
