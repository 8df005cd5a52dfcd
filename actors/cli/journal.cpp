#include "castor/actors/cli/commands.hpp"
#include "castor/actors/cli/inspection_text.hpp"
#include "castor/actors/cli/journal_export.hpp"
#include "castor/actors/cli/journal_replay.hpp"
#include "castor/actors/cli/progress.hpp"
#include "castor/actors/cli/recorded_change.hpp"
#include "castor/actors/cli/table.hpp"
#include "castor/actors/cli/timeline.hpp"
#include "castor/actors/node/inspection_json.hpp"
#include "castor/actors/node/known_names.hpp"
#include "castor/wm/change_filter_parser.hpp"
#include "castor/wm/journal_reader.hpp"
#include "castor/wm/json.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

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

struct Arguments {
  std::string file;
  std::vector<std::string> files;
  std::vector<std::string> filter;
  bool json = false;
  bool entries = false;
  bool full = false;
};

using ArgumentsPtr = std::shared_ptr<Arguments>;

/// Byte fields are shown up to this length, unless everything is wanted.
constexpr std::size_t shown_bytes = 64;

double seconds(UnixTime x) {
  return std::chrono::duration<double>(x).count();
}

std::string date(UnixTime x) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S}",
                     fmt::localtime(std::chrono::duration_cast<std::chrono::seconds>(x).count()));
}

// --- ls ---

/// The journals among these files, and those in these folders.
std::vector<std::filesystem::path> journals_in(std::vector<std::string> places) {
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
      if (i->path().extension() == journal_extension)
        result.push_back(i->path());
    if (error)
      throw std::runtime_error("cannot look for journals in the folder " + x + ": " +
                               error.message());
  }
  std::sort(result.begin(), result.end());
  return result;
}

int list(const Arguments& arguments) {
  Table table{{"subarchitecture", ">entries", ">changes", "first", "last", ">size", ">sessions",
               ">incarnation", "state", "file"}};
  int status = success;
  for (auto& file : journals_in(arguments.files)) {
    try {
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
      if (arguments.json) {
        fmt::print("{}\n", Json{{"subarchitecture", x.subarchitecture},
                                {"file", file.string()},
                                {"entries", entries},
                                {"changes", x.changes},
                                {"sequence", x.sequence},
                                {"first", seconds(x.first)},
                                {"last", seconds(x.last)},
                                {"bytes", x.bytes},
                                {"session", x.session},
                                {"incarnation", x.incarnation},
                                {"clean", x.clean}}
                             .dump());
        continue;
      }
      table.add({x.subarchitecture, std::to_string(entries), std::to_string(x.changes),
                 x.changes > 0 ? date(x.first) : "", x.changes > 0 ? date(x.last) : "",
                 fmt::format("{:.1f} MB", static_cast<double>(x.bytes) / 1e6),
                 std::to_string(x.session), std::to_string(x.incarnation),
                 x.clean ? "clean" : "in use, or not ended in order", file.string()});
    } catch (const JournalError& e) {
      fmt::print(stderr, "{}\n", e.what());
      status = bad_input;
    }
  }
  // Of journals that cannot be read, only that is said.
  if (!arguments.json && (status == success || !table.empty()))
    fmt::print("{}", table.text());
  return status;
}

// --- changes ---

/// Whether a change is one of those asked for; it is to be asked of all, in their order.
class Sieve {
public:
  explicit Sieve(const std::vector<std::string>& words)
    : filter_(parse_change_filter(fmt::format("{}", fmt::join(words, " ")))) {}

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

int show(const Arguments& arguments) {
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
                  const ArgumentsPtr& arguments, F f) {
  auto* result = app.add_subcommand(name, help);
  result->callback([&chosen, arguments, f] { chosen = [arguments, f] { return f(*arguments); }; });
  return result;
}

} // namespace

void add_journal(CLI::App& app, Action& chosen) {
  auto* journal = app.add_subcommand("journal", "look into the journals of working memories");
  journal->require_subcommand(1);
  journal->footer(
    "A working memory keeps a journal if its WM line says --journal full or --journal "
    "batched; --journal-keep makes it a recording.");

  auto arguments = std::make_shared<Arguments>();
  auto* ls = command(*journal, "ls", "list journals, and see whether they are sound", chosen,
                     arguments, list);
  ls->add_option("PLACE", arguments->files, "journals, or folders with some; otherwise `journals`")
    ->type_name("FILE|DIR");
  ls->add_flag("--json", arguments->json, "print JSON, one object on a line");
  ls->footer("Example: castor journal ls recordings");

  arguments = std::make_shared<Arguments>();
  auto* show_command =
    command(*journal, "show", "print the changes, or the entries", chosen, arguments, show);
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
    "          castor journal show journals/vision.castor-journal --entries --json");

  add_journal_export(*journal, chosen);
  add_journal_replay(*journal, chosen);
}

} // namespace castor::cli
