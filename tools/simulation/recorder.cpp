#include "castor/tools/simulation/recorder.hpp"

#include <algorithm>
#include <iterator>

namespace castor::linearizability {

void Recorder::set_time(Timestamp now) {
  advances_.emplace_back(now, tick());
}

Recorder::Index Recorder::invoked(OperationRecord x) {
  return invoked(std::move(x), tick());
}

Recorder::Index Recorder::invoked(OperationRecord x, Tick at) {
  x.invoked = at;
  operations_.push_back({std::move(x), now(), false});
  return operations_.size() - 1;
}

void Recorder::returned(Index x, const Result& result) {
  auto& record = operations_[x].record;
  record.result = result;
  record.returned = tick();
}

void Recorder::known_to_have_arrived(Index x) {
  auto& operation = operations_[x];
  if (operation.arrived_by != never)
    return;
  operation.arrived_by = tick();
  if (!operation.record.locks() || overtaking_ == Timestamp{0})
    operation.record.queued_by = operation.arrived_by;
}

void Recorder::did_not_happen(Index x) {
  operations_[x].dropped = true;
}

void Recorder::obtained(Index lock) {
  auto& [record, sent, dropped, arrived_by] = operations_[lock];
  Lease lease{record.client, record.invoked, sent + lease_duration_, now() + lease_duration_};
  if (may_be_lost_.contains(record.client))
    lease.may_end_from = record.invoked;
  leases_.try_emplace({record.entry, record.result.token}, lease);
}

void Recorder::renewing(std::uint32_t entry, Token token) {
  if (auto i = leases_.find({entry, token}); i != leases_.end())
    ++i->second.renewals_under_way;
}

void Recorder::renewed(std::uint32_t entry, Token token, Timestamp sent) {
  auto i = leases_.find({entry, token});
  if (i == leases_.end())
    return;
  auto& lease = i->second;
  --lease.renewals_under_way;
  lease.lasts_until = std::max(lease.lasts_until, sent + lease_duration_);
  lease.over_by = std::max(lease.over_by, now() + lease_duration_);
}

void Recorder::not_renewed(std::uint32_t entry, Token token) {
  if (auto i = leases_.find({entry, token}); i != leases_.end())
    --i->second.renewals_under_way;
}

void Recorder::may_end(std::uint32_t entry, Token token, Tick from) {
  auto& lease = leases_.at({entry, token});
  lease.may_end_from = std::min(lease.may_end_from, from);
}

void Recorder::has_ended(std::uint32_t entry, Token token) {
  auto& lease = leases_.at({entry, token});
  lease.ended_by = std::min(lease.ended_by, tick());
}

void Recorder::died(Client client) {
  auto now = tick();
  deaths_[client] = now;
  for (auto& [key, lease] : leases_)
    if (lease.holder == client)
      lease.may_end_from = std::min(lease.may_end_from, now);
}

void Recorder::may_be_lost(Client client) {
  auto now = tick();
  may_be_lost_.try_emplace(client, now);
  for (auto& [key, lease] : leases_)
    if (lease.holder == client)
      lease.may_end_from = std::min(lease.may_end_from, now);
}

void Recorder::lost(std::uint32_t entry, Tick from, Tick to, const Result& begin) {
  OperationRecord x;
  x.entry = entry;
  x.kind = OperationKind::loss;
  x.result = begin;
  x.invoked = from;
  x.returned = to;
  operations_.push_back({x, now(), false});
}

void Recorder::leases_lost(std::uint32_t entry, Token below, Tick from, Tick to) {
  restarts_.push_back({entry, from, to});
  for (auto& [key, lease] : leases_)
    if (key.first == entry && key.second < below) {
      lease.may_end_from = std::min(lease.may_end_from, from);
      lease.ended_by = std::min(lease.ended_by, to);
    }
}

void Recorder::clock_jumped(std::uint32_t entry, Timestamp by) {
  jumps_.push_back({entry, tick(), by});
}

void Recorder::deaths_are_known() {
  auto now = tick();
  for (auto& [key, lease] : leases_)
    if (deaths_.contains(lease.holder))
      lease.ended_by = std::min(lease.ended_by, now);
}

History Recorder::finish() {
  History result;
  auto end = tick();
  for (auto& [record, sent, dropped, arrived_by] : operations_) {
    if (dropped)
      continue;
    result.push_back(record);
    // The lease that a client may have obtained without ever hearing of it.
    if (record.pending() &&
        (record.kind == OperationKind::lock || record.kind == OperationKind::try_lock)) {
      OperationRecord lapse;
      lapse.client = record.client;
      lapse.entry = record.entry;
      lapse.kind = OperationKind::lapse;
      lapse.invoked = first_tick_at(sent + lease_duration_);
      for (auto* ends : {&deaths_, &may_be_lost_})
        if (auto i = ends->find(record.client); i != ends->end())
          lapse.invoked = std::min(lapse.invoked, i->second);
      for (auto& x : restarts_)
        if (x.entry == record.entry && record.invoked < x.to)
          lapse.invoked = std::min(lapse.invoked, std::max(x.from, record.invoked));
      for (auto& x : jumps_)
        if (x.entry == record.entry && record.invoked < x.at && x.by.count() > 0)
          lapse.invoked = std::min(lapse.invoked, x.at);
      if (lapse.invoked == never)
        continue;
      lapse.returned = end;
      result.push_back(lapse);
    }
  }
  for (auto& [key, lease] : leases_) {
    auto lapse = lapse_of(key.first, key.second, lease);
    if (lapse.invoked != never)
      result.push_back(lapse);
  }
  return result;
}

OperationRecord Recorder::lapse_of(std::uint32_t entry, Token token, const Lease& lease) {
  OperationRecord x;
  x.client = lease.holder;
  x.entry = entry;
  x.kind = OperationKind::lapse;
  x.token = token;
  x.invoked = std::min(lease.may_end_from, first_tick_at(lease.lasts_until));
  auto over_by = lease.over_by;
  for (auto& jump : jumps_) {
    if (jump.entry != entry || jump.at < lease.invoked)
      continue;
    if (jump.by.count() > 0)
      x.invoked = std::min(x.invoked, jump.at);
    else
      over_by -= jump.by;
  }
  x.returned = lease.ended_by;
  if (lease.renewals_under_way == 0)
    x.returned = std::min(x.returned, first_tick_at(over_by));
  x.mandatory = x.returned != never;
  x.returned = std::min(x.returned, tick_);
  return x;
}

LockOrder Recorder::lock_order() const {
  LockOrder result{overtaking_};
  for (auto& [record, sent, dropped, arrived_by] : operations_)
    if (record.locks() && !dropped)
      result.add({record, arrived_by, sent, time_at(record.returned)});
  return result;
}

Timestamp Recorder::time_at(Tick tick) const {
  auto i = std::ranges::upper_bound(advances_, tick, {}, [](auto& x) { return x.second; });
  return i == advances_.begin() ? Timestamp{0} : std::prev(i)->first;
}

Tick Recorder::first_tick_at(Timestamp time) const {
  auto i = std::ranges::lower_bound(advances_, time, {}, [](auto& x) { return x.first; });
  return i == advances_.end() ? never : i->second;
}

} // namespace castor::linearizability
