#include "castor/actors/link/kept_contents.hpp"

#include "castor/actors/link/link_error.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace castor {

// -- the sending end

bool SentContents::Mentions::are_ready() const {
  return std::ranges::all_of(referred, [](auto& x) { return x->is_written; });
}

SentContents::ContentPtr SentContents::find(const Value& x, Mentions& mentions) {
  auto i = by_value_.find(x.weak());
  if (i == by_value_.end())
    return nullptr;
  by_use_.splice(by_use_.end(), by_use_, i->second);
  auto& result = *i->second;
  if (std::ranges::find(mentions.carried, result) == mentions.carried.end()) {
    ++result->messages;
    mentions.referred.push_back(result);
  }
  return result;
}

SentContents::ContentPtr SentContents::add(const Value& x, std::size_t bytes, Mentions& mentions) {
  auto cost = bytes + content_overhead;
  if (cost > limit_)
    return nullptr;
  sweep();
  make_room(cost);
  // Until the peer has heard what it need not keep, it may have as much again.
  if (kept_ + cost > limit_ || kept_ + leaving_ + cost > 2 * limit_)
    return nullptr;
  auto result = std::make_shared<Content>(Content{++last_number_, cost, x.weak(), 1});
  kept_ += cost;
  by_value_.emplace(result->value, by_use_.insert(by_use_.end(), result));
  mentions.carried.push_back(result);
  return result;
}

void SentContents::take_forgotten(Mentions& mentions) {
  mentions.forgotten = std::exchange(forgotten_, {});
}

void SentContents::written(const Mentions& mentions) {
  for (auto& x : mentions.carried) {
    x->is_written = true;
    --x->messages;
  }
  for (auto& x : mentions.referred)
    --x->messages;
  for (auto& x : mentions.forgotten)
    leaving_ -= x->cost;
}

void SentContents::make_room(std::size_t cost) {
  for (auto i = by_use_.begin(); i != by_use_.end() && kept_ + cost > limit_;)
    i = (*i)->messages == 0 ? forget(i) : std::next(i);
}

void SentContents::sweep() {
  if (by_use_.size() < sweep_at_)
    return;
  for (auto i = by_use_.begin(); i != by_use_.end();)
    i = (*i)->messages == 0 && (*i)->value.expired() ? forget(i) : std::next(i);
  sweep_at_ = std::max<std::size_t>(4, 2 * by_use_.size());
}

SentContents::ByUse::iterator SentContents::forget(ByUse::iterator x) {
  auto& content = *x;
  by_value_.erase(content->value);
  kept_ -= content->cost;
  leaving_ += content->cost;
  forgotten_.push_back(content);
  return by_use_.erase(x);
}

// -- the receiving end

void ReceivedContents::add(ContentNumber number, ReceivedContentPtr content) {
  kept_ += content->bytes().size() + content_overhead;
  if (kept_ > 2 * limit_)
    throw LinkError("contents to keep of more than " + std::to_string(2 * limit_) + " bytes");
  if (!contents_.emplace(number, std::move(content)).second)
    throw LinkError("two contents to keep have the same number");
}

const ReceivedContentPtr& ReceivedContents::find(ContentNumber number) const {
  auto i = contents_.find(number);
  if (i == contents_.end())
    throw LinkError("a message refers to a content that is not kept");
  return i->second;
}

void ReceivedContents::forget(ContentNumber number) {
  kept_ -= find(number)->bytes().size() + content_overhead;
  contents_.erase(number);
}

} // namespace castor
