#include "castor/tests/tools/cli/castor_fixture.hpp"

#include "castor/tools/cli/project_template.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using cli::project_files;
using cli::project_name;
using cli::template_kinds;

TEST(NewProject, IsNamedInThreeWays) {
  auto result = project_name("door-watcher_2");
  ASSERT_TRUE(result.name) << result.problem;
  EXPECT_EQ(result.name->name, "door-watcher_2");
  EXPECT_EQ(result.name->library, "door_watcher_2");
  EXPECT_EQ(result.name->class_name, "DoorWatcher2");
}

TEST(NewProject, RefusesWhatCannotBeAName) {
  for (auto name : {"", "3d", "-x", "a b", "a/b", "../x", "x-", "a--b", "größe", "a.b", "test",
                    "all", "castor", "castor-x", "install"})
    EXPECT_FALSE(project_name(name).name) << name;
  EXPECT_TRUE(project_name(std::string(40, 'x')).name);
  EXPECT_FALSE(project_name(std::string(41, 'x')).name);
}

TEST(NewProject, HasAllKindsOfFilesAndNoPlaceholders) {
  auto kinds = template_kinds();
  EXPECT_EQ(std::set<std::string>(kinds.begin(), kinds.end()),
            (std::set<std::string>{"component", "robot", "subarchitecture"}));
  for (auto kind : kinds) {
    std::set<std::string> endings;
    for (auto& file : project_files(kind, *project_name("rover").name)) {
      endings.insert(std::filesystem::path{file.path}.extension());
      EXPECT_EQ(file.path.find("NAME"), std::string::npos) << file.path;
      EXPECT_EQ(file.text.find("{{"), std::string::npos) << file.path;
      EXPECT_EQ(file.text.back(), '\n') << file.path;
    }
    for (auto ending : {".txt", ".cast", ".cpp", ".hpp"})
      EXPECT_TRUE(endings.contains(ending)) << kind << " has no " << ending;
  }
}

class NewCommand : public Castor {
protected:
  /// What the command prints to standard error, which is refused.
  std::string refused(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "new");
    arguments.insert(arguments.end(), {"--in", folder.string()});
    Process castor{command(arguments)};
    EXPECT_EQ(castor.wait(), 2) << castor.output();
    EXPECT_EQ(castor.output(), "");
    return castor.errors();
  }
};

TEST_F(NewCommand, MakesAFolderAndSaysWhatToDoNext) {
  for (auto kind : {"component", "subarchitecture", "robot"}) {
    auto name = std::string{"my-"} + kind;
    Process castor{command({"new", kind, name, "--in", folder.string()})};
    EXPECT_EQ(castor.wait(), 0) << castor.errors();
    for (auto part : {"cmake --build build", "ctest --test-dir build", "--until-quiet 1s"})
      EXPECT_NE(castor.output().find(part), std::string::npos) << castor.output();
    EXPECT_TRUE(std::filesystem::exists(folder / name / (name + ".cast")));
  }
}

TEST_F(NewCommand, TellsScriptsWhatItHasMade) {
  auto lines =
    json_lines(ask({"new", "component", "greeter", "--in", folder.string(), "--json"}).output);
  ASSERT_EQ(lines.size(), 1U);
  auto& made = lines.front();
  EXPECT_EQ(made["folder"], (folder / "greeter").string());
  EXPECT_FALSE(made["files"].empty());
  for (auto& file : made["files"])
    EXPECT_TRUE(std::filesystem::exists(folder / "greeter" / file.get<std::string>())) << file;
  EXPECT_EQ(made["next"].front(), "cd " + (folder / "greeter").string());
  EXPECT_EQ(made["next"].back(), "castor --plugin build/libgreeter.so run greeter.cast --trace "
                                 "--until-quiet 1s");
}

TEST_F(NewCommand, NamesWhatIsToBeInstalledBefore) {
  auto said = [&, number = 0](const std::filesystem::path& castor) mutable {
    Process process{
      {castor, "new", "component", "greeter-" + std::to_string(++number), "--in", folder.string()}};
    EXPECT_EQ(process.wait(), 0) << process.errors();
    return process.output();
  };
  // Of a build tree.
  EXPECT_NE(said(CASTOR_EXECUTABLE).find("  scripts/install "), std::string::npos);
  // Installed, without what components are built with.
  std::filesystem::create_directories(folder / "bin");
  auto castor = folder / "bin/castor";
  std::filesystem::copy_file(CASTOR_EXECUTABLE, castor);
  auto text = said(castor);
  EXPECT_NE(text.find("apt-get install castor-dev"), std::string::npos) << text;
  EXPECT_NE(text.find("scripts/install"), std::string::npos) << text;
  // With it, and not in PATH.
  auto package = folder / CASTOR_PACKAGE_FOLDER;
  std::filesystem::create_directories(package);
  std::ofstream{package / "castorConfig.cmake"};
  text = said(castor);
  EXPECT_NE(text.find("  export PATH=" + (folder / "bin").string() + ":$PATH\n"), std::string::npos)
    << text;
  EXPECT_EQ(text.find("install"), std::string::npos) << text;
  // And in PATH.
  const std::string before = std::getenv("PATH");
  setenv("PATH", ((folder / "bin").string() + ':' + before).c_str(), 1);
  text = said(castor);
  setenv("PATH", before.c_str(), 1);
  EXPECT_NE(text.find("Next:\n  cd "), std::string::npos) << text;
}

TEST_F(NewCommand, LeavesWhatIsThereAlone) {
  std::filesystem::create_directory(folder / "greeter");
  EXPECT_NE(refused({"component", "greeter"}).find("is there already"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "greeter"));
}

TEST_F(NewCommand, NamesTheKindThatWasMeant) {
  EXPECT_NE(refused({"robt", "rover"}).find("did you mean 'robot'"), std::string::npos);
  EXPECT_NE(refused({"xyz", "rover"}).find("choose one of component"), std::string::npos);
}

TEST_F(NewCommand, RefusesNamesThatCastorHas) {
  EXPECT_NE(refused({"component", "camera"}).find("component class Camera already"),
            std::string::npos);
  // The working memory of the subarchitecture `demo`.
  EXPECT_NE(refused({"component", "demo_wm"}).find("demo_wm"), std::string::npos);
  EXPECT_NE(refused({"component", "a b"}).find("letters, digits"), std::string::npos);
}

TEST_F(NewCommand, SaysWhichFolderIsMissing) {
  Process castor{command({"new", "component", "greeter", "--in", (folder / "nowhere").string()})};
  EXPECT_EQ(castor.wait(), 2);
  EXPECT_NE(castor.errors().find("there is no folder"), std::string::npos) << castor.errors();
}

} // namespace

} // namespace castor::test
