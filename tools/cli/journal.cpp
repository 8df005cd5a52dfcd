#include "castor/actors/runtime/push_log.hpp"
#include "castor/actors/system/inspection_json.hpp"
#include "castor/actors/system/known_names.hpp"
#include "castor/base/duration.hpp"
#include "castor/tools/cli/commands.hpp"
#include "castor/tools/cli/inspection_text.hpp"
#include "castor/tools/cli/journal_export.hpp"
#include "castor/tools/cli/journal_replay.hpp"
#include "castor/tools/cli/on_call.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/recorded_change.hpp"
#include "castor/tools/cli/recorded_run.hpp"
#include "castor/tools/cli/table.hpp"
#include "castor/tools/cli/timeline.hpp"
#include "castor/wm/filters/change_filter_parser.hpp"
#include "castor/wm/journal/journal_reader.hpp"
#include "castor/wm/values/json.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <nlohmann/json.hpp>

#include <fmt/chrono.h>
#include <fmt/core.h>
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unordered_map>
#include <vector>

namespace castor::cli {

namespace {

struct JournalArguments {
  std::string file;
  std::vector<std::string> files;
  std::vector<std::string> filter;
  bool json = false;
  bool entries = false;
  bool full = false;
};

using JournalArgumentsPtr = std::shared_ptr<JournalArguments>;

/// Byte fields are shown up to this length, unless everything is wanted.
constexpr std::size_t shown_bytes = 64;

std::string date(UnixTime x) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S}",
                     fmt::localtime(std::chrono::duration_cast<std::chrono::seconds>(x).count()));
}

// --- ls ---

bool is_recorded_file(const std::filesystem::path& x) {
  return x.extension() == journal_extension || x.extension() == push_log_extension;
}

