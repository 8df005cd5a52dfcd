// Writes and calls from outside of the system.
#include "castor/tests/tools/cli/castor_fixture.hpp"
#include "castor/tests/tools/cli/operator_name.hpp"

#include "castor/tests/support/eventually.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <csignal>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string soup =
  R"({"dish": "soup", "portion": "large", "place": {"table": 4, "seat": 1}, "extras": ["bread"]})";

class Operator : public Castor {
protected:
  std::unique_ptr<Process> start(const std::string& rules = {}, const std::string& more = {},
                                 const std::vector<std::string>& arguments = {},
                                 const std::string& wm = {}) const {
    auto file = write("kitchen.cast", rules +
                                        "SUBARCHITECTURE kitchen\nCPP WM "
                                        "SubarchitectureWorkingMemory " +
                                        wm +
                                        "\nCPP TM AlwaysPositiveTaskManager\n"
                                        "CPP UM cook Cook\n" +
                                        more);
    std::vector<std::string> all{"run", file};
    all.insert(all.end(), arguments.begin(), arguments.end());
    auto result = std::make_unique<Process>(command(all));
    EXPECT_TRUE(result->wait_for_output("cooks")) << result->errors();
    return result;
  }

  static json value_of(const std::string& id) {
    auto answer = ask({"wm", "get", "kitchen/" + id, "--json"});
    return answer.status == 0 ? json::parse(answer.output) : json{};
  }

  static std::string me() { return operator_of_this_user(); }

  /// What a command that has to be refused says.
  static std::string refused(const std::vector<std::string>& arguments) {
    auto answer = ask(arguments);
    EXPECT_EQ(answer.status, 2) << answer.output;
    EXPECT_THAT(answer.output, IsEmpty());
    return answer.errors;
  }

  static std::string add_refused(const std::string& type, const std::string& value) {
    return refused({"wm", "add", "kitchen", type, value});
  }
};

TEST_F(Operator, AddsOverwritesAndDeletes) {
  auto castor = start();
  auto added = ask({"wm", "add", "kitchen/o1", "Order", soup});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_EQ(added.output, "added kitchen/o1, Order version 0\n");
  auto entry = value_of("o1");
  EXPECT_EQ(entry["writer"], me());
  EXPECT_EQ(entry["value"]["place"]["table"], 4);
  EXPECT_TRUE(entry["value"]["note"].is_null());
  EXPECT_TRUE(castor->wait_for_output("ADD of o1 by " + me()));
  auto merged =
    ask({"wm", "overwrite", "kitchen/o1", "--merge", R"({"place": {"seat": 9}})", "--json"});
  EXPECT_EQ(merged.status, 0) << merged.errors;
  EXPECT_EQ(json::parse(merged.output), (json{{"subarchitecture", "kitchen"},
                                              {"id", "o1"},
                                              {"type", "Order"},
                                              {"version", 1},
                                              {"writer", me()}}));
  entry = value_of("o1");
  EXPECT_EQ(entry["value"]["place"], (json{{"table", 4}, {"seat", 9}}));
  EXPECT_EQ(entry["value"]["dish"], "soup");
  EXPECT_EQ(ask({"wm", "overwrite", "kitchen/o1", soup}).status, 0);
  EXPECT_EQ(value_of("o1")["value"]["place"]["seat"], 1);
  EXPECT_EQ(ask({"wm", "delete", "kitchen/o1"}).output, "deleted kitchen/o1, Order version 2\n");
  EXPECT_TRUE(castor->wait_for_output("DELETE of o1"));
  EXPECT_THAT(refused({"wm", "delete", "kitchen/o1"}), HasSubstr("it was deleted"));
}

TEST_F(Operator, IsGivenIdsThatNobodyHas) {
  auto castor = start();
  EXPECT_EQ(ask({"wm", "add", "kitchen/operator:2", "Order", soup}).status, 0);
  std::set<std::string> ids;
  for (int i = 0; i < 5; ++i)
    ids.insert(json::parse(ask({"wm", "add", "kitchen", "Order", soup, "--json"}).output)["id"]);
  EXPECT_EQ(ids.size(), 5U);
}

