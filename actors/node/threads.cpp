#include "castor/actors/node/threads.hpp"

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace castor {

std::string why_no_threads(std::size_t count) {
  std::string result;
  std::latch all_made{1};
  std::vector<std::thread> threads;
  threads.reserve(count);
  try {
    while (threads.size() < count)
      threads.emplace_back([&] { all_made.wait(); });
  } catch (const std::system_error& e) {
    result = "this process needs " + std::to_string(count) + " further threads, and may have " +
             std::to_string(threads.size()) + " (" + e.code().message() +
             "): raise `ulimit -u`, or the limit of its container or service";
  }
  all_made.count_down();
  for (auto& x : threads)
    x.join();
  return result;
}

} // namespace castor
