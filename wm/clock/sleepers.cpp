#include "castor/wm/clock/sleepers.hpp"

#include <utility>

namespace castor {

Sleepers::Key Sleepers::add(Timestamp time, std::uint64_t order, Wake wake) {
  Key key{time, order, ++last_number_};
  waiting_.emplace(key, std::move(wake));
  return key;
}

std::vector<Sleepers::Wake> Sleepers::take_due(Timestamp now, std::size_t count) {
  std::vector<Wake> result;
  while (result.size() < count && next() <= now) {
    result.push_back(std::move(waiting_.begin()->second));
    waiting_.erase(waiting_.begin());
  }
  return result;
}

} // namespace castor
