#include "castor/benchmarks/performance/shared_page.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace castor::benchmark {

using namespace std::chrono_literals;

SharedPage::File::File() : path_("/dev/shm/castor-page-XXXXXX") {
  auto descriptor = mkstemp(path_.data());
  if (descriptor < 0 || ftruncate(descriptor, sizeof(Content)) != 0)
    throw std::runtime_error("cannot make a file in /dev/shm");
  close(descriptor);
}

SharedPage::File::~File() {
  unlink(path_.c_str());
}

SharedPage::SharedPage(const std::string& path) {
  auto descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  auto memory = mmap(nullptr, sizeof(Content), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (descriptor < 0 || memory == MAP_FAILED)
    throw std::runtime_error("cannot map " + path);
  close(descriptor);
  // A new file is full of zeros.
  content_ = static_cast<Content*>(memory);
}

SharedPage::~SharedPage() {
  munmap(content_, sizeof(Content));
}

void SharedPage::hear() {
  content_->time = Clock::now().time_since_epoch().count();
  ++content_->count;
}

Clock::time_point SharedPage::await_heard(std::int64_t count) const {
  auto deadline = Clock::now() + 10s;
  while (content_->count < count) {
    std::this_thread::sleep_for(20us);
    if (Clock::now() > deadline)
      throw std::runtime_error("a change was not heard in ten seconds");
  }
  return Clock::time_point{Clock::duration{content_->time.load()}};
}

std::vector<double> measure_hearing(const SharedPage& page, std::chrono::duration<double> duration,
                                    const std::function<void()>& tell,
                                    const std::function<void(std::chrono::nanoseconds)>& pause) {
  constexpr std::int64_t least = 100;
  std::vector<double> microseconds;
  auto until = Clock::now() + duration;
  for (std::int64_t told = 1; told <= least || Clock::now() < until; ++told) {
    pause(300us);
    auto begin = Clock::now();
    tell();
    microseconds.push_back(
      std::chrono::duration<double, std::micro>(page.await_heard(told) - begin).count());
  }
  return microseconds;
}

} // namespace castor::benchmark
