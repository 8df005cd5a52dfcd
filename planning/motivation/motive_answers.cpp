#include "castor/planning/motivation/motive_schedule.hpp"

#include <algorithm>

/// What the robot says of its motives.
namespace castor::planning {

std::string reason_of(const Motive& x) {
  if (!x.because.empty())
    return x.because;
  return x.asker.empty() ? "I am made so" : x.asker + " asked me to " + x.words;
}

std::string MotiveSchedule::answer(const MotiveQuestion& question) const {
  switch (question.kind) {
    case MotiveQuestionKind::doing:
      return doing();
    case MotiveQuestionKind::next:
      return next();
    case MotiveQuestionKind::why:
      return why(question.about);
    case MotiveQuestionKind::why_not:
      return why_not(question.about);
  }
  return {};
}

const Motive* MotiveSchedule::find(const std::string& about,
                                   const std::set<MotiveStatus>& statuses) const {
  const Motive* result = nullptr;
  for (const auto& [id, x] : motives_)
    if (statuses.contains(x.motive.status) &&
        (about.empty() || x.motive.words.find(about) != std::string::npos) &&
        (!result || result->history.back().time <= x.motive.history.back().time))
      result = &x.motive;
  return result;
}

std::string MotiveSchedule::doing() const {
  std::string result;
  for (const auto& [id, x] : motives_)
    if (is_pursued(x.motive))
      result += (result.empty() ? "I am about to " : ", and to ") + x.motive.words + ", because " +
                reason_of(x.motive);
  return result.empty() ? "I am doing nothing." : result + ".";
}

std::string MotiveSchedule::next() const {
  const Entry* first = nullptr;
  for (const auto& [id, x] : motives_)
    if (x.motive.status == MotiveStatus::queued && (!first || precedes(x, *first)))
      first = &x;
  return first
           ? "Then I will " + first->motive.words + ", because " + reason_of(first->motive) + "."
           : "I have nothing else to do.";
}

std::string MotiveSchedule::why(const std::string& about) const {
  const auto* x =
    find(about, {MotiveStatus::active, MotiveStatus::preempted, MotiveStatus::completed});
  return x ? "Because " + reason_of(*x) + "." : "I know of nothing like that that I did.";
}

std::string MotiveSchedule::why_not(const std::string& about) const {
  const auto* x = find(about, {MotiveStatus::rejected, MotiveStatus::dropped,
                               MotiveStatus::preempted, MotiveStatus::queued});
  if (!x)
    return "I know of nothing like that that I was to do.";
  const auto& why = x->history.back().why;
  if (x->status == MotiveStatus::queued)
    return why.empty() ? "I will " + x->words + " as soon as I can."
                       : "I will " + x->words + " later: " + why + ".";
  return "Because " + why + ".";
}

} // namespace castor::planning
