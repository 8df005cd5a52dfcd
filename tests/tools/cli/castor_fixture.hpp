#pragma once

#include "castor/tests/support/process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace castor::test {

/// The castor executable with a plug-in of test components.
class Castor : public testing::Test {
protected:
  void SetUp() override {
    std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(test.begin(), test.end(), '/', '-');
    folder = std::filesystem::temp_directory_path() /
             ("castor-cli-" + std::to_string(getpid()) + "-" + test);
    std::filesystem::create_directories(folder);
    // Systems of other tests are not to be found. The names of sockets must be short.
    runtime = std::filesystem::temp_directory_path() / ("castor-" + std::to_string(getpid()));
    std::filesystem::create_directories(runtime);
    setenv("XDG_RUNTIME_DIR", runtime.c_str(), 1);
  }

  void TearDown() override {
    std::filesystem::remove_all(folder);
    std::filesystem::remove_all(runtime);
  }

  static std::vector<std::string> command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {CASTOR_EXECUTABLE, "--plugin", CASTOR_TEST_PLUGIN});
    return arguments;
  }

  /// What a command that comes to an end of itself says.
  struct Answer {
    int status;
    std::string output;
    std::string errors;
  };

  static Answer ask(const std::vector<std::string>& arguments) {
    Process castor{command(arguments)};
    auto status = castor.wait();
    return {status, castor.output(), castor.errors()};
  }

  /// The lines of what is printed as JSON.
  static std::vector<nlohmann::json> json_lines(const std::string& text) {
    std::vector<nlohmann::json> result;
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);)
      result.push_back(nlohmann::json::parse(line));
    return result;
  }

  std::string write(const std::string& name, const std::string& text) const {
    auto file = folder / name;
    std::ofstream{file} << text;
    return file.string();
  }

  std::string system(const std::string& components) const {
    return write("system.cast", "HOST localhost\nSUBARCHITECTURE a\nCPP WM "
                                "SubarchitectureWorkingMemory\nCPP TM AlwaysPositiveTaskManager\n" +
                                  components);
  }

  std::string read(const std::filesystem::path& file) const {
    std::ifstream in{file};
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }

  std::filesystem::path folder;
  /// Where running systems can be found.
  std::filesystem::path runtime;
};

} // namespace castor::test
