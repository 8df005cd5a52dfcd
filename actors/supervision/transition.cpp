#include "castor/actors/supervision/transition.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

Transition::Transition(std::uint64_t id, TransitionRequest request, TimePoint now)
  : id_(id), request_(std::move(request)), since_(now) {
  std::reverse(request_.stop.begin(), request_.stop.end());
}

bool Transition::involves(const std::string& name) const {
  return contains(stop(), name) || contains(start(), name);
}

bool Transition::overlaps(const Transition& other) const {
  auto involved = [&](auto& name) { return other.involves(name); };
  return std::any_of(stop().begin(), stop().end(), involved) ||
         std::any_of(start().begin(), start().end(), involved);
}

bool Transition::includes(const Transition& other) const {
  auto involved = [&](auto& name) { return involves(name); };
  return std::all_of(other.stop().begin(), other.stop().end(), involved) &&
         std::all_of(other.start().begin(), other.start().end(), involved);
}

const Transition::Names& Transition::order() const {
  switch (step_) {
    case Step::stop:
      return stop();
    case Step::configure:
      return configure_;
    default:
      return start();
  }
}

const std::string* Transition::current() const {
  return at_ < order().size() ? &order()[at_] : nullptr;
}

void Transition::enter(Step step, TimePoint now) {
  step_ = step;
  at_ = 0;
  commanded_ = false;
  ++turn_;
  since_ = now;
}

void Transition::enter_configure(TimePoint now,
                                 const std::function<bool(const std::string&)>& is_last) {
  enter(Step::configure, now);
  withdraw({withdrawn_.begin(), withdrawn_.end()});
  configure_ = start();
  std::stable_partition(configure_.begin(), configure_.end(), [&](auto& x) { return !is_last(x); });
}

void Transition::next(TimePoint now) {
  ++at_;
  ++turn_;
  commanded_ = false;
  since_ = now;
}

void Transition::withdraw(const Names& names) {
  if (step_ == Step::make) {
    withdrawn_.insert(names.begin(), names.end());
    return;
  }
  auto is_withdrawn = [&](auto& name) { return contains(names, name); };
  if (leads_through_phases()) {
    auto& present = order();
    auto now = present.begin() + static_cast<std::ptrdiff_t>(std::min(at_, present.size()));
    auto earlier = std::count_if(present.begin(), now, is_withdrawn);
    if (now != present.end() && is_withdrawn(*now)) {
      commanded_ = false;
      ++turn_;
    }
    at_ -= static_cast<std::size_t>(earlier);
  }
  // What was to be stopped for this transition has been.
  if (step_ != Step::stop)
    request_.stop.clear();
  std::erase_if(request_.start, is_withdrawn);
  std::erase_if(configure_, is_withdrawn);
}

void Transition::do_not_start(const std::string& name) {
  std::erase(request_.start, name);
}

bool Transition::has_failed(const std::string& name, std::uint64_t incarnation) const {
  return std::any_of(failures_.begin(), failures_.end(),
                     [&](auto& x) { return x.name == name && x.incarnation == incarnation; });
}

void Transition::report_done() const {
  if (request_.done)
    request_.done(result_);
}

} // namespace castor