TEST_F(Operator, ReadsValuesFromStandardInput) {
  auto castor = start();
  Process add{command({"wm", "add", "kitchen/o1", "Order", "-"}), soup};
  EXPECT_EQ(add.wait(), 0) << add.errors();
  EXPECT_EQ(value_of("o1")["value"]["dish"], "soup");
}

TEST_F(Operator, WritesTypesThatOnlyAnotherNodeKnows) {
  Process node{command({"node", "--name", "far", "--listen", "127.0.0.1:0"})};
  ASSERT_TRUE(node.wait_for_output("listens at ")) << node.errors();
  ASSERT_TRUE(eventually([&] { return node.output().ends_with("\n"); }));
  auto output = node.output();
  auto begin = output.rfind(' ') + 1;
  auto address = output.substr(begin, output.size() - begin - 1);
  auto file = write("far.cast", "HOSTNAME far " + address +
                                  "\nSUBARCHITECTURE kitchen\n"
                                  "CPP WM SubarchitectureWorkingMemory\n"
                                  "CPP TM AlwaysPositiveTaskManager\n"
                                  "[far] CPP UM cook Cook\n");
  Process castor{{CASTOR_EXECUTABLE, "run", file}};
  ASSERT_TRUE(node.wait_for_output("cooks")) << castor.errors();
  auto added = ask({"wm", "add", "kitchen/r", "Receipt", R"({"total": 4.5})"});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_EQ(value_of("r")["value"]["total"], 4.5);
  EXPECT_EQ(ask({"call", "kitchen", "Boil", R"({"litres": 1})"}).status, 0);
}

TEST_F(Operator, WritesTypesOfALoadedLibraryThatNoComponentHasUsed) {
  auto castor = start();
  auto added = ask({"wm", "add", "kitchen/v", "Voucher", R"({"meals": 2})"});
  EXPECT_EQ(added.status, 0) << added.errors;
  EXPECT_EQ(value_of("v")["value"]["meals"], 2);
  EXPECT_THAT(ask({"wm", "types"}).output, HasSubstr("Voucher"));
}

TEST_F(Operator, WaitsForASubarchitectureAndATypeIfAsked) {
  // A system that has not loaded the test components, of which one is called Witness, too.
  auto file = write("kitchen.cast", "SUBARCHITECTURE kitchen\n"
                                    "CPP WM SubarchitectureWorkingMemory\n"
                                    "CPP TM AlwaysPositiveTaskManager\nCPP UM binder Binder\n");
  Process castor{{CASTOR_EXECUTABLE, "run", file}};
  ASSERT_TRUE(eventually([] { return ask({"wm", "ls", "kitchen"}).status == 0; }));
  EXPECT_THAT(refused({"wm", "add", "cellar", "Mark", R"({"slot": 1, "number": 0})"}),
              HasSubstr("no subarchitecture cellar"));
  Process add{
    command({"wm", "add", "cellar/m", "Mark", R"({"slot": 1, "number": 0})", "--wait", "--json"})};
  Process misspelt{command({"wm", "add", "kitchen", "Ordr", soup, "--wait"})};
  auto cellar = write("cellar.cast", "SUBARCHITECTURE cellar\nCPP WM SubarchitectureWorkingMemory\n"
                                     "CPP TM AlwaysPositiveTaskManager\n");
  EXPECT_EQ(ask({"add", cellar}).status, 0);
  // The subarchitecture is there now, and its type is not.
  EXPECT_THAT(refused({"wm", "add", "cellar", "Mark", R"({"slot": 1, "number": 0})"}),
              HasSubstr("no type Mark"));
  EXPECT_EQ(add.output(), "");
  auto witness = write("witness.cast", "SUBARCHITECTURE cellar\nCPP UM witness Witness@" +
                                         std::string{CASTOR_WITNESS_PLUGIN} + " --file " +
                                         (folder / "marks").string() + "\n");
  auto joined = ask({"add", witness});
  EXPECT_EQ(joined.status, 0) << joined.errors;
  EXPECT_EQ(add.wait(), 0) << add.errors();
  EXPECT_EQ(json::parse(add.output())["id"], "m");
  EXPECT_EQ(misspelt.output() + misspelt.errors(), "");
  castor.send_signal(SIGINT);
  EXPECT_EQ(misspelt.wait(), 2);
  EXPECT_THAT(misspelt.errors(), HasSubstr("has ended before it answered"));
}

