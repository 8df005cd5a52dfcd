// The systems that come with Castor, with the values that their variables may have.

#include "castor/tests/support/process.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace castor::test {

namespace {

struct Variant {
  std::string file;
  /// NAME=VALUE, as --set takes them.
  std::vector<std::string> settings;
};

void PrintTo(const Variant& x, std::ostream* out) {
  *out << x.file;
  for (auto& setting : x.settings)
    *out << ' ' << setting;
}

class ShippedConfiguration : public ::testing::TestWithParam<Variant> {};

} // namespace

TEST_P(ShippedConfiguration, HasNoErrors) {
  std::vector<std::string> arguments{CASTOR_EXECUTABLE, "check",
                                     CASTOR_CONFIGS "/" + GetParam().file};
  for (auto& setting : GetParam().settings)
    arguments.insert(arguments.end(), {"--set", setting});
  Process process{arguments};
  EXPECT_EQ(process.wait(), 0) << process.output() << process.errors();
}

INSTANTIATE_TEST_SUITE_P(
  Variants, ShippedConfiguration,
  ::testing::Values(
    Variant{"drive.cast", {}}, Variant{"drive.cast", {"people=true"}},
    Variant{"explorer.cast", {"drive=path"}}, Variant{"explorer.cast", {"drive=keys"}},
    Variant{"explorer.cast", {"drive=goals"}}, Variant{"explorer.cast", {"drive=explore"}},
    Variant{"explorer.cast", {"drive=none"}}, Variant{"explorer.cast", {"safety=false"}},
    Variant{"explorer.cast", {"drive=explore", "people=true", "legs=true"}},
    Variant{"explorer.cast", {"drive=goals", "people=true", "safety=false"}},
    Variant{"explorer.cast", {"camera=true"}}, Variant{"explorer.cast", {"log=some.log"}},
    Variant{"explorer.cast", {"log=some.log", "localisation=map", "map=some.yaml"}},
    Variant{"explorer.cast", {"localisation=map", "map=some.yaml"}},
    Variant{"explorer.cast", {"localisation=map", "map=some.yaml", "drive=goals"}},
    Variant{"explorer.cast", {"front=a", "maps=b", "journal=full"}},
    Variant{"playmate.cast", {}}, Variant{"playmate.cast", {"typed=true"}},
    Variant{"playmate.cast", {"arm=true"}}, Variant{"playmate-arm.cast", {}},
    Variant{"playmate-arm.cast", {"hand=a", "sight=b", "mind=c", "journal=full"}},
    Variant{"vision.cast", {}}, Variant{"vision-three-nodes.cast", {}}));

/// What survives with journals would meet a table that has begun anew.
TEST(ShippedPlaymate, SavesTheTableWhereItKeepsJournals) {
  for (std::string journal : {"off", "batched", "full"}) {
    Process process{{CASTOR_EXECUTABLE, "check", CASTOR_CONFIGS "/playmate-arm.cast", "--json",
                     "--set", "journal=" + journal}};
    ASSERT_EQ(process.wait(), 0) << process.errors();
    EXPECT_EQ(process.output().find("journals/arm.state") != std::string::npos, journal != "off");
  }
}

} // namespace castor::test
