#pragma once

#include "castor/base/caf.hpp"

#include <caf/execution_unit.hpp>
#include <caf/resumable.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace castor {

/// Lets a component that is about to wait for an idle working memory of its own process run that
/// working memory itself, which saves waking a pool thread and then itself.
///
/// CAF hands an actor that just became ready to its sender's execution unit. This one keeps working
/// memories that became ready while an operation is being sent, and resumes them on the spot. A
/// busy working memory never gets here: the thread that runs it takes the message along. So a
/// working memory stays an ordinary actor with one mailbox, handling one message at a time.
class CallerRuns : public caf::execution_unit {
public:
  explicit CallerRuns(caf::actor_system& system) : execution_unit(&system) {}

  /// The working memories of this process, sorted; fixed before the first call of `run`.
  void set_working_memories(const std::vector<caf::resumable*>* sorted) { known_ = sorted; }

  /// Calls `send` and runs the actors that it made ready, and those that these made ready in turn.
  /// All of them have to be resumed here: nobody else would.
  template <class F>
  void run(F&& send) {
    keeping_ = true;
    send();
    for (std::size_t i = 0; i < kept_; ++i) {
      auto* job = jobs_[i];
      // Bounded, so that a crowd of other clients cannot keep this component's thread for good.
      if (job->resume(this, max_messages) == caf::resumable::resume_later)
        system().scheduler().enqueue(job);
      else
        caf::intrusive_ptr_release(job);
    }
    kept_ = 0;
    keeping_ = false;
  }

  void exec_later(caf::resumable* x) override {
    if (keeping_ && kept_ < jobs_.size() && is_working_memory(x))
      jobs_[kept_++] = x;
    else
      system().scheduler().enqueue(x);
  }

private:
  static constexpr std::size_t max_messages = 16;

  bool is_working_memory(caf::resumable* x) const;

  const std::vector<caf::resumable*>* known_ = nullptr;
  std::array<caf::resumable*, 8> jobs_{};
  std::size_t kept_ = 0;
  bool keeping_ = false;
};

} // namespace castor