/// These files, and the journals and push files in these folders.
std::vector<std::filesystem::path> recorded_files_in(std::vector<std::string> places) {
  if (places.empty())
    places.push_back("journals");
  std::vector<std::filesystem::path> result;
  for (auto& x : places) {
    std::error_code error;
    if (!std::filesystem::is_directory(x, error)) {
      result.push_back(x);
      continue;
    }
    for (std::filesystem::directory_iterator i{x, error}, end; !error && i != end;
         i.increment(error))
      if (is_recorded_file(i->path()))
        result.push_back(i->path());
    if (error)
      throw std::runtime_error("cannot look for journals in the folder " + x + ": " +
                               error.message());
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string size_of(std::uint64_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

/// The line of a journal, which is read for that. Throws JournalError.
void list_journal(const std::filesystem::path& file, bool as_json, Table& table) {
  JournalReader reader{file};
  auto x = reader.summary();
  std::size_t entries = 0;
  {
    Progress progress{"reading " + file.filename().string()};
    std::uint64_t changes = 0;
    auto image = reader.replay([&](const JournalRecord&) {
      ++changes;
      if (progress.due())
        progress.update(static_cast<double>(changes), static_cast<double>(x.changes),
                        fmt::format("{} of {} changes", changes, x.changes));
    });
    entries = image.size();
  }
  if (as_json) {
    fmt::print("{}\n", Json{{"subarchitecture", x.subarchitecture},
                            {"file", file.string()},
                            {"entries", entries},
                            {"changes", x.changes},
                            {"sequence", x.sequence},
                            {"first", in_seconds(x.first)},
                            {"last", in_seconds(x.last)},
                            {"bytes", x.bytes},
                            {"session", x.session},
                            {"incarnation", x.incarnation},
                            {"clean", x.clean}}
                         .dump());
    return;
  }
  table.add({x.subarchitecture, std::to_string(entries), std::to_string(x.changes),
             x.changes > 0 ? date(x.first) : "", x.changes > 0 ? date(x.last) : "",
             size_of(x.bytes), std::to_string(x.session), std::to_string(x.incarnation),
             x.clean ? "clean" : "in use, or not ended in order", file.string()});
}

/// The line of what a stand-alone component handed out. Throws JournalError.
void list_pushes(const std::filesystem::path& file, bool as_json, Table& table) {
  PushLogReader reader{file};
  auto x = reader.summary();
  {
    Progress progress{"reading " + file.filename().string()};
    auto total = static_cast<double>(x.pushes + x.pulls);
    for (std::uint64_t values = 1; reader.next(); ++values)
      if (progress.due())
        progress.update(static_cast<double>(values), total);
  }
  if (as_json) {
    auto line = to_json(x);
    line["file"] = file.string();
    fmt::print("{}\n", line.dump());
    return;
  }
  bool has_values = x.pushes + x.pulls > 0;
  table.add({x.provider, std::to_string(x.pushes), std::to_string(x.pulls),
             has_values ? date(x.first) : "", has_values ? date(x.last) : "", size_of(x.bytes),
             std::to_string(x.dropped), std::to_string(x.lost), file.string()});
}

int list_journals(const JournalArguments& arguments) {
  Table journals{{"subarchitecture", ">entries", ">changes", "first", "last", ">size", ">sessions",
                  ">incarnation", "state", "file"}};
  Table pushes{{"stand-alone component", ">pushes", ">pulls", "first", "last", ">size", ">dropped",
                ">lost", "file"}};
  int status = success;
  for (auto& file : recorded_files_in(arguments.files)) {
    try {
      if (file.extension() == push_log_extension)
        list_pushes(file, arguments.json, pushes);
      else
        list_journal(file, arguments.json, journals);
    } catch (const JournalError& e) {
      fmt::print(stderr, "{}\n", e.what());
      status = bad_input;
    }
  }
  if (arguments.json)
    return status;
  // Of files that cannot be read, only that is said.
  bool has_pushes = !pushes.empty();
  if (!journals.empty() || (status == success && !has_pushes))
    fmt::print("{}", journals.text());
  if (has_pushes)
    fmt::print("{}{}", journals.empty() ? "" : "\n", pushes.text());
  return status;
}

// --- changes ---

/// Whether a change is one of those asked for; it is to be asked of all, in their order.
class Sieve {
public:
  explicit Sieve(const std::vector<std::string>& words)
    : filter_(parse_change_filter(change_filter_text(words))) {}

  bool lets_pass(const ChangeEvent& event, const Value& value) {
    auto& last = contents_[event.address];
    // What was deleted is judged by what it was.
    auto content = value.has_value() ? value : last;
    last = value;
    return matches(filter_, event, content);
  }

  /// Throws std::runtime_error if the filter names what is not in the journal.
  void check(const std::filesystem::path& journal, const std::string& subarchitecture) const {
    if (filter_ == parse_change_filter(""))
      return;
    KnownNames known{{}, {subarchitecture}, {}};
    auto image = JournalReader{journal}.replay([&](const JournalRecord& x) {
      known.types.emplace(x.type->name(), x.type);
      known.sources.insert(x.source);
    });
    for (auto& x : image.store().entries) {
      known.types.emplace(x.entry->type_name(), x.entry->value.type_ptr());
      known.sources.insert(x.entry->writer);
    }
    check_names(filter_, known);
  }

private:
  ChangeFilter filter_;
  std::unordered_map<Address, Value> contents_;
};

int show_journal(const JournalArguments& arguments) {
  Sieve sieve{arguments.filter};
  auto most = arguments.full ? std::numeric_limits<std::size_t>::max() : shown_bytes;
  bool coloured = isatty(STDOUT_FILENO) != 0;
  JournalReader reader{arguments.file};
  auto summary = reader.summary();
  auto& name = summary.subarchitecture;
  sieve.check(arguments.file, name);
  if (arguments.entries) {
    std::vector<Json> entries;
    auto image = reader.replay().store();
    for (auto x = image.entries.rbegin(); x != image.entries.rend(); ++x) {
      JournalRecord record;
      record.id = x->entry->address.id;
      record.type = x->entry->value.type_ptr();
      record.source = x->entry->writer;
      if (sieve.lets_pass(event_of(record, name, {}), x->entry->value))
        entries.push_back(Json::parse(entry_as_json(*x->entry, true, most)));
    }
    if (!arguments.json)
      fmt::print("{}", entries_as_text(entries));
    for (auto& x : entries)
      if (arguments.json)
        fmt::print("{}\n", x.dump());
    return success;
  }
  if (!arguments.json)
    fmt::print("the first of {} changes is of {}\n{}\n", summary.changes, date(summary.first),
               timeline_head(coloured));
  reader.replay([&](const JournalRecord& x) {
    auto event = event_of(x, name, summary.first);
    if (!sieve.lets_pass(event, x.value))
      return;
    auto text = change_as_json(event, x.value, most);
    fmt::print("{}", arguments.json ? text + '\n' : change_as_text(Json::parse(text), coloured));
  });
  return success;
}

template <class F>
CLI::App* command(CLI::App& app, const std::string& name, const std::string& help, Action& chosen,
                  const JournalArgumentsPtr& arguments, F f) {
  auto* result = app.add_subcommand(name, help);
  on_call(*result, chosen, arguments, f);
  return result;
}

} // namespace

void add_journal(CLI::App& app, Action& chosen) {
  auto* journal =
    app.add_subcommand("journal", "inspect, export and replay journals of working memories");
  journal->require_subcommand(1);
  journal->footer(
    "A working memory keeps a journal if its WM line says --journal full or --journal "
    "batched; --journal-keep makes it a recording.");

  auto arguments = std::make_shared<JournalArguments>();
  auto* ls = command(*journal, "ls", "list journals and recordings, and check their integrity",
                     chosen, arguments, list_journals);
  ls->add_option("PLACE", arguments->files,
                 "journals and files of pushes, or folders with some; otherwise `journals`")
    ->type_name("FILE|DIR");
  ls->add_flag("--json", arguments->json, "print JSON, one object on a line");
  ls->footer("Example: castor journal ls recordings");

  arguments = std::make_shared<JournalArguments>();
  auto* show_command =
    command(*journal, "show", "print the changes, or the entries", chosen, arguments, show_journal);
  show_command->add_option("FILE", arguments->file, "the journal")->required()->type_name("");
  show_command
    ->add_option("FILTER", arguments->filter,
                 "[added|overwritten|deleted|changed] [TYPE] [from COMPONENT] [at ID] "
                 "[changing FIELD,...] [where CONDITION]")
    ->type_name("");
  show_command->add_flag("--entries", arguments->entries,
                         "the entries as they stand after the last change");
  show_command->add_flag("--json", arguments->json, "print JSON, one object on a line");
  show_command->add_flag("--full", arguments->full,
                         "show byte fields, however long, as base64 text");
  show_command->footer(
    "Examples: castor journal show journals/vision.castor-journal\n"
    "          castor journal show journals/vision.castor-journal overwritten SceneObject "
    "where 'confidence < 0.5'\n"
    "          castor journal show journals/mapping.castor-journal at \"tile 3 -1\"\n"
    "          castor journal show journals/vision.castor-journal --entries --json");

  add_journal_export(*journal, chosen);
  add_journal_replay(*journal, chosen);
}

} // namespace castor::cli
