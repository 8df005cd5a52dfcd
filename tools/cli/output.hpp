#pragma once

#include "castor/base/diagnostic.hpp"

#include <filesystem>
#include <fstream>
#include <mutex>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// To standard error.
void print(const std::vector<Diagnostic>& problems);

/// A file to be written anew. Throws std::runtime_error.
std::ofstream create(const std::filesystem::path& file);

/// Standard output for JSON lines alone: for as long as it lives, what anybody else prints there
/// goes to standard error, in processes that are started meanwhile, too.
class JsonOutput {
public:
  /// Throws std::runtime_error if standard output is closed.
  JsonOutput();
  JsonOutput(const JsonOutput&) = delete;
  JsonOutput& operator=(const JsonOutput&) = delete;
  ~JsonOutput();

  /// One line, at once; bytes that are no UTF-8 are replaced. May be called by any thread.
  void print(const nlohmann::ordered_json& x);

private:
  std::mutex mutex_;
  int output_;
};

/// The exit status of a command that wants to end with `status`, once all that it has printed is
/// out: 1, and the reason on standard error, if it could not be printed. That nobody reads on is no
/// failure.
int finish_output(int status);

} // namespace castor::cli