TEST_F(Operator, IsToldWhatIsWrongWithAValue) {
  auto castor = start();
  EXPECT_THAT(add_refused("Ordre", soup), HasSubstr("no type Ordre; did you mean 'Order'?"));
  EXPECT_THAT(add_refused("Receipt", R"({"totla": 1})"),
              HasSubstr("Receipt has no field totla; did you mean 'total'?"));
  EXPECT_THAT(add_refused("Receipt", "{}"), HasSubstr("the value lacks the field total"));
  EXPECT_THAT(add_refused("Receipt", R"({"total": "much"})"),
              HasSubstr("total has to be a number, but it is a text"));
  auto with = [](std::string key, json value) {
    auto x = json::parse(soup);
    x[json::json_pointer{key}] = std::move(value);
    return x.dump();
  };
  EXPECT_THAT(add_refused("Order", with("/place/table", 1e10)),
              HasSubstr("place.table has to be an integer"));
  EXPECT_THAT(add_refused("Order", with("/place/table", 10000000000)),
              HasSubstr("place.table has to be between -2147483648 and 2147483647"));
  EXPECT_THAT(add_refused("Order", with("/portion", "larg")),
              HasSubstr("enumerator of Portion, but it is \"larg\"; did you mean 'large'?"));
  EXPECT_THAT(add_refused("Order", with("/extras/1", 3)), HasSubstr("extras[1] has to be a text"));
  EXPECT_THAT(add_refused("Order", "{'dish'"), HasSubstr("this is no JSON: character 2 is wrong"));
  EXPECT_THAT(add_refused("Order", "{\"dish\": "), HasSubstr("it ends too early"));
  EXPECT_THAT(refused({"wm", "add", "kitchn", "Order", soup}),
              HasSubstr("did you mean 'kitchen'?"));
  EXPECT_EQ(ask({"wm", "ls", "kitchen/Order"}).errors, "there are no entries of kitchen/Order\n");
}

TEST_F(Operator, DoesNotOverwriteWhatWasChangedMeanwhile) {
  auto castor = start();
  EXPECT_EQ(ask({"wm", "add", "kitchen/o1", "Order", soup}).status, 0);
  EXPECT_EQ(ask({"wm", "overwrite", "kitchen/o1", soup, "--version", "0"}).status, 0);
  EXPECT_THAT(refused({"wm", "overwrite", "kitchen/o1", soup, "--version", "0"}),
              HasSubstr("it has seen version 0, but " + me() +
                        " has since written version 1. Read "
                        "it again"));
  EXPECT_THAT(refused({"wm", "delete", "kitchen/o1", "--version", "0"}),
              HasSubstr("cannot delete kitchen/o1: it has seen version 0"));
  EXPECT_EQ(ask({"wm", "delete", "kitchen/o1", "--version", "1"}).status, 0);
}

TEST_F(Operator, RespectsLeases) {
  auto castor = start({}, "CPP UM guard Guard\n");
  ASSERT_TRUE(castor->wait_for_output("guards")) << castor->errors();
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"wm", "overwrite", "kitchen/guarded", soup},
        {"wm", "delete", "kitchen/guarded"}})
    EXPECT_THAT(refused(arguments), HasSubstr("guard of kitchen holds a lease"));
}

