#include "castor/tools/cli/command_tree.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::cli {
namespace {

using testing::ElementsAre;

struct Values {
  std::string text;
  std::vector<std::string> texts;
  int number = 3;
  bool flag = false;
};

const Argument& option(const Command& command, const std::string& name) {
  for (auto& x : command.options)
    for (auto& y : x.names)
      if (y == name)
        return x;
  throw std::out_of_range(name);
}

class CommandTree : public testing::Test {
protected:
  Command tree() { return command_tree(app, "tool"); }

  CLI::App app{"a tool"};
  Values values;
};

TEST_F(CommandTree, HasCommandsWithTheirPathHelpAndFooter) {
  auto* show = app.add_subcommand("journal", "journals")->add_subcommand("show", "print it");
  show->footer("Example: tool journal show x");
  auto root = tree();
  auto& found = root.commands.at(0).commands.at(0);
  EXPECT_THAT(found.path, ElementsAre("tool", "journal", "show"));
  EXPECT_EQ(found.help, "print it");
  EXPECT_EQ(found.footer, "Example: tool journal show x");
  EXPECT_EQ(all_commands(root).size(), 3u);
}

TEST_F(CommandTree, DoesNotTakeTheFooterOfAProgramForThatOfItsCommands) {
  app.footer("Example: tool --help");
  app.add_subcommand("show", "print it");
  EXPECT_EQ(tree().commands.at(0).footer, "");
}

TEST_F(CommandTree, LeavesOutWhatHelpHides) {
  app.add_subcommand("secret", "for programs")->group("");
  app.add_flag("--hidden", values.flag, "for programs")->group("");
  EXPECT_TRUE(tree().commands.empty());
  EXPECT_THROW(option(tree(), "--hidden"), std::out_of_range);
}

TEST_F(CommandTree, HasOptionsOfGroups) {
  app.add_option_group("group")->add_flag("--grouped", values.flag, "in a group");
  EXPECT_EQ(option(tree(), "--grouped").help, "in a group");
}

TEST_F(CommandTree, KnowsFlagsAndAllTheirNames) {
  app.add_flag("-v,--verbose", values.flag, "more");
  auto x = option(tree(), "-v");
  EXPECT_THAT(x.names, ElementsAre("-v", "--verbose"));
  EXPECT_EQ(x.kind, ValueKind::flag);
  EXPECT_EQ(x.value, "");
}

TEST_F(CommandTree, KnowsFilesAndFoldersByTheirTypeNames) {
  for (auto* type : {"FILE", "OUT", "FILE|DIR"})
    app.add_option(std::string{"--"} + type, values.text)->type_name(type);
  app.add_option("--dir", values.text)->type_name("DIR");
  app.add_option("--existing", values.text)->check(CLI::ExistingFile);
  app.add_option("--pair", values.text)->type_name("NAME=FILE");
  for (auto* name : {"--FILE", "--OUT", "--FILE|DIR", "--existing"})
    EXPECT_EQ(option(tree(), name).kind, ValueKind::file) << name;
  EXPECT_EQ(option(tree(), "--dir").kind, ValueKind::folder);
  EXPECT_EQ(option(tree(), "--pair").kind, ValueKind::text);
}

TEST_F(CommandTree, KnowsWhatAPositionalArgumentTakesByItsNameToo) {
  app.add_option("FILE", values.text, "the .cast file of the system")->required();
  app.add_option("OTHERS", values.texts, "others")->type_name("");
  auto root = tree();
  ASSERT_EQ(root.positionals.size(), 2u);
  auto& file = root.positionals[0];
  EXPECT_EQ(file.value, "FILE");
  EXPECT_EQ(file.kind, ValueKind::file);
  EXPECT_EQ(file.suffix, "cast");
  EXPECT_TRUE(file.required);
  EXPECT_FALSE(file.repeatable);
  EXPECT_EQ(root.positionals[1].value, "OTHERS");
  EXPECT_EQ(root.positionals[1].kind, ValueKind::text);
  EXPECT_TRUE(root.positionals[1].repeatable);
}

TEST_F(CommandTree, KnowsTheChoicesOfValidatorsAndOfTypeNames) {
  app.add_option("--set", values.text)->check(CLI::IsMember({"full", "off"}));
  app.add_option("--named", values.text)->type_name("MODE")->check(CLI::IsMember({"full", "off"}));
  std::map<std::string, int> map{{"full", 1}, {"off", 2}};
  app.add_option("--mapped", values.number)->transform(CLI::CheckedTransformer(map));
  app.add_option("--written", values.text)->type_name("full|off");
  for (auto* name : {"--set", "--named", "--mapped", "--written"}) {
    auto x = option(tree(), name);
    EXPECT_EQ(x.kind, ValueKind::choice) << name;
    EXPECT_THAT(x.choices, ElementsAre("full", "off")) << name;
  }
  EXPECT_EQ(option(tree(), "--named").value, "MODE");
}

TEST_F(CommandTree, KnowsTheRangeAndTheDefault) {
  app.add_option("--count", values.number, "how many")
    ->type_name("N")
    ->check(CLI::Range(1, 100))
    ->capture_default_str();
  auto x = option(tree(), "--count");
  EXPECT_EQ(x.value, "N");
  EXPECT_EQ(x.range, "[1 - 100]");
  EXPECT_EQ(x.default_value, "3");
}

TEST_F(CommandTree, LeavesValidatorsOutOfTheNameOfAValue) {
  app.add_option("--limit", values.number)->type_name("MB")->check(CLI::PositiveNumber);
  app.add_option("--listen", values.text)->type_name("HOST:PORT");
  EXPECT_EQ(option(tree(), "--limit").value, "MB");
  EXPECT_EQ(option(tree(), "--listen").value, "HOST:PORT");
}

TEST_F(CommandTree, PassesOptionsOnWhereTheyFallThrough) {
  app.fallthrough();
  app.add_option("--plugin", values.texts, "a library")->type_name("FILE");
  app.add_subcommand("run", "run it");
  auto root = tree();
  auto& run = root.commands.at(0);
  ASSERT_EQ(run.inherited.size(), 1u) << "--help is its own";
  EXPECT_THAT(run.inherited[0].names, ElementsAre("--plugin"));
}

TEST_F(CommandTree, DoesNotPassOnWhatDoesNotFallThrough) {
  app.add_option("--plugin", values.texts, "a library")->type_name("FILE");
  app.add_subcommand("run", "run it");
  EXPECT_TRUE(tree().commands.at(0).inherited.empty());
}

TEST_F(CommandTree, KnowsWhatRunningSystemsHaveNamesFor) {
  app.add_option("--system", values.text)->type_name("NAME");
  app.add_option("WHERE", values.text)->type_name("SUBARCHITECTURE[/ID|TYPE]");
  EXPECT_EQ(option(tree(), "--system").kind, ValueKind::system);
  EXPECT_EQ(tree().positionals.at(0).kind, ValueKind::place);
}

} // namespace
} // namespace castor::cli
