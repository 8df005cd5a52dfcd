#include "castor/base/plain_words.hpp"

#include "castor/base/caf.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <ios>
#include <new>
#include <system_error>

namespace castor {

namespace {

std::string of_files(const std::filesystem::filesystem_error& x) {
  auto path =
    x.path2().empty() ? x.path1().string() : x.path1().string() + " or " + x.path2().string();
  if (path.empty())
    return "the folder of this process cannot be used: " + x.code().message() +
           "; change to a folder that exists";
  return path + " cannot be used: " + x.code().message() +
         "; check that it exists and that you may read and write it, or choose another place";
}

/// Without "[json.exception.parse_error.101] ".
std::string of_json(const nlohmann::json::exception& x) {
  std::string what = x.what();
  if (auto end = what.find("] "); what.starts_with('[') && end != what.npos)
    what.erase(0, end + 2);
  return "the JSON is not as expected: " + what;
}

} // namespace

std::string plain_words(const std::exception& x) {
  if (auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&x))
    return of_files(*file);
  if (dynamic_cast<const std::bad_alloc*>(&x))
    return "there is not enough memory";
  if (auto* json = dynamic_cast<const nlohmann::json::exception*>(&x))
    return of_json(*json);
  if (auto* stream = dynamic_cast<const std::ios_base::failure*>(&x))
    return "a file cannot be read or written: " + stream->code().message();
  auto* what = x.what();
  return what ? what : "an exception without a message";
}

std::string plain_words(const caf::error& x, const caf::actor_system& system) {
  auto& context = x.context();
  return context.match_elements<std::string>() ? context.get_as<std::string>(0) : system.render(x);
}

} // namespace castor
