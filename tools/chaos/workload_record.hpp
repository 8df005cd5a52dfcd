#pragma once

#include "castor/tools/chaos/sentences.hpp"
#include "castor/tools/chaos/workload.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace castor::faults {

/// How often something was to be done, and what came of it.
struct WorkloadCounts {
  std::size_t due = 0;
  std::size_t done = 0;
  /// Of sentences.
  std::size_t said = 0;
  /// Sentences that were said once more, because the working memory had lost them.
  std::size_t said_again = 0;
  std::size_t answered = 0;
  std::size_t apologised = 0;
  std::size_t late = 0;
  std::size_t unanswered = 0;

  WorkloadCounts& operator+=(const WorkloadCounts& x);
};

/// What became of one statement of a workload.
struct StatementRecord {
  /// As in a workload.
  std::string statement;
  WorkloadCounts counts;
  /// Why something could not be done, at the last try that failed.
  std::string problem;
};

/// What became of a workload, in one run.
struct WorkloadRecord {
  std::string file;
  std::vector<StatementRecord> statements;
  /// For how long it was done.
  Timestamp took{0};
  /// How long answers took, sorted.
  std::vector<Timestamp> answer_times;

  WorkloadCounts total() const;
};

/// Counts what became of sentences for the statements that they come from.
void count_sentences(WorkloadRecord& record, const std::vector<Sentence>& sentences,
                     std::optional<Timestamp> within);

/// Lines of text about what was not done; empty if everything was.
std::string actions_missing(const WorkloadRecord& x);

/// "15 sentences, 14 answered, 1 apologised for (0.25 answers a second); 6 other actions"
std::string summary_of(const WorkloadRecord& x);

} // namespace castor::faults
