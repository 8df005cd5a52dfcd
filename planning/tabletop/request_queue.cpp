#include "castor/planning/tabletop/request_queue.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

void RequestQueue::recall(RequestedSteps x, bool is_motive_there) {
  steps_ = std::move(x);
  if (is_busy() && !is_motive_there) {
    steps_.waiting.insert(steps_.waiting.begin(), steps_.current);
    steps_.motive = {};
  }
}

void RequestQueue::drop_steps_of(const Address& move) {
  std::erase_if(steps_.waiting, [&](const RequestedStep& x) { return x.move.address == move; });
}

Address RequestQueue::add(const std::vector<RequestedStep>& steps,
                          const communication::MoveReferents& said) {
  auto& waiting = steps_.waiting;
  Address unwanted;
  if (said.corrects && !waiting.empty()) {
    const auto last = waiting.back().move.address;
    drop_steps_of(last);
    if (is_busy() && steps_.current.move.address == last)
      unwanted = std::exchange(steps_.motive, {});
  } else if (said.corrects && is_busy()) {
    unwanted = std::exchange(steps_.motive, {});
  }
  if (!said.comes_first) {
    waiting.insert(waiting.end(), steps.begin(), steps.end());
    return unwanted;
  }
  if (is_busy()) {
    unwanted = std::exchange(steps_.motive, {});
    waiting.insert(waiting.begin(), steps_.current);
  } else if (waiting.empty()) {
    waiting = std::exchange(steps_.given_up, {});
  }
  waiting.insert(waiting.begin(), steps.begin(), steps.end());
  return unwanted;
}

Address RequestQueue::stop() {
  auto motive = std::exchange(steps_.motive, {});
  std::vector<RequestedStep> stopped;
  if (!motive.id.empty())
    stopped.push_back(steps_.current);
  stopped.insert(stopped.end(), steps_.waiting.begin(), steps_.waiting.end());
  // "Stop! Stop!"
  if (stopped.empty())
    stopped = std::move(steps_.stopped);
  steps_ = {};
  steps_.stopped = std::move(stopped);
  return motive;
}

bool RequestQueue::go_on() {
  if (!is_busy() && steps_.waiting.empty())
    steps_.waiting = std::exchange(steps_.stopped, {});
  return is_busy() || !steps_.waiting.empty();
}

const RequestedStep* RequestQueue::next() {
  if (is_busy() || steps_.waiting.empty())
    return nullptr;
  steps_.current = std::move(steps_.waiting.front());
  steps_.waiting.erase(steps_.waiting.begin());
  return &steps_.current;
}

void RequestQueue::begin(const Address& motive, std::string result) {
  steps_.motive = motive;
  steps_.result = std::move(result);
  steps_.given_up.clear();
  steps_.stopped.clear();
}

void RequestQueue::done() {
  steps_.motive = {};
}

void RequestQueue::give_up() {
  const auto& move = steps_.current.move.address;
  steps_.motive = {};
  steps_.given_up = {steps_.current};
  for (const auto& x : steps_.waiting)
    if (x.move.address == move)
      steps_.given_up.push_back(x);
  drop_steps_of(move);
}

} // namespace castor::planning