TEST_F(Operator, MayWriteOnlyWhereTheSystemSaysSo) {
  auto castor = start("ACCESS operator WRITES nothing\n");
  auto why = refused({"wm", "add", "kitchen", "Order", soup});
  EXPECT_THAT(why, HasSubstr(me() + " may not add kitchen/"));
  EXPECT_THAT(why, HasSubstr("put ACCESS operator WRITES kitchen into the system's .cast file"));
  EXPECT_THAT(refused({"call", "kitchen", "Boil", R"({"litres": 1})"}), HasSubstr("may not add"));
  castor->send_signal(SIGINT);
  EXPECT_EQ(castor->wait(), 0);
  castor = start("ACCESS operator WRITES kitchen\n");
  EXPECT_EQ(ask({"wm", "add", "kitchen", "Order", soup}).status, 0);
  EXPECT_THAT(refused({"wm", "add", "castor", "Order", soup}), HasSubstr("may not add castor/"));
}

TEST_F(Operator, IsTheSourceInEventsAndJournals) {
  auto castor = start({}, {}, {}, "--journal full --journal-dir " + (folder / "journals").string());
  Process events{command({"events", "from", me(), "--json"})};
  auto add = [&] {
    return ask({"wm", "add", "kitchen", "Order", soup}).status == 0 &&
           events.output().find("ADD") != std::string::npos;
  };
  EXPECT_TRUE(eventually(add)) << events.errors();
  castor->send_signal(SIGINT);
  EXPECT_EQ(castor->wait(), 0);
  auto journal = (folder / "journals" / "kitchen.castor-journal").string();
  auto shown = ask({"journal", "show", journal, "added", "Order", "from", me(), "--json"});
  EXPECT_EQ(shown.status, 0) << shown.errors;
  EXPECT_EQ(json_lines(shown.output).front()["component"], me());
  EXPECT_THAT(refused({"journal", "show", journal, "added", "Ordre"}),
              HasSubstr("no type Ordre; did you mean 'Order'?"));
  EXPECT_THAT(refused({"journal", "show", journal, "added", "Order", "where", "dsh == \"soup\""}),
              HasSubstr("did you mean 'dish'?"));
  EXPECT_THAT(refused({"journal", "show", journal, "in", "kitchn"}), HasSubstr("'kitchen'"));
}

TEST_F(Operator, SeesTheTypesThatAreKnown) {
  auto castor = start();
  EXPECT_THAT(ask({"wm", "types"}).output, ContainsRegex("\nReceipt +total\n"));
  auto receipt = ask({"wm", "types", "Receipt", "--json"});
  EXPECT_EQ(json::parse(receipt.output), (json{{"type", "Receipt"},
                                               {"super_types", json::array()},
                                               {"fields", {{"total", "a number"}}},
                                               {"example", {{"total", 0.0}}}}));
  auto order = json::parse(ask({"wm", "types", "Order", "--json"}).output);
  EXPECT_EQ(ask({"wm", "add", "kitchen", "Order", order["example"].dump()}).status, 0);
  EXPECT_THAT(refused({"wm", "types", "Ordre"}), HasSubstr("did you mean 'Order'?"));
}

TEST_F(Operator, CallsAndIsAnswered) {
  auto castor = start();
  auto answer = ask({"call", "kitchen", "Boil", R"({"litres": 1.5})"});
  EXPECT_EQ(answer.status, 0) << answer.errors;
  EXPECT_EQ(json::parse(answer.output), (json{{"litres", 1.5}, {"by", "cook"}}));
  answer = ask({"call", "kitchen", "Boil", R"({"litres": 2})", "--json"});
  EXPECT_EQ(json::parse(answer.output), (json{{"subarchitecture", "kitchen"},
                                              {"server", "cook"},
                                              {"type", "Boiled"},
                                              {"value", {{"litres", 2.0}, {"by", "cook"}}}}));
  // What calls consist of goes with them.
  EXPECT_TRUE(eventually([] {
    return ask({"wm", "ls", "kitchen/Call"}).output.find("call:") == std::string::npos &&
           ask({"wm", "ls", "kitchen/Boiled"}).output.find("call:") == std::string::npos;
  }));
}

