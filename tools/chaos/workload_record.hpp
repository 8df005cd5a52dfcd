#pragma once

#include "castor/tools/chaos/sentences.hpp"
#include "castor/tools/chaos/workload.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace castor::faults {

/// Numbers of actions that were due and done, and of their results.
struct WorkloadCounts {
  std::size_t due = 0;
  std::size_t done = 0;
  /// Of sentences.
  std::size_t said = 0;
  /// Sentences that were repeated because the working memory had lost them.
  std::size_t said_again = 0;
  std::size_t answered = 0;
  std::size_t apologised = 0;
  std::size_t late = 0;
  std::size_t unanswered = 0;

  WorkloadCounts& operator+=(const WorkloadCounts& x);
};

/// Results of one statement of a workload.
struct StatementRecord {
  /// In the syntax of workloads.
  std::string statement;
  WorkloadCounts counts;
  /// Reason for the last failed attempt.
  std::string problem;
};

/// Results of a workload in one run.
struct WorkloadRecord {
  std::string file;
  std::vector<StatementRecord> statements;
  /// How long the workload ran.
  Timestamp took{0};
  /// Times to the answers, sorted.
  std::vector<Timestamp> answer_times;

  WorkloadCounts total() const;
};

/// Adds the results of sentences to the counts of their statements.
void count_sentences(WorkloadRecord& record, const std::vector<Sentence>& sentences,
                     std::optional<Timestamp> within);

/// One line for each statement with actions that were not done; empty if all were.
std::string actions_missing(const WorkloadRecord& x);

/// "15 sentences, 14 answered, 1 apologised for (0.25 answers a second); 6 other actions"
std::string summary_of(const WorkloadRecord& x);

} // namespace castor::faults
