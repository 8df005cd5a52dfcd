#include "castor/actors/runtime/push_recorder.hpp"

#include "castor/base/log.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace castor {

namespace {

/// What may wait for the disk; what comes then is lost.
constexpr std::size_t most_waiting_bytes = std::size_t{128} << 20;

} // namespace

PushRecorder::PushRecorder(std::filesystem::path folder, std::uint64_t limit_bytes)
  : folder_(std::move(folder)), limit_bytes_(limit_bytes), thread_([this] { work(); }) {}

PushRecorder::~PushRecorder() {
  {
    std::lock_guard guard{mutex_};
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PushRecorder::record(const std::string& provider, bool pushed, const Value& x) {
  auto size = x.encoded_size();
  std::lock_guard guard{mutex_};
  if (waiting_bytes_ + size > most_waiting_bytes && !waiting_.empty()) {
    ++lost_[provider];
    return;
  }
  waiting_.push_back({provider, {unix_now(), pushed, x}});
  waiting_bytes_ += size;
  changed_.notify_all();
}

void PushRecorder::work() {
  for (bool is_over = false; !is_over;) {
    std::deque<Waiting> batch;
    std::map<std::string, std::uint64_t> lost;
    {
      std::unique_lock guard{mutex_};
      changed_.wait(guard, [this] { return ending_ || !waiting_.empty(); });
      batch = std::exchange(waiting_, {});
      lost = std::exchange(lost_, {});
      waiting_bytes_ = 0;
      is_over = ending_;
    }
    try {
      write(batch, lost);
    } catch (const std::exception& e) {
      log_runtime(LogLevel::error, "cannot record what stand-alone components hand out in " +
                                     folder_.string() + ": " + e.what() +
                                     "; nothing more of it is recorded");
      std::unique_lock guard{mutex_};
      changed_.wait(guard, [this] {
        waiting_.clear();
        waiting_bytes_ = 0;
        return ending_;
      });
      return;
    }
  }
}

void PushRecorder::write(const std::deque<Waiting>& batch,
                         const std::map<std::string, std::uint64_t>& lost) {
  for (auto& x : batch)
    log_of(x.provider);
  for (auto& [provider, count] : lost)
    log_of(provider);
  for (auto& [provider, log] : logs_)
    log.begin();
  for (auto& x : batch) {
    log_of(x.provider).append(x.push);
    keep_limit();
  }
  for (auto& [provider, count] : lost)
    log_of(provider).count_lost(count);
  for (auto& [provider, log] : logs_)
    log.commit();
}

PushLogWriter& PushRecorder::log_of(const std::string& provider) {
  return logs_.try_emplace(provider, folder_ / (provider + push_log_extension), provider)
    .first->second;
}

void PushRecorder::keep_limit() {
  auto too_much = [this] {
    std::uint64_t bytes = 0;
    for (auto& [provider, log] : logs_)
      bytes += log.bytes();
    return bytes > limit_bytes_;
  };
  while (too_much()) {
    PushLogWriter* oldest = nullptr;
    for (auto& [provider, log] : logs_)
      // The newest of each is kept, however large it is.
      if (log.size() > 1 && (!oldest || log.oldest() < oldest->oldest()))
        oldest = &log;
    if (!oldest)
      return;
    oldest->drop_oldest();
  }
}

} // namespace castor
