#include "castor/tools/chaos/workload_schedule.hpp"

#include "castor/tools/chaos/moments.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace castor::faults {

std::vector<DueAction> schedule_of(const Workload& workload, std::uint64_t seed,
                                   Timestamp duration) {
  std::vector<DueAction> result;
  std::map<std::string, std::size_t> alike;
  for (std::size_t i = 0; i < workload.statements.size(); ++i) {
    auto& statement = workload.statements[i];
    auto purpose = "workload " + to_string(statement);
    purpose += "#" + std::to_string(alike[purpose]++);
    std::uint64_t number = 0;
    for (auto t : moments_of(statement.trigger, seed, purpose, duration)) {
      SeededRandom random{seed, purpose, number++};
      result.push_back({t, random.one_of(statement.actions), i});
    }
  }
  std::ranges::stable_sort(result, {}, &DueAction::at);
  return result;
}

} // namespace castor::faults
