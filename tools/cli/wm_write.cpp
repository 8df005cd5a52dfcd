#include "castor/tools/cli/inspection_command.hpp"
#include "castor/tools/cli/running_system.hpp"
#include "castor/tools/cli/table.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace castor::cli {

namespace {

struct WmWriteArguments {
  std::string system;
  std::string where;
  std::string type;
  std::string value;
  std::optional<std::uint64_t> version;
  bool merge = false;
  bool wait = false;
  bool json = false;
};

using WmWriteArgumentsPtr = std::shared_ptr<WmWriteArguments>;

int request_write(const WmWriteArguments& arguments, Json request, const char* what_was_done) {
  auto [subarchitecture, id] = split_where(arguments.where);
  request["subarchitecture"] = subarchitecture;
  if (!id.empty())
    request["id"] = id;
  else if (request["do"] != "write")
    throw std::runtime_error("name the entry as well: " + subarchitecture + "/ID; `castor wm ls " +
                             subarchitecture + "` lists the entries");
  if (arguments.version)
    request["version"] = *arguments.version;
  auto x = ask_for_one(choose_system(arguments.system), request);
  if (arguments.json)
    print(x.dump() + '\n');
  else
    print(fmt::format("{} {}/{}, {} version {}\n", what_was_done,
                      x["subarchitecture"].get<std::string>(), x["id"].get<std::string>(),
                      x["type"].get<std::string>(), x["version"].dump()));
  return success;
}

int add_entry(const WmWriteArguments& arguments) {
  return request_write(arguments,
                       {{"do", "write"},
                        {"type", arguments.type},
                        {"value", read_json(arguments.value)},
                        {"wait", arguments.wait}},
                       "added");
}

int overwrite_entry(const WmWriteArguments& arguments) {
  return request_write(
    arguments,
    {{"do", "overwrite"}, {"value", read_json(arguments.value)}, {"merge", arguments.merge}},
    "overwrote");
}

int delete_entry(const WmWriteArguments& arguments) {
  return request_write(arguments, {{"do", "delete"}}, "deleted");
}

int list_types(const WmWriteArguments& arguments) {
  Json request{{"do", "types"}};
  if (!arguments.type.empty())
    request["type"] = arguments.type;
  auto types = ask_for_all(choose_system(arguments.system), request);
  if (arguments.json) {
    for (auto& x : types)
      print(x.dump() + '\n');
    return success;
  }
  if (arguments.type.empty()) {
    Table table{{"type", "fields"}};
    for (auto& x : types) {
      std::string fields;
      for (auto& [name, kind] : x["fields"].items())
        fields += (fields.empty() ? "" : ", ") + name;
      table.add({x["type"].get<std::string>(), fields});
    }
    print(table.text());
    return success;
  }
  for (auto& x : types) {
    Table table{{x["type"].get<std::string>(), ""}};
    for (auto& [name, kind] : x["fields"].items())
      table.add({name, kind.get<std::string>()});
    print(table.text() + "\nfor instance: '" + x["example"].dump() + "'\n");
  }
  return success;
}

void add_version(CLI::App& command, const WmWriteArgumentsPtr& arguments) {
  command
    .add_option("--version", arguments->version,
                "only if the entry still has this version; `castor wm ls` shows it")
    ->type_name("N");
}

void add_value(CLI::App& command, const WmWriteArgumentsPtr& arguments) {
  command
    .add_option("JSON", arguments->value,
                "the value as `castor wm get` prints it; - reads it from standard input")
    ->required();
}

CLI::App* writing_command(CLI::App& wm, const std::string& name, const std::string& help,
                          const char* where, const WmWriteArgumentsPtr& arguments, Action& chosen,
                          int (*f)(const WmWriteArguments&)) {
  auto* result = inspection_command(wm, name, help, arguments->system);
  result->add_option("WHERE", arguments->where, "the subarchitecture, and the id of the entry")
    ->type_name(where)
    ->required();
  add_json_flag(*result, arguments->json);
  on_call(*result, chosen, arguments, f);
  return result;
}

} // namespace

void add_wm_writes(CLI::App& wm, Action& chosen) {
  auto arguments = std::make_shared<WmWriteArguments>();
  auto* command = writing_command(wm, "add", "add an entry", "SUBARCHITECTURE[/ID]", arguments,
                                  chosen, add_entry);
  command->add_option("TYPE", arguments->type, "of the entry; `castor wm types` lists them")
    ->required();
  add_value(*command, arguments);
  command->add_flag("--wait", arguments->wait,
                    "wait until the subarchitecture and the type are there");
  command->footer(
    "All fields but optional ones are required; `castor wm types TYPE` prints an example.\n"
    "Without ID a new id is generated and printed.\n"
    "The source of the change is operator:USER, in events, traces and journals.\n"
    "Examples: castor wm add kitchen Order '{\"dish\": \"soup\", \"table\": 4}'\n"
    "          castor wm add kitchen/order7 Order - < order.json");

  arguments = std::make_shared<WmWriteArguments>();
  command = writing_command(wm, "overwrite", "overwrite an entry", "SUBARCHITECTURE/ID", arguments,
                            chosen, overwrite_entry);
  add_value(*command, arguments);
  add_version(*command, arguments);
  command->add_flag("--merge", arguments->merge,
                    "change only the fields that are given; lists are replaced as a whole");
  command->footer(
    "An entry is not overwritten if it has changed since it was read, or if another component "
    "holds a lease of it.\n"
    "Examples: castor wm overwrite kitchen/order7 '{\"dish\": \"soup\", \"table\": 5}'\n"
    "          castor wm overwrite kitchen/order7 --merge '{\"table\": 5}' --version 3");

  arguments = std::make_shared<WmWriteArguments>();
  command = writing_command(wm, "delete", "delete an entry", "SUBARCHITECTURE/ID", arguments,
                            chosen, delete_entry);
  add_version(*command, arguments);
  command->footer("Example: castor wm delete kitchen/order7");

  arguments = std::make_shared<WmWriteArguments>();
  command = inspection_command(wm, "types", "list the entry types that the system knows",
                               arguments->system);
  command->add_option("TYPE", arguments->type,
                      "show the fields of this type and of those that derive from it, with an "
                      "example of a value");
  add_json_flag(*command, arguments->json);
  command->footer("Examples: castor wm types\n"
                  "          castor wm types SceneObject");
  command->callback(
    [&chosen, arguments] { chosen = [arguments] { return list_types(*arguments); }; });
}

} // namespace castor::cli
