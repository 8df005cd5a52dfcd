#include "castor/tests/conformance/tester.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace castor::conformance {

using namespace std::chrono_literals;

// -- Test

void Test::pass() {
  tester_.pass(*this);
}

void Test::fail(const std::string& why) {
  tester_.fail(*this, why);
}

void Test::when(const ChangeFilter& filter, ChangeCallback handle) {
  tester_.on_change(filter, [this, handle = std::move(handle)](const ChangeEvent& event) {
    tester_.post(*this, [handle, event] { handle(event); });
  });
}

void Test::when_others(const ChangeFilter& filter, ChangeCallback handle) {
  when(filter, [this, handle = std::move(handle)](const ChangeEvent& event) {
    if (event.source != tester_.component_name())
      handle(event);
  });
}

// -- Tester

std::string Tester::home() const {
  return subarch_->empty() ? subarchitecture() : subarch_.get();
}

TestStruct Tester::made(Operation operation, const Address& address, std::int64_t count) const {
  return {count, {std::string{to_string(operation)}, component_name(), address}};
}

void Tester::configure() {
  auto problem = choose();
  if (problem.empty())
    return;
  // The other components would go on without this one, and there would never be a verdict.
  end_system(failed_status, problem);
  throw std::invalid_argument(problem);
}

std::string Tester::choose() {
  auto names = test_.get();
  if (names.empty() && offered_.size() == 1)
    names.push_back(offered_.begin()->first);
  std::string known;
  for (auto& [name, make] : offered_)
    known += (known.empty() ? "" : ", ") + name;
  if (names.empty())
    return "--test is missing; the tests are: " + known;
  for (auto& name : names) {
    auto i = offered_.find(name);
    if (i == offered_.end())
      return "there is no test " + name + "; the tests are: " + known;
    chosen_.push_back({name, i->second()});
  }
  return {};
}

void Tester::start() {
  for (auto& x : chosen_)
    x.test->start();
}

void Tester::run() {
  patience_ends_ = now() + patience_.get();
  for (auto& x : chosen_)
    attempt(x, [&] { x.test->run(); });
  while (!all_over()) {
    if (now() >= patience_ends_)
      give_up();
    else if (!jobs_.empty())
      work_off();
    else if (!wait_for_changes(patience_ends_ - now()) && !is_running())
      return;
  }
}

void Tester::work_off() {
  auto job = std::move(jobs_.front());
  jobs_.pop_front();
  if (!job.of->over)
    attempt(*job.of, job.work);
}

void Tester::attempt(Chosen& x, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& e) {
    fail(*x.test, e.what());
  }
}

void Tester::give_up() {
  for (auto& x : chosen_)
    if (auto awaited = x.test->awaited(); !x.over && !awaited.empty())
      fail(*x.test, "after " + patience_.text() + " it still waits for " + awaited);
  patience_ends_ = now() + 24h * 365;
}

bool Tester::all_over() const {
  return std::all_of(chosen_.begin(), chosen_.end(), [](auto& x) { return x.over; });
}

Tester::Chosen& Tester::chosen(const Test& test) {
  return *std::find_if(chosen_.begin(), chosen_.end(),
                       [&](auto& x) { return x.test.get() == &test; });
}

void Tester::pass(const Test& test) {
  auto& x = chosen(test);
  if (std::exchange(x.over, true))
    return;
  info("{} passed", x.name);
  if (all_over() && !failed_)
    end(passed_status, "all tests passed");
}

void Tester::fail(const Test& test, const std::string& why) {
  auto& x = chosen(test);
  if (std::exchange(x.over, true))
    return;
  failed_ = true;
  error("{} failed: {}", x.name, why);
  end(failed_status, x.name + " failed: " + why);
}

void Tester::end(int status, const std::string& reason) {
  if (exit_)
    end_system(status, reason);
}

void Tester::post(const Test& test, std::function<void()> job) {
  if (auto& x = chosen(test); !x.over)
    jobs_.push_back({&x, std::move(job)});
}

bool Tester::wait_until(const std::function<bool()>& condition, std::chrono::nanoseconds at_most) {
  auto until = now() + at_most;
  while (!condition() && now() < until)
    if (!wait_for_changes(until - now()) && !is_running())
      throw ComponentStopped{};
  return condition();
}

bool Tester::idle_for(std::chrono::nanoseconds duration) {
  return jobs_.empty() && !wait_for_changes(duration) && is_running();
}

void Tester::poll(const std::string& what, const std::function<bool()>& condition) {
  while (!condition()) {
    if (now() >= patience_ends_)
      throw std::runtime_error("after " + patience_.text() + " it still waits for " + what);
    if (!sleep_for(1ms))
      throw ComponentStopped{};
  }
}

} // namespace castor::conformance
