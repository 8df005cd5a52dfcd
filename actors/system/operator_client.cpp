#include "castor/actors/system/operator_client.hpp"

#include <pwd.h>
#include <unistd.h>

#include <atomic>
#include <memory>

namespace castor {

const std::string& operator_source() {
  static const std::string result = [] {
    auto* user = getpwuid(geteuid());
    return std::string{operators} + ':' +
           (user ? std::string{user->pw_name} : std::to_string(geteuid()));
  }();
  return result;
}

ClientPtr new_operator_client() {
  return std::make_shared<const Client>(
    Client{operator_source(), std::string{operators}, next_operator_number()});
}

std::uint64_t next_operator_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

} // namespace castor
