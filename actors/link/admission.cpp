#include "castor/actors/link/admission.hpp"

#include <algorithm>
#include <tuple>

namespace castor {

namespace {

constexpr std::size_t known_at_most = 256;

} // namespace

std::optional<Admission::Connection> Admission::admit(Connection x, const std::string& address,
                                                      Time now) {
  auto from_there =
    std::ranges::count_if(waiting_, [&](auto& y) { return y.second.address == address; });
  bool is_full = static_cast<std::size_t>(from_there) >= limits_.per_address;
  if (!is_full && waiting_.size() < limits_.all) {
    waiting_[x] = {address, now};
    return std::nullopt;
  }
  // Whoever takes too much makes room for itself only.
  std::optional<Connection> out;
  auto rank = [&](const Waiting& y) {
    return std::tuple{!y.is_silent, is_known(y.address), y.since};
  };
  for (auto& [connection, y] : waiting_) {
    if (is_full && y.address != address)
      continue;
    // One that speaks has its time, unless somebody comes who is known.
    bool may_go = y.is_silent || now - y.since > limits_.silent ||
                  (!is_full && is_known(address) && !is_known(y.address));
    if (may_go && (!out || rank(y) < rank(waiting_.at(*out))))
      out = connection;
  }
  if (!out)
    return x;
  waiting_.erase(*out);
  waiting_[x] = {address, now};
  return out;
}

void Admission::has_sent(Connection x) {
  if (auto i = waiting_.find(x); i != waiting_.end())
    i->second.is_silent = false;
}

void Admission::remember(const std::string& address) {
  std::erase(known_, address);
  known_.push_front(address);
  if (known_.size() > known_at_most)
    known_.pop_back();
}

std::vector<Admission::Connection> Admission::late(Time now) const {
  std::vector<Connection> result;
  for (auto& [connection, x] : waiting_)
    if (now - x.since > (x.is_silent ? limits_.silent : limits_.patience))
      result.push_back(connection);
  return result;
}

bool Admission::is_known(const std::string& address) const {
  return std::ranges::find(known_, address) != known_.end();
}

} // namespace castor