TEST_F(Operator, CommandsAnEffectorUnderItsLease) {
  auto castor = start("COMPONENT CPP stove Stove\n");
  ASSERT_EQ(ask({"wm", "add", "kitchen/guarded", "Order", soup}).status, 0);
  auto once = ask({"command", "stove", "Heat", R"({"degrees": 90})"});
  EXPECT_EQ(once.status, 0) << once.errors;
  EXPECT_EQ(once.output, "stove has obeyed. It takes its safe state now.\n");
  EXPECT_TRUE(castor->wait_for_output("has 90 degrees"));
  EXPECT_TRUE(castor->wait_for_output("has 0 degrees"));
  auto often = ask({"command", "stove", "Heat", R"({"degrees": 80})", "--for", "400ms", "--json"});
  EXPECT_EQ(often.status, 0) << often.errors;
  EXPECT_GT(json::parse(often.output)["commands"], 2);
}

TEST_F(Operator, SeesWhoIsObeyedUntilTheCommanderIsGone) {
  auto castor = start("COMPONENT CPP stove Stove\n");
  ASSERT_EQ(ask({"wm", "add", "kitchen/guarded", "Order", soup}).status, 0);
  Process commander{command({"command", "stove", "Heat", R"({"degrees": 70})", "--for", "1h"})};
  EXPECT_TRUE(
    eventually([] { return ask({"ps"}).output.find("obeys " + me()) != std::string::npos; }));
  commander.send_signal(SIGKILL);
  EXPECT_TRUE(castor->wait_for_output("has 0 degrees"));
  EXPECT_TRUE(eventually([] { return ask({"ps"}).output.find("obeys") == std::string::npos; }));
}

TEST_F(Operator, IsToldWhyACommandIsNotObeyed) {
  auto castor = start("COMPONENT CPP stove Stove\n", "CPP UM guard Guard\n");
  ASSERT_TRUE(castor->wait_for_output("guards"));
  auto heat = [](const std::string& effector, const std::string& type, const std::string& value) {
    return refused({"command", effector, type, value});
  };
  EXPECT_THAT(heat("stove", "Heat", R"({"degrees": 90})"),
              HasSubstr("guard of kitchen holds a lease"));
  EXPECT_THAT(heat("stov", "Heat", "{}"), HasSubstr("did you mean 'stove'?"));
  EXPECT_THAT(heat("stove", "Het", "{}"), HasSubstr("did you mean 'Heat'?"));
  EXPECT_THAT(heat("stove", "Heat", R"({"degree": 90})"), HasSubstr("did you mean 'degrees'?"));
  EXPECT_THAT(heat("stove", "Order", soup), HasSubstr("stove obeys commands of the type Heat"));
}

TEST_F(Operator, IsToldWhyACallFails) {
  auto castor = start("SUBARCHITECTURE cellar\nCPP WM SubarchitectureWorkingMemory\n"
                      "CPP TM AlwaysPositiveTaskManager\n");
  EXPECT_THAT(refused({"call", "kitchen", "Boil", R"({"litres": 0})"}),
              HasSubstr("cook of kitchen could not serve the Boil: there is nothing to boil"));
  EXPECT_THAT(refused({"call", "kitchen", "Boli", "{}"}),
              HasSubstr("serves calls of the type Boli; did you mean 'Boil'?"));
  EXPECT_THAT(refused({"call", "kitchen", "Transport", "{}"}), HasSubstr("there are: Boil"));
  EXPECT_THAT(refused({"call", "cellar", "Boil", "{}"}),
              HasSubstr("no component of cellar serves calls"));
  EXPECT_THAT(refused({"call", "kitchen", "Boil", R"({"liters": 1})"}),
              HasSubstr("did you mean 'litres'?"));
  EXPECT_THAT(refused({"call", "kitchen", "Boil", R"({"litres": 1000})", "--timeout", "200ms"}),
              HasSubstr("no reply to the Boil in 0.2 s: cook of kitchen is still at work on it"));
  // Who waits no longer is not in the way of others.
  EXPECT_EQ(ask({"call", "kitchen", "Boil", R"({"litres": 1})"}).status, 0);
}

} // namespace

} // namespace castor::test
