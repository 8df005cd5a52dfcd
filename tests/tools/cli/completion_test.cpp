#include "castor/tests/tools/cli/castor_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <set>

namespace castor::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::UnorderedElementsAre;

using Words = std::vector<std::string>;

Words lines_of(const std::string& text) {
  Words result;
  std::istringstream in{text};
  for (std::string line; std::getline(in, line);)
    if (!line.empty())
      result.push_back(line);
  return result;
}

bool is_installed(const std::string& program) {
  std::istringstream folders{std::getenv("PATH")};
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + '/' + program).c_str(), X_OK) == 0)
      return true;
  return false;
}

class Completion : public Castor {
protected:
  void SetUp() override {
    Castor::SetUp();
    // Two systems and something else, in a folder of their own.
    for (auto* name : {"arm.cast", "arm-two.cast", "arm.txt"})
      write(name, "");
    std::filesystem::create_directories(folder / "armed");
  }

  /// Path of the script for a shell.
  std::string script(const std::string& shell) {
    auto answer = ask({"completion", shell});
    EXPECT_EQ(answer.status, 0) << answer.errors;
    return write("completion." + shell, answer.output);
  }

  /// Starts a shell in the folder of this test, with castor in its PATH.
  std::string run_there(Words command) {
    auto bin = std::filesystem::path{CASTOR_EXECUTABLE}.parent_path().string();
    Words arguments{"/bin/sh", "-c", "cd \"$0\" && PATH=\"$1:$PATH\" && shift && exec \"$@\"",
                    folder.string(), bin};
    arguments.insert(arguments.end(), command.begin(), command.end());
    Process process{arguments};
    EXPECT_EQ(process.wait(), 0) << process.errors();
    EXPECT_EQ(process.errors(), "");
    return process.output();
  }

  Words bash(const Words& words) {
    Words command{"bash", "--norc", "--noprofile", CASTOR_COMPLETE ".bash", script("bash")};
    command.insert(command.end(), words.begin(), words.end());
    return lines_of(run_there(command));
  }

  /// Without the descriptions that fish shows beside them.
  Words fish(const std::string& line) {
    auto result =
      lines_of(run_there({"fish", "--no-config", CASTOR_COMPLETE ".fish", script("fish"), line}));
    for (auto& x : result)
      x = x.substr(0, x.find('\t'));
    return result;
  }

  std::string zsh(const std::string& line) {
    return run_there({"zsh", "-f", CASTOR_COMPLETE ".zsh", script("zsh"), line});
  }

  /// Of a command and all its parts, each as the words that call it.
  void for_each_command(const Words& path, const std::function<void(const Words&)>& f) {
    f(path);
    auto help = help_of(path);
    auto at = help.find("\nSubcommands:\n");
    if (at == help.npos)
      return;
    std::istringstream in{help.substr(at + 14)};
    for (std::string line; std::getline(in, line) && line.rfind("  ", 0) == 0;) {
      auto part = path;
      part.push_back(line.substr(2, line.find(' ', 2) - 2));
      // Continuation of a description that is too long for its line.
      if (!part.back().empty())
        for_each_command(part, f);
    }
  }

  static std::string help_of(Words command) {
    command.push_back("--help");
    return ask(command).output;
  }

  /// Long options that a help text explains.
  static std::set<std::string> options_in(const std::string& help) {
    std::set<std::string> result;
    std::regex line{"\n  (?:-[a-zA-Z],)?(--[a-z][a-z-]*)"};
    for (std::sregex_iterator x{help.begin(), help.end(), line}, end; x != end; ++x)
      result.insert((*x)[1]);
    return result;
  }
};

TEST_F(Completion, OfBashOffersCommands) {
  EXPECT_THAT(bash({"castor", "jour"}), UnorderedElementsAre("journal"));
  EXPECT_THAT(bash({"castor", "journal", ""}), IsSupersetOf({"ls", "show", "export", "replay"}));
  EXPECT_THAT(bash({"castor", ""}), Not(Contains("completion-values")));
}

TEST_F(Completion, OfBashOffersEveryOptionThatHelpExplains) {
  std::size_t commands = 0;
  for_each_command({}, [&](const Words& path) {
    Words words{"castor"};
    words.insert(words.end(), path.begin(), path.end());
    words.push_back("--");
    EXPECT_THAT(bash(words), IsSupersetOf(options_in(help_of(path))))
      << testing::PrintToString(path);
    ++commands;
  });
  EXPECT_GT(commands, 15u) << "the help texts do not look as they are read here";
}

TEST_F(Completion, OfBashOffersFilesFoldersAndChoices) {
  EXPECT_THAT(bash({"castor", "run", "ar"}),
              UnorderedElementsAre("arm.cast", "arm-two.cast", "armed"));
  EXPECT_THAT(bash({"castor", "run", "arm.t"}), UnorderedElementsAre("arm.txt"));
  EXPECT_THAT(bash({"castor", "run", "--tls", "ar"}), UnorderedElementsAre("armed"));
  EXPECT_THAT(bash({"castor", "run", "--tls", "=", "ar"}), UnorderedElementsAre("armed"));
  EXPECT_THAT(bash({"castor", "completion", ""}), UnorderedElementsAre("bash", "zsh", "fish"));
}

