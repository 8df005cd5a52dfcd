#pragma once

#include "castor/actors/system/system.hpp"
#include "castor/tools/testing/test_system.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// configs/playmate.cast in tests.
namespace castor::test {

inline std::string playmate_cast() {
  std::ifstream in{CASTOR_CONFIGS "/playmate.cast"};
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// The file with time for operations on a busy machine: their time limits are real time, also where
/// time is simulated, and the camera renders every picture of a table with an arm.
inline std::string with_patience(const std::string& text) {
  std::istringstream in{text};
  std::string result;
  for (std::string line; std::getline(in, line);) {
    const bool is_component =
      line.starts_with("CPP UM ") || line.starts_with("CPP MG ") || line.starts_with("COMPONENT ");
    result += line + (is_component ? " --deadline 2min\n" : "\n");
  }
  return result;
}

inline TestSystemOptions playmate_options(std::map<std::string, std::string> variables) {
  TestSystemOptions options;
  options.file = CASTOR_CONFIGS "/playmate.cast";
  options.simulated_time = true;
  options.variables = std::move(variables);
  return options;
}

/// Without working memories and task managers.
inline std::vector<std::string> playmate_components(TestSystem& system) {
  std::vector<std::string> result;
  for (auto& x : system.system().summary().components)
    if (!x.identity.name.ends_with("_tm"))
      result.push_back(x.identity.name);
  return result;
}

/// The file without the lines from `first` up to, but without, `end`.
inline std::string without_lines(const std::string& text, const std::string& first,
                                 const std::string& end) {
  std::istringstream in{text};
  std::string result;
  bool is_left_out = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(first))
      is_left_out = true;
    else if (is_left_out && line.starts_with(end))
      is_left_out = false;
    if (!is_left_out)
      result += line + '\n';
  }
  return result;
}

} // namespace castor::test
