#include "castor/actors/runtime/pooled_shell.hpp"

#include <time.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace castor {

namespace {

/// Long enough for what it costs to begin a turn not to matter, short enough for those who wait.
constexpr std::chrono::milliseconds longest_turn{2};

/// CPU time of the calling thread since it last asked, which takes longer than many a callback:
/// what it has done between two turns counts for the second.
std::chrono::nanoseconds thread_cpu_since() {
  thread_local std::chrono::nanoseconds before{0};
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  auto now = std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
  return now - std::exchange(before, now);
}

} // namespace

void PooledShell::launch(caf::execution_unit*, bool, bool hide) {
  if (!hide)
    register_at_system();
  services_->pool->enter();
  services_->pool->schedule(*this);
}

bool PooledShell::deliver(std::optional<std::chrono::nanoseconds>, const std::function<bool()>&) {
  throw std::logic_error(identity().full_name() + " must not wait: as a CallbackComponent, it " +
                         "would keep the thread that it shares from others. Use every() or " +
                         "callbacks, or derive from UnmanagedComponent");
}

// -- turns

void PooledShell::run_turn() {
  context(unit_);
  thread_ = std::this_thread::get_id();
  CrashWatch::attribute(&code_.crash_note());
  if (!running_)
    running_.emplace(*record_);
  bool goes_on = work();
  record_->add_cpu(thread_cpu_since());
  if (!goes_on)
    record_->set_idle();
  CrashWatch::attribute(nullptr);
  thread_ = std::thread::id{};
  if (stage_ == Stage::ended)
    return end();
  if (!goes_on)
    set_alarms();
  // From then on another thread may run the next turn.
  if (goes_on || !mailbox().try_block())
    services_->pool->schedule(*this);
}

bool PooledShell::work() {
  // A run that is to be repeated must not depend on how fast the machine is.
  auto* clock = simulated_clock();
  const bool may_end = !clock || !clock->activity().is_one_at_a_time();
  // Counts from the end of its first piece of work: most turns have but one.
  Clock::time_point end{};
  auto is_over = [&] {
    auto now = Clock::now();
    if (end == Clock::time_point{})
      end = now + longest_turn;
    return now >= end;
  };
  if (stage_ == Stage::leaving) {
    leave();
    return false;
  }
  bool goes_on = true;
  bool lives = live([&] {
    while ((goes_on = live_on()) && !(may_end && is_over())) {
      // Until there is nothing to do, or others are to have the thread.
    }
  });
  if (lives)
    return goes_on;
  // The operations of a life that has ended.
  open_.clear();
  run_stop_hook();
  stage_ = Stage::leaving;
  leave();
  return false;
}

bool PooledShell::live_on() {
  file_arrived();
  if (life_.is_stopping())
    throw ComponentStopped{};
  faults_.at_runtime();
  if (life_.has_started())
    check_working_memory();
  if (!open_.is_empty())
    open_.expire(Clock::now());
  if (open_.has_done()) {
    call_back();
    return true;
  }
  if (!open_.is_empty())
    return false;
  return enter_phase() || work_in_phase();
}

bool PooledShell::enter_phase() {
  if (std::exchange(stage_, Stage::living) == Stage::starting) {
    record_->set_state(ComponentState::started);
    phase_done(Phase::start, {});
  } else if (life_.try_enter(Phase::configure)) {
    configure_component();
  } else if (life_.try_enter(Phase::start)) {
    stage_ = Stage::starting;
    start_component();
  } else if (life_.try_enter(Phase::run)) {
    run_component();
  } else {
    return false;
  }
  return true;
}

bool PooledShell::work_in_phase() {
  if (!life_.has_started())
    return false;
  commands_.work();
  run_timers();
  if (!open_.is_empty())
    return true;
  if (inbox_.is_empty())
    return false;
  handle_next();
  return true;
}

void PooledShell::call_back() {
  auto operation = open_.take_done();
  client_.settle(operation->id);
  code_.run(operation->what, operation->call_back);
}

// -- end

void PooledShell::leave() {
  file_arrived();
  open_.expire(Clock::now());
  while (open_.has_done() && record_->state() != ComponentState::failed)
    run_last_code([this] {
      call_back();
      file_arrived();
    });
  bool waits = !open_.is_empty() && record_->state() != ComponentState::failed &&
               !life_.is_working_memory_lost();
  if (waits)
    return;
  end_component(*running_);
  running_.reset();
  stage_ = Stage::ended;
}

void PooledShell::end() {
  if (simulated_key_)
    simulated_clock()->forget(*std::exchange(simulated_key_, std::nullopt));
  auto pool = services_->pool;
  cleanup(record_->state() == ComponentState::failed
            ? caf::make_error(caf::sec::runtime_error, record_->failure())
            : caf::error{},
          context());
  pool->leave();
}

// -- alarms

void PooledShell::set_alarms() {
  auto work = open_.is_empty() ? std::min(commands_.next_alarm(), timers_.next()) : no_alarm;
  auto deadline = open_.next_deadline();
  if (simulated_clock()) {
    set_simulated_alarm(work);
    set_alarm(deadline);
  } else {
    set_alarm(std::min(work, deadline));
  }
}

void PooledShell::set_alarm(Clock::time_point time) {
  if (time == no_alarm && alarm_ == no_alarm)
    return;
  // One that is earlier does no harm: it is set again then.
  if (alarm_ <= Clock::now())
    alarm_ = no_alarm;
  if (time >= alarm_)
    return;
  alarm_ = time;
  services_->pool->wake_at(time, handle(), wake_up_call());
}

void PooledShell::set_simulated_alarm(Clock::time_point time) {
  if (time == simulated_alarm_ && simulated_key_)
    return;
  if (simulated_key_)
    simulated_clock()->forget(*std::exchange(simulated_key_, std::nullopt));
  simulated_alarm_ = time;
  if (time != no_alarm)
    simulated_key_ = wake_at(context_.since_start(time));
}

} // namespace castor