TEST_F(Completion, OfBashKnowsWhatIsTheValueOfAnOption) {
  EXPECT_THAT(bash({"castor", "--plugin", "run", "jour"}), UnorderedElementsAre("journal"));
  EXPECT_THAT(bash({"castor", "run", "--set", "say", "=", "journal", "arm-"}),
              UnorderedElementsAre("arm-two.cast"));
  EXPECT_THAT(bash({"castor", "run", "--for", ""}), IsEmpty());
  EXPECT_THAT(bash({"castor", "run", "arm.cast", "--", "--"}), IsEmpty());
}

TEST_F(Completion, OfBashOffersWhatRuns) {
  auto name = write("hall.cast", "HOST localhost\nSUBARCHITECTURE corridor\n"
                                 "CPP WM SubarchitectureWorkingMemory\n"
                                 "CPP TM AlwaysPositiveTaskManager\n"
                                 "CPP UM listener Listener --count 1000000\n");
  EXPECT_THAT(bash({"castor", "wm", "get", "co"}), IsEmpty());
  Process system{command({"run", name})};
  Words offered;
  auto end = std::chrono::steady_clock::now() + std::chrono::seconds{30};
  while (offered.empty() && std::chrono::steady_clock::now() < end)
    offered = bash({"castor", "wm", "get", "co"});
  EXPECT_THAT(offered, UnorderedElementsAre("corridor"));
  EXPECT_THAT(bash({"castor", "ps", "--system", "ha"}),
              UnorderedElementsAre("hall-" + std::to_string(system.pid())));
}

TEST_F(Completion, OfZshOffersCommandsOptionsFilesAndChoices) {
  if (!is_installed("zsh"))
    GTEST_SKIP() << "zsh is not installed";
  EXPECT_THAT(zsh("castor jour"), HasSubstr("journal     -- inspect"));
  EXPECT_THAT(zsh("castor journal "), HasSubstr("show    -- print the changes"));
  EXPECT_THAT(zsh("castor run --plugin x.so --fo"), HasSubstr("--for "));
  EXPECT_THAT(zsh("castor completion "), HasSubstr("bash  fish  zsh"));
  auto files = zsh("castor run ar");
  EXPECT_THAT(files, HasSubstr("arm-two.cast"));
  EXPECT_THAT(files, Not(HasSubstr("arm.txt")));
}

TEST_F(Completion, OfFishOffersCommandsOptionsFilesAndChoices) {
  if (!is_installed("fish"))
    GTEST_SKIP() << "fish is not installed";
  EXPECT_THAT(fish("castor jour"), UnorderedElementsAre("journal"));
  EXPECT_THAT(fish("castor journal "), IsSupersetOf({"ls", "show", "export", "replay"}));
  EXPECT_THAT(fish("castor --plugin run jour"), UnorderedElementsAre("journal"));
  EXPECT_THAT(fish("castor run --plugin x.so --fo"), UnorderedElementsAre("--for"));
  EXPECT_THAT(fish("castor completion "), UnorderedElementsAre("bash", "fish", "zsh"));
  EXPECT_THAT(fish("castor run arm-"), UnorderedElementsAre("arm-two.cast"));
  EXPECT_THAT(fish("castor run --tls ar"), UnorderedElementsAre("armed/"));
  EXPECT_THAT(fish("castor run --for "), IsEmpty());
}

using Manual = Completion;

TEST_F(Manual, HasAPageForEveryCommandThatExplainsEveryOption) {
  ASSERT_EQ(ask({"man", "--output", (folder / "man").string()}).status, 0);
  std::size_t pages = 0;
  for_each_command({}, [&](const Words& path) {
    std::string name = "castor";
    for (auto& x : path)
      name += '-' + x;
    auto page = read(folder / "man" / (name + ".1"));
    EXPECT_THAT(page, HasSubstr(".SH EXAMPLES\n")) << name
                                                   << ": its footer, or that of the command "
                                                      "that it is part of, has an Example: line";
    for (auto option : options_in(help_of(path))) {
      for (std::size_t at = 0; (at = option.find('-', at)) != option.npos; at += 2)
        option.insert(at, "\\");
      EXPECT_THAT(page, HasSubstr(option)) << name;
    }
    ++pages;
  });
  auto written = std::distance(std::filesystem::directory_iterator{folder / "man"}, {});
  EXPECT_EQ(static_cast<std::size_t>(written), pages);
}

TEST_F(Manual, IsFormattedWithoutWarnings) {
  auto output = (folder / "man").string();
  ASSERT_EQ(ask({"man", "--output", output}).status, 0);
  if (!is_installed("groff") && !is_installed("mandoc"))
    GTEST_SKIP() << "neither groff nor mandoc is installed";
  if (is_installed("groff")) {
    EXPECT_EQ(run_there({"/bin/sh", "-c", "groff -man -ww -Tutf8 man/*.1 2>&1 >/dev/null"}), "");
  }
  if (is_installed("mandoc")) {
    EXPECT_EQ(run_there({"/bin/sh", "-c", "mandoc -T lint -W warning man/*.1 || true"}), "");
  }
}

TEST_F(Manual, IsTheSameForTheSameDay) {
  setenv("SOURCE_DATE_EPOCH", "86400", 1);
  auto page = ask({"man", "run"}).output;
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_THAT(page, HasSubstr(".TH CASTOR\\-RUN 1 \"1970-01-02\""));
}

TEST_F(Manual, KnowsTheNameThatWasMeant) {
  auto answer = ask({"man", "journal", "sho"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.errors, "castor: `castor journal` has no command sho; did you mean 'show'?\n");
}

} // namespace
} // namespace castor::test
