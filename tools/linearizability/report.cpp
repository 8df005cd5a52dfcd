#include "castor/tools/linearizability/report.hpp"

#include <algorithm>
#include <vector>

namespace castor::linearizability {

namespace {

std::string indented(const std::string& line) {
  return "    " + line + "\n";
}

std::string describe(const EntryState& x) {
  std::string result = x.presence == EntryState::Presence::never_existed ? "never existed"
                       : x.present() ? "version " + std::to_string(x.version) + ", content " +
                                         std::to_string(x.content)
                                     : "deleted at version " + std::to_string(x.version);
  if (x.leased())
    result += ", leased at level " + to_string(x.level()) + " to client " +
              std::to_string(x.holder) + ", token " +
              (x.token_known ? std::to_string(x.token) : "unknown");
  return result;
}

std::string outcome(const OperationRecord& operation, const std::optional<Result>& answer) {
  return answer ? to_string(operation.kind, *answer) : "waits";
}

} // namespace

std::string report(std::span<const OperationRecord> operations, std::span<const Placement> order) {
  EntryModel model{operations};
  EntryState state;
  std::vector<bool> placed(operations.size());
  std::vector<SettledWait> settled;
  std::string result =
    "  placed " + std::to_string(order.size()) + " of " + std::to_string(operations.size()) + ":\n";
  for (auto [x, left_out] : order) {
    placed[x] = true;
    settled.clear();
    if (left_out) {
      result += indented(to_string(operations[x]) + ", left out");
      continue;
    }
    auto answer = model.arrive(state, x, settled);
    bool gives_up = !answer && operations[x].result.status == Status::timed_out;
    if (gives_up)
      model.give_up(state, x);
    result += indented(to_string(operations[x]) + (answer || gives_up ? "" : ", waits"));
    for (auto& wait : settled)
      result += indented("  served: " + to_string(operations[wait.operation]));
  }
  result += "  then it stands at: " + describe(state) + "\n";

  // What can come next was invoked before anything that is still open returned.
  Tick bound = never;
  for (std::size_t i = 0; i < state.waiting; ++i)
    bound = std::min(bound, operations[state.queue[i]].returned);
  for (OperationIndex x = 0; x < operations.size(); ++x)
    if (!placed[x])
      bound = std::min(bound, operations[x].arrived_by());
  result += "  waiting:\n";
  for (std::size_t i = 0; i < state.waiting; ++i)
    result += indented(to_string(operations[state.queue[i]]));
  result += "  none of these can come next:\n";
  for (OperationIndex x = 0; x < operations.size(); ++x) {
    if (placed[x] || operations[x].invoked > bound)
      continue;
    auto next = state;
    result += indented(to_string(operations[x]));
    settled.clear();
    if (operations[x].kind != OperationKind::lapse && operations[x].kind != OperationKind::loss)
      result += indented("  now: " + outcome(operations[x], model.arrive(next, x, settled)));
    for (auto& wait : settled)
      result += indented("  would give " + outcome(operations[wait.operation], wait.result) +
                         " to: " + to_string(operations[wait.operation]));
  }
  return result;
}

} // namespace castor::linearizability
