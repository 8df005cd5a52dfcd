#include "castor/tools/cli/doctor_checks.hpp"

#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

namespace castor::test {

namespace {

using namespace cli;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A machine on which everything is well.
Machine healthy() {
  Machine x;
  x.version = "1";
  x.libraries = {{"castor_vision", {}}};
  x.classes = 20;
  x.opencv = "4.6.0";
  x.configs = "/usr/share/castor/configs";
  x.port = 7117;
  x.socket_folder = "/run/user/1/castor";
  x.locale = "C.UTF-8";
  x.character_set = "UTF-8";
  x.clock_is_synchronised = true;
  x.open_files = 4096;
  x.journal_folder = "/home/ann";
  x.free_bytes = std::uint64_t{100} << 30;
  x.cameras = {{"/dev/video0"}};
  return x;
}

void expect(const Finding& x, Verdict verdict, const std::string& text, const std::string& remedy) {
  EXPECT_EQ(x.verdict, verdict) << x.text;
  EXPECT_THAT(x.text, HasSubstr(text));
  EXPECT_THAT(x.remedy, HasSubstr(remedy));
}

TEST(DoctorChecks, AHealthyMachineIsOk) {
  auto findings = examine(healthy());
  EXPECT_EQ(findings.size(), 12U);
  for (auto& x : findings) {
    EXPECT_EQ(x.verdict, Verdict::ok) << x.check << ' ' << x.text;
    EXPECT_THAT(x.remedy, IsEmpty());
    EXPECT_THAT(x.text, Not(IsEmpty()));
  }
}

TEST(DoctorChecks, ALibraryThatCannotBeLoadedIsAnError) {
  auto x = healthy();
  x.libraries[0].problem = "cannot load libcastor_vision.so: no such file";
  expect(check_libraries(x), Verdict::error, "libcastor_vision.so", "LD_LIBRARY_PATH");
}

TEST(DoctorChecks, OpenCvHasToBeThere) {
  auto x = healthy();
  x.opencv.clear();
  expect(check_opencv(x), Verdict::error, "vision cannot run", "apt install libopencv-dev");
}

TEST(DoctorChecks, ConfigsThatAreMissingAreAWarning) {
  auto x = healthy();
  x.configs.clear();
  x.configs_looked_for = "/opt/configs";
  expect(check_configs(x), Verdict::warning, "/opt/configs", "scripts/install");
}

TEST(DoctorChecks, APortInUseIsAWarning) {
  auto x = healthy();
  x.port_problem = "another program uses it";
  expect(check_port(x), Verdict::warning, "7117", "--listen ADDRESS:0");
}

TEST(DoctorChecks, ASocketFolderThatIsOpenToOthersIsAnError) {
  auto x = healthy();
  x.socket_problem = "/tmp/castor-1 is open to others";
  expect(check_sockets(x), Verdict::error, "open to others", "castor ps");
}

TEST(DoctorChecks, SocketsOfKilledSystemsAreAWarning) {
  auto x = healthy();
  x.stale_sockets = 2;
  expect(check_sockets(x), Verdict::warning, "2 sockets of killed systems", "removes them");
}

TEST(DoctorChecks, ALocaleThatIsNotThereOrNotUnicodeIsAWarning) {
  auto x = healthy();
  x.locale = "de_DE.UTF-8";
  x.locale_is_there = false;
  expect(check_locale(x), Verdict::warning, "de_DE.UTF-8 is not installed", "locale-gen");
  x = healthy();
  x.character_set = "ANSI_X3.4-1968";
  expect(check_locale(x), Verdict::warning, "ANSI_X3.4-1968", "LC_ALL=C.UTF-8");
}

TEST(DoctorChecks, ClocksHaveToBeSteadyAndShouldBeSynchronised) {
  auto x = healthy();
  x.clock_is_steady = false;
  expect(check_clock(x), Verdict::error, "does not go forward", "clock source");
  x = healthy();
  x.clock_is_synchronised = false;
  expect(check_clock(x), Verdict::warning, "not synchronised", "chrony");
  x.clock_is_synchronised.reset();
  EXPECT_EQ(check_clock(x).verdict, Verdict::ok);
}

TEST(DoctorChecks, LimitsThatAreTooLowAreNamed) {
  auto x = healthy();
  x.open_files = 100;
  expect(check_open_files(x), Verdict::error, "at most 100", "ulimit -n");
  x.open_files = 512;
  expect(check_open_files(x), Verdict::warning, "at most 512", "ulimit -n");
  x.core_bytes = 0;
  expect(check_core_dumps(x), Verdict::warning, "leaves no core dump", "ulimit -c");
  x.locked_bytes = 8192;
  expect(check_locked_memory(x), Verdict::warning, "8 KB", "ulimit -l");
}

TEST(DoctorChecks, JournalsNeedRoom) {
  auto x = healthy();
  x.free_bytes = std::uint64_t{50} << 20;
  expect(check_disk(x), Verdict::error, "52.4 MB free", "make room");
  x.free_bytes = std::uint64_t{500} << 20;
  expect(check_disk(x), Verdict::warning, "/home/ann", "make room");
  x.journals_can_be_written = false;
  expect(check_disk(x), Verdict::warning, "cannot be written", "--journal-dir");
}

TEST(DoctorChecks, ACameraThatCannotBeOpenedIsAWarning) {
  auto x = healthy();
  x.cameras[0].readable = false;
  expect(check_cameras(x), Verdict::warning, "/dev/video0", "usermod");
  x.cameras.clear();
  expect(check_cameras(x), Verdict::ok, "none", "");
}

using Doctor = Castor;

TEST_F(Doctor, SaysEachCheckWithItsState) {
  auto answer = ask({"doctor"});
  EXPECT_THAT(answer.output, HasSubstr("OK       libraries      castor "));
  EXPECT_THAT(answer.output, HasSubstr("OpenCV         version 4."));
  auto lines = json_lines(ask({"doctor", "--json"}).output);
  ASSERT_EQ(lines.size(), 12U);
  EXPECT_EQ(lines[0]["check"], "libraries");
  EXPECT_EQ(lines[0]["state"], "ok");
}

TEST_F(Doctor, EndsWithStatusOneIfThereIsAnError) {
  std::filesystem::create_directory(runtime / "castor");
  chmod((runtime / "castor").c_str(), 0755);
  auto answer = ask({"doctor"});
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.output, HasSubstr("ERROR    sockets"));
}

} // namespace

} // namespace castor::test
