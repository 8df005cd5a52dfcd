#include "castor/actors/runtime/served_calls.hpp"

namespace castor {

void ServedCalls::finish(const Address& call) {
  if (auto i = calls_.find(call); i != calls_.end())
    i->second.is_finished = true;
}

void ServedCalls::deleted(const Address& call) {
  if (auto i = calls_.find(call); i != calls_.end())
    i->second.is_over = true;
}

void ServedCalls::memory_lost(const std::string& subarchitecture) {
  for (auto& [call, state] : calls_)
    if (call.subarchitecture == subarchitecture)
      state.is_over = true;
}

bool ServedCalls::is_over(const Address& call) const {
  auto i = calls_.find(call);
  return i != calls_.end() && i->second.is_over;
}

std::vector<Address> ServedCalls::take_ended() {
  std::vector<Address> result;
  std::erase_if(calls_, [&](auto& x) {
    auto is_done = x.second.is_finished && x.second.is_over;
    if (is_done)
      result.push_back(x.first);
    return is_done;
  });
  return result;
}

} // namespace castor
