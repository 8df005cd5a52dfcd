#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace castor {

/// Which requests of a component to working memories may not have been handled yet: whoever reads
/// without a message must not overtake them.
class UnansweredRequests {
public:
  /// A request was sent. Later requests have higher ids.
  void begun() { ++open_; }

  /// Its answer has arrived.
  void answered(std::uint64_t id, const std::string& subarchitecture) {
    --open_;
    // Requests to one working memory are handled in their order.
    auto i = abandoned_.find(subarchitecture);
    if (i != abandoned_.end() && i->second < id)
      abandoned_.erase(i);
  }

  /// Nobody waits for its answer any more.
  void abandoned(std::uint64_t id, const std::string& subarchitecture) {
    --open_;
    abandoned_[subarchitecture] = id;
  }

  /// Whether all requests to the working memory of that subarchitecture were handled. A request to
  /// another one that is under way counts, too.
  bool are_handled(const std::string& subarchitecture) const {
    return open_ == 0 && (abandoned_.empty() || abandoned_.count(subarchitecture) == 0);
  }

private:
  std::size_t open_ = 0;
  /// The last request to each subarchitecture whose answer nobody has waited for.
  std::map<std::string, std::uint64_t> abandoned_;
};

} // namespace castor
