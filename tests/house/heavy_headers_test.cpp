#include "castor/tests/house/include_graph.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace castor::test {

namespace {

namespace fs = std::filesystem;

/// Headers that are there to include heavy ones.
bool may_be_heavy(const fs::path& header) {
  auto name = header.filename();
  return name == "opencv_bridge.hpp" || name == "eigen_bridge.hpp" ||
         name == "adopt_connection.hpp" ||
         header.generic_string().ends_with("actors/link/connection.hpp");
}

} // namespace

TEST(Headers, DoNotMakeEverybodyPayForHeavyOnes) {
  std::regex heavy{"#include [\"<](Eigen|opencv2|mrpt|ompl|fcl|ceres|octomap|caf/io|openssl)/.*"};
  for (auto& folder : product_folders(CASTOR_SOURCE_DIR))
    for (auto& x : fs::recursive_directory_iterator(fs::path{CASTOR_SOURCE_DIR} / folder)) {
      if (x.path().extension() != ".hpp" || may_be_heavy(x.path()))
        continue;
      std::ifstream in{x.path()};
      for (std::string line; std::getline(in, line);)
        EXPECT_FALSE(std::regex_match(line, heavy)) << x.path() << ": " << line;
    }
}

} // namespace castor::test
