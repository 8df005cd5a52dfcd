#include "castor/planning/motivation/failure_words.hpp"
#include "castor/planning/motivation/motive_schedule.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

/// What the robot says of its motives.
namespace castor::planning {

namespace {

std::vector<std::string> words_in(const std::string& text, char between) {
  std::vector<std::string> result;
  std::istringstream in{text};
  for (std::string part; std::getline(in, part, between);)
    if (!part.empty())
      result.push_back(part);
  return result;
}

/// Whether it has all words that a question is about.
bool is_meant(const Motive& x, const std::string& about) {
  const auto words = words_in(x.words, ' ');
  return std::ranges::all_of(words_in(about, ' '), [&](const std::string& wanted) {
    return std::ranges::any_of(words_in(wanted, '|'), [&](const std::string& word) {
      return std::ranges::any_of(words, [&](const std::string& said) {
        return said == word || said == word + ',' || said == word + 's';
      });
    });
  });
}

} // namespace

std::string reason_of(const Motive& x) {
  if (!x.because.empty())
    return x.because;
  return x.asker.empty() ? "I am made so" : x.asker + " asked me to " + x.words;
}

std::string MotiveSchedule::answer(const MotiveQuestion& question,
                                   const std::vector<std::string>& waiting) const {
  switch (question.kind) {
    case MotiveQuestionKind::doing:
      return doing();
    case MotiveQuestionKind::next:
      return next(waiting);
    case MotiveQuestionKind::why:
      return why(question.about);
    case MotiveQuestionKind::why_not:
      return why_not(question.about);
    case MotiveQuestionKind::done:
      return done(question.about);
    case MotiveQuestionKind::whether:
      return whether(question.about);
  }
  return {};
}

const Motive* MotiveSchedule::find(const std::string& about,
                                   const std::set<MotiveStatus>& statuses) const {
  const Motive* result = nullptr;
  for (const auto& [id, x] : motives_)
    if (statuses.contains(x.motive.status) && is_meant(x.motive, about) &&
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

std::string MotiveSchedule::next(const std::vector<std::string>& waiting) const {
  const Entry* first = nullptr;
  for (const auto& [id, x] : motives_)
    if (x.motive.status == MotiveStatus::queued && (!first || precedes(x, *first)))
      first = &x;
  if (!first && !waiting.empty())
    return "Then I will do something else, because " + waiting.front() + ".";
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
  const auto why = failure_in_words(x->history.back().why);
  if (x->status == MotiveStatus::queued)
    return why.empty() ? "I will " + x->words + " as soon as I can."
                       : "I will " + x->words + " later: " + why + ".";
  return "Because " + why + ".";
}

std::string MotiveSchedule::done(const std::string& about) const {
  const auto* x =
    find(about, {MotiveStatus::completed, MotiveStatus::rejected, MotiveStatus::dropped});
  if (!x)
    return about.empty() ? "I have done nothing yet." : "I know of nothing like that that I did.";
  const auto why = failure_in_words(x->history.back().why);
  return x->status == MotiveStatus::completed
           ? "The last thing that I did was to " + x->words + ", because " + reason_of(*x) + "."
           : "I was to " + x->words + ", but did not: " + why + ".";
}

std::string MotiveSchedule::whether(const std::string& about) const {
  const auto* x = find(about, {MotiveStatus::proposed, MotiveStatus::queued, MotiveStatus::active,
                               MotiveStatus::preempted});
  if (x)
    return is_pursued(*x) ? "Not yet: I am about to " + x->words + "."
                          : "Not yet: I will " + x->words + " later.";
  x = find(about, {MotiveStatus::completed, MotiveStatus::rejected, MotiveStatus::dropped});
  if (!x)
    return about.empty() ? "I have nothing to do."
                         : "I know of nothing like that that I was to do.";
  return x->status == MotiveStatus::completed
           ? "I was to " + x->words + ", and that is done."
           : "No: I was to " + x->words + ", but " + failure_in_words(x->history.back().why) + ".";
}

} // namespace castor::planning
