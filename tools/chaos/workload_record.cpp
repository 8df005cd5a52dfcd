#include "castor/tools/chaos/workload_record.hpp"

#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace castor::faults {

WorkloadCounts& WorkloadCounts::operator+=(const WorkloadCounts& x) {
  due += x.due;
  done += x.done;
  said += x.said;
  said_again += x.said_again;
  answered += x.answered;
  apologised += x.apologised;
  late += x.late;
  unanswered += x.unanswered;
  return *this;
}

WorkloadCounts WorkloadRecord::total() const {
  WorkloadCounts result;
  for (auto& x : statements)
    result += x.counts;
  return result;
}

void count_sentences(WorkloadRecord& record, const std::vector<Sentence>& sentences,
                     std::optional<Timestamp> within) {
  for (auto& x : sentences) {
    if (!x.said)
      continue;
    auto& counts = record.statements.at(x.statement).counts;
    ++counts.said;
    counts.said_again += static_cast<std::size_t>(std::max(x.times_said - 1, 0));
    ++(!x.is_answered ? counts.unanswered : x.apologised ? counts.apologised : counts.answered);
    if (auto time = x.answer_time()) {
      record.answer_times.push_back(*time);
      if (within && *time > *within)
        ++counts.late;
    }
  }
  std::ranges::sort(record.answer_times);
}

std::string actions_missing(const WorkloadRecord& x) {
  std::string result;
  for (auto& statement : x.statements)
    if (auto missing = statement.counts.due - statement.counts.done; missing > 0)
      result +=
        fmt::format("{} of {} were not done: {}{}\n", missing, statement.counts.due,
                    statement.statement, statement.problem.empty() ? "" : ": " + statement.problem);
  return result;
}

std::string summary_of(const WorkloadRecord& x) {
  auto total = x.total();
  std::string result;
  if (total.said > 0) {
    result =
      fmt::format("{}, {} answered, {} apologised for",
                  counted(total.said, "sentence", "sentences"), total.answered, total.apologised);
    auto seconds = std::max(std::chrono::duration<double>{x.took}.count(), 1e-3);
    result += fmt::format(" ({:.2g} answers a second)",
                          static_cast<double>(total.answered + total.apologised) / seconds);
    if (total.unanswered > 0)
      result += fmt::format(", {} not answered", total.unanswered);
    if (total.late > 0)
      result += fmt::format(", {} late", total.late);
    if (total.said_again > 0)
      result += fmt::format(", {} said again", total.said_again);
  }
  if (auto others = total.done - total.said; others > 0 || total.said == 0)
    result += (result.empty() ? "" : "; ") + counted(others, "other action", "other actions");
  if (total.done < total.due)
    result += fmt::format("; {} not done", total.due - total.done);
  return result;
}

} // namespace castor::faults
