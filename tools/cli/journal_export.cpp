#include "castor/tools/cli/journal_export.hpp"

#include "castor/tools/cli/mcap_export.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/progress.hpp"
#include "castor/tools/cli/replay_source.hpp"
#include "castor/tools/cli/writable.hpp"
#include "castor/wm/journal/journal_reader.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace castor::cli {

namespace {

struct JournalExportArguments {
  std::vector<std::string> places;
  std::string mcap;
  std::string jsonl;
  bool json = false;
};

/// What of a recording comes next: from a journal, or from what a stand-alone component handed out.
template <class Reader, class Item>
struct Track {
  explicit Track(const std::filesystem::path& file) : reader(file), next(reader.next()) {}

  Reader reader;
  std::string name;
  std::optional<Item> next;
};

using JournalTrack = Track<JournalReader, JournalRecord>;
using PushTrack = Track<PushLogReader, RecordedPush>;

template <class T>
T* earliest(std::vector<std::unique_ptr<T>>& tracks) {
  T* result = nullptr;
  for (auto& x : tracks)
    if (x->next && (!result || x->next->time < result->next->time))
      result = x.get();
  return result;
}

/// Several files as one stream in the order of time.
template <class OnChange, class OnValue>
void for_each_step(const ReplaySource& source, OnChange&& on_change, OnValue&& on_value) {
  std::vector<std::unique_ptr<JournalTrack>> journals;
  for (auto& x : source.journals) {
    journals.push_back(std::make_unique<JournalTrack>(x));
    journals.back()->name = journals.back()->reader.summary().subarchitecture;
  }
  std::vector<std::unique_ptr<PushTrack>> pushes;
  for (auto& x : source.pushes) {
    pushes.push_back(std::make_unique<PushTrack>(x));
    pushes.back()->name = pushes.back()->reader.summary().provider;
  }
  for (;;) {
    auto* journal = earliest(journals);
    auto* push = earliest(pushes);
    if (push && (!journal || push->next->time <= journal->next->time)) {
      on_value(push->name, *push->next);
      push->next = push->reader.next();
    } else if (journal) {
      on_change(journal->name, *journal->next);
      journal->next = journal->reader.next();
    } else {
      return;
    }
  }
}

/// Shows how far the export is.
class ExportProgress {
public:
  explicit ExportProgress(const ReplaySource& source) {
    total_ = source.contents.changes;
    for (auto& x : source.contents.pushes)
      total_ += x.pushes + x.pulls;
  }

  void step() {
    ++done_;
    if (progress_.due())
      progress_.update(static_cast<double>(done_), static_cast<double>(total_),
                       fmt::format("{} of {} changes and pushes", done_, total_));
  }

private:
  std::uint64_t total_ = 0;
  std::uint64_t done_ = 0;
  Progress progress_{"export"};
};

void export_mcap(const JournalExportArguments& arguments, const ReplaySource& source) {
  McapExport to{arguments.mcap};
  ExportProgress progress{source};
  auto add = [&](const std::string& name, auto& x) {
    to.add(name, x);
    progress.step();
  };
  for_each_step(source, add, add);
  to.close();
}

void export_jsonl(const JournalExportArguments& arguments, const ReplaySource& source) {
  std::ofstream file;
  if (arguments.jsonl != "-")
    file = create(arguments.jsonl);
  for_each_step(
    source,
    [&](const std::string& name, const JournalRecord& x) {
      auto line = message_of(name, x) + '\n';
      if (file.is_open())
        file << line;
      else
        std::fputs(line.c_str(), stdout);
    },
    [](const std::string&, const RecordedPush&) {});
  if (file.is_open() && !file.flush())
    throw std::runtime_error("cannot write " + arguments.jsonl);
}

void print_written(const char* format, const std::string& file, const RecordingContents& contents,
                   bool has_values) {
  std::uint64_t values = 0;
  for (auto& x : contents.pushes)
    values += x.pushes + x.pulls;
  std::error_code error;
  auto bytes = std::filesystem::file_size(file, error);
  nlohmann::ordered_json line{{"file", file},
                              {"format", format},
                              {"changes", contents.changes},
                              {"values", has_values ? values : 0},
                              {"bytes", error ? 0 : bytes}};
  fmt::print("{}\n", line.dump());
}

int export_changes(const JournalExportArguments& arguments) {
  if (arguments.mcap.empty() && arguments.jsonl.empty())
    throw std::runtime_error("say what to write: --mcap OUT or --jsonl OUT");
  auto source = find_replay_source(arguments.places);
  if (!arguments.mcap.empty()) {
    export_mcap(arguments, source);
    if (arguments.json)
      print_written("mcap", arguments.mcap, source.contents, true);
  }
  if (!arguments.jsonl.empty()) {
    export_jsonl(arguments, source);
    if (arguments.json && arguments.jsonl != "-")
      print_written("jsonl", arguments.jsonl, source.contents, false);
  }
  return success;
}

} // namespace

void add_journal_export(CLI::App& journal, Action& chosen) {
  auto arguments = std::make_shared<JournalExportArguments>();
  auto* command = journal.add_subcommand("export", "export a recording in another format");
  add_places_argument(*command, arguments->places);
  command
    ->add_option("--mcap", arguments->mcap,
                 "MCAP for Foxglove and Lichtblick: a topic for each type; pictures, poses and "
                 "boxes also as messages that these display")
    ->type_name("OUT")
    ->check(check_output_file);
  command->add_option("--jsonl", arguments->jsonl, "JSON, one change on a line; - prints it")
    ->type_name("OUT")
    ->check([](const std::string& x) { return x == "-" ? std::string{} : check_output_file(x); });
  command->add_flag("--json", arguments->json,
                    "print what was written as JSON, one file on a line; beside --jsonl - nothing");
  command->footer("Examples: castor journal export today --mcap today.mcap\n"
                  "          castor journal export journals/*.castor-journal --jsonl run.jsonl");
  command->callback(
    [&chosen, arguments] { chosen = [arguments] { return export_changes(*arguments); }; });
}

} // namespace castor::cli
