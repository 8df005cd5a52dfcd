#pragma once

#include "castor/planning/tabletop/types.hpp"

#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

/// The steps that people have asked for, one of which is done at a time: what comes next, and what
/// becomes of the others when one fails, is corrected, or has to wait for another.
class RequestQueue {
public:
  /// For a successor.
  const RequestedSteps& steps() const { return steps_; }
  /// What a predecessor knew. A step whose motive is not there any more is begun anew.
  void recall(RequestedSteps x, bool is_motive_there);

  /// The steps of a request, by what it says of the ones before:
  /// - they follow them;
  /// - `comes_first`: the step that is done, or the request that was given up last, comes after;
  /// - `corrects`: they take the place of the last request that is not done yet, if there is one.
  ///   If another thing was taken, or put there, it is put back first.
  /// What is about to be put back is not put back twice.
  /// \returns the motive that is not wanted now; without an id for none
  Address add(std::vector<RequestedStep> steps, const communication::MoveReferents& said);

  /// Nothing is done any more, unless `go_on`. \returns the motive that is not wanted any more;
  /// without an id for none
  Address stop();
  /// The arm is to wait until `resume`, or `stop`.
  void pause() { steps_.is_paused = true; }
  /// \returns whether it was to wait
  bool resume() { return std::exchange(steps_.is_paused, false); }
  /// What was stopped, and nothing was asked for since, is done after all.
  /// \returns whether there is anything to do
  bool go_on();

  /// Whether a step is done now.
  bool is_busy() const { return !steps_.motive.id.empty(); }
  /// Whether a step of that move is done now, or waits.
  bool has_steps_of(const Address& move) const;
  /// The next step, which is the current one from then on; null if a step is done now or there is
  /// none.
  const RequestedStep* next();
  /// The current step has a motive. @param result what to say when it is done
  /// @param chosen proxies of the things with which it is done
  void begin(const Address& motive, std::string result, std::vector<std::string> chosen = {});
  /// The current step is done; `next` has the one after it.
  /// @param was_so whether nothing had to be done for it
  void done(bool was_so = false);
  /// The current step has failed. Of "one of the balls" another one is next, if there is one; where
  /// several things are put somewhere and some are there, the others are tried once more, as things
  /// are now. \returns whether it is tried again
  bool try_again(bool has_begun);
  /// The current step cannot be done: nor are those of its request after it that depend on it, by
  /// what they are about.
  /// @param undoes whether what was done of it is undone next
  /// \returns whether there are such steps
  bool give_up(bool undoes = false);

private:
  bool moved_other_than(const RequestedStep& step) const;
  RequestedStep put_back_before(const RequestedStep& step) const;
  void resolve_there(RequestedStep& step) const;
  Address drop_last();
  void drop_steps_of(const Address& move);

  RequestedSteps steps_;
};

/// Without the steps that the next one includes: moving a thing off its place before it is taken or
/// given, "take the cube off the table and give it to me", and taking it before it is put
/// somewhere, so that it is grasped as is best for that place.
std::vector<RequestedStep> without_needless_moves(std::vector<RequestedStep> steps);

} // namespace castor::planning
