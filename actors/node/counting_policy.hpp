#pragma once

#include "castor/actors/node/counting_config.hpp"

#include <caf/policy/unprofiled.hpp>
#include <caf/resumable.hpp>
#include <caf/scheduler/abstract_coordinator.hpp>

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>

namespace castor {

/// Policy of CAF's scheduler like its work sharing: one queue for all workers. An actor that is in
/// the queue, or runs, holds a token of the process's activity.
class CountingPolicy : public caf::policy::unprofiled {
public:
  struct Job {
    caf::resumable* actor = nullptr;
    Activity::Turn turn = 0;
  };

  struct coordinator_data {
    explicit coordinator_data(caf::scheduler::abstract_coordinator* x)
      : activity(activity_of(x->system())) {}

    const std::shared_ptr<Activity> activity;
    std::deque<Job> queue;
    std::mutex lock;
    std::condition_variable cv;
  };

  struct worker_data {
    explicit worker_data(caf::scheduler::abstract_coordinator*) {}

    /// Of the actor that runs; 0 if none does.
    Activity::Turn turn = 0;
  };

  template <class Coordinator>
  void central_enqueue(Coordinator* self, caf::resumable* actor) {
    auto& data = d(self);
    std::lock_guard guard{data.lock};
    data.queue.push_back({actor, data.activity->begin()});
    data.cv.notify_one();
  }

  template <class Worker>
  void external_enqueue(Worker* self, caf::resumable* actor) {
    central_enqueue(self->parent(), actor);
  }

  template <class Worker>
  void internal_enqueue(Worker* self, caf::resumable* actor) {
    central_enqueue(self->parent(), actor);
  }

  template <class Worker>
  void resume_job_later(Worker* self, caf::resumable* actor) {
    central_enqueue(self->parent(), actor);
  }

  template <class Worker>
  caf::resumable* dequeue(Worker* self) {
    // Only here, since an actor that is to be resumed later is in the queue again by now.
    end_turn(self);
    auto& data = d(self->parent());
    Job job;
    {
      std::unique_lock guard{data.lock};
      data.cv.wait(guard, [&] { return !data.queue.empty(); });
      job = data.queue.front();
      data.queue.pop_front();
    }
    d(self).turn = job.turn;
    data.activity->await(job.turn);
    return job.actor;
  }

  template <class Worker>
  void before_shutdown(Worker* self) {
    end_turn(self);
  }

  template <class Worker, class F>
  void foreach_resumable(Worker*, F) {}

  template <class Coordinator, class F>
  void foreach_central_resumable(Coordinator* self, F f) {
    for (auto& job : d(self).queue)
      f(job.actor);
    d(self).queue.clear();
  }

private:
  template <class Worker>
  void end_turn(Worker* self) {
    if (auto turn = std::exchange(d(self).turn, 0))
      d(self->parent()).activity->end(turn);
  }
};

} // namespace castor
