// `castor building`, and robots in buildings as `castor run` runs them.

#include "castor/tests/support/process.hpp"
#include "castor/tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using testing::HasSubstr;
using testing::Not;

const std::string office = CASTOR_CONFIGS "/buildings/office.building";

struct Answer {
  int status = 0;
  std::string output;
  std::string errors;
};

Answer castor(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), CASTOR_EXECUTABLE);
  Process process{arguments};
  auto status = process.wait();
  return {status, process.output(), process.errors()};
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream{file}.rdbuf();
  return out.str();
}

} // namespace

TEST(BuildingCommand, DescribesAndDrawsABuilding) {
  const TemporaryFolder folder;
  const auto picture = folder / "office.png";
  auto shown = castor({"building", "show", office, "--picture", picture.string()});
  EXPECT_EQ(shown.status, 0) << shown.errors;
  EXPECT_THAT(shown.output, HasSubstr("meeting-room"));
  EXPECT_THAT(shown.output, HasSubstr("11 rooms of 270.0 m2, 11 doors (1 shut)"));
  EXPECT_THAT(content_of(picture), HasSubstr("PNG"));
}

TEST(BuildingCommand, SaysAllThatIsWrong) {
  const TemporaryFolder folder;
  std::ofstream{folder / "bad.building"} << "wall 0 0 to 4 0 to 4 3 close\n"
                                            "door d at 9 9\n"
                                            "room r at 7 7\n"
                                            "start 4 1\n"
                                            "objekt x\n";
  auto shown = castor({"building", "show", (folder / "bad.building").string()});
  EXPECT_EQ(shown.status, 2);
  EXPECT_THAT(shown.errors, HasSubstr("bad.building:5"));
  EXPECT_THAT(shown.errors, HasSubstr("did you mean 'object'?"));
  auto missing = castor({"building", "show", (folder / "none.building").string()});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.errors, HasSubstr("there is no such file"));
}

TEST(DriveConfiguration, DrivesThePathWithoutCollisionsTheSameWayEachTime) {
  auto drive = [](const std::string& seed) {
    const TemporaryFolder folder;
    auto run =
      castor({"run", CASTOR_CONFIGS "/drive.cast", "--reproducible", "--for", "20min", "--set",
              "seed=" + seed, "--set", "people=true", "--output", folder.path().string()});
    EXPECT_EQ(run.status, 0) << run.output << run.errors;
    EXPECT_THAT(run.output + run.errors, HasSubstr("the path was driven"));
    EXPECT_THAT(run.output + run.errors, Not(HasSubstr("collision")));
    return content_of(folder / "entries.json");
  };
  const auto once = drive("7");
  EXPECT_THAT(once, HasSubstr("\"arrived\":true"));
  EXPECT_EQ(drive("7"), once);
}

TEST(DriveConfiguration, RefusesABuildingThatIsNotThere) {
  auto run = castor({"run", CASTOR_CONFIGS "/drive.cast", "--set", "building=none", "--for", "1s"});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.errors, HasSubstr("robot cannot be configured: none"));
}

} // namespace castor::test
