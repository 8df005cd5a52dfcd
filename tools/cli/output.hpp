#pragma once

#include "castor/base/diagnostic.hpp"

#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace castor::cli {

/// Prints diagnostics to standard error.
void print(const std::vector<Diagnostic>& problems);

/// Creates or truncates a file. Throws std::runtime_error.
std::ofstream create(const std::filesystem::path& file);

/// Creates or replaces a file. Throws std::runtime_error.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Reserves standard output for JSON lines: during its lifetime all other output to it goes to
/// standard error, also in processes started meanwhile.
class JsonOutput {
public:
  /// Throws std::runtime_error if standard output is closed.
  JsonOutput();
  JsonOutput(const JsonOutput&) = delete;
  JsonOutput& operator=(const JsonOutput&) = delete;
  ~JsonOutput();

  /// Prints one line and flushes it; bytes that are not UTF-8 are replaced. May be called from any
  /// thread.
  void print(const nlohmann::ordered_json& x);

private:
  std::mutex mutex_;
  int output_;
};

/// Flushes the output of a command and returns its exit status: `status`, or 1 with the reason on
/// standard error if the output could not be written. A reader that has closed the pipe is not an
/// error.
int finish_output(int status);

} // namespace castor::cli
