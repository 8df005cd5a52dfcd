#include "castor/tools/chaos/sentences.hpp"

#include "castor/base/text.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <algorithm>

namespace castor::faults {

std::optional<Timestamp> Sentence::answer_time() const {
  return said && answered ? std::optional{*answered - *said} : std::nullopt;
}

std::size_t Sentences::add(std::string text, std::size_t statement) {
  auto place = sentences_.size();
  // No id is that of an utterance of an UtteranceSource.
  sentences_.push_back(
    {"workload:sentence " + std::to_string(place + 1), std::move(text), statement});
  return place;
}

void Sentences::said(std::size_t place, Timestamp at) {
  auto& x = sentences_.at(place);
  // An answer may be seen before whoever said it is told that it was said.
  if (x.is_answered)
    return;
  x.said = at;
  ++x.times_said;
}

void Sentences::answer(std::string_view utterance, bool apologises, std::optional<Timestamp> at) {
  auto x = std::ranges::find_if(sentences_, [&](auto& y) { return y.id == utterance; });
  if (x == sentences_.end() || x->is_answered)
    return;
  x->is_answered = true;
  x->apologised = apologises;
  x->answered = at;
  // An answer proves that it was said, even if whoever said it was not told.
  if (!x->said) {
    x->said = at.value_or(Timestamp{0});
    x->times_said = 1;
  }
}

std::vector<std::size_t> Sentences::unanswered() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < sentences_.size(); ++i)
    if (sentences_[i].said && !sentences_[i].is_answered)
      result.push_back(i);
  return result;
}

std::string answers_missing(const std::vector<Sentence>& sentences,
                            std::optional<Timestamp> within) {
  std::string result;
  for (auto& x : sentences) {
    if (!x.said)
      continue;
    auto what = in_quotes(x.text) + ", said at " + rounded(*x.said);
    if (!x.is_answered)
      result += what + ", was not answered\n";
    else if (auto time = x.answer_time(); time && within && *time > *within)
      result +=
        what + ", was answered after " + rounded(*time) + ", not within " + rounded(*within) + '\n';
  }
  return result;
}

} // namespace castor::faults
