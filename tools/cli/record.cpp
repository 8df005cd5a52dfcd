#include "castor/tools/cli/record.hpp"

#include "castor/actors/cast/writer.hpp"
#include "castor/actors/node/placement.hpp"
#include "castor/actors/node/working_memory_class.hpp"
#include "castor/tools/cli/output.hpp"
#include "castor/tools/cli/writable.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <set>
#include <stdexcept>
#include <system_error>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

/// MB of pushes and pulls that are kept.
constexpr std::uint64_t default_limit = 1024;

void set_option(ComponentDescription& component, const std::string& name,
                const std::string& value) {
  std::erase_if(component.options, [&](auto& x) { return x.name() == name; });
  component.options.push_back({"--" + name, value, component.where});
}

/// The folder is new or empty, and can be written.
void prepare_folder(const fs::path& folder) {
  cli::make_folder(folder);
  std::error_code error;
  auto is_empty = fs::is_empty(folder, error);
  if (error)
    throw std::runtime_error("cannot read the folder " + folder.string() + ": " + error.message() +
                             "; choose another folder");
  if (RecordingFolder::is_one(folder))
    throw std::runtime_error(folder.string() + " holds a recording: choose another folder, or "
                                               "remove it");
  if (!is_empty)
    throw std::runtime_error(folder.string() + " is not empty: a recording needs a new or an empty "
                                               "folder");
}

/// A journal that entries are to come back from cannot be kept somewhere else for one run.
void refuse_own_journals(const ArchitectureDescription& architecture) {
  for (auto& x : architecture.subarchitectures) {
    WorkingMemoryClass wm{x.working_memory};
    if (wm.journal.get() != JournalMode::off)
      throw std::runtime_error(fmt::format(
        "{}: {} keeps a journal of its own, which --record would not go on with: say --journal "
        "batched, too, and the run is recorded and begins without the entries of that journal",
        to_string(x.working_memory.where), x.working_memory.name));
  }
}

std::string count(std::uint64_t number, const char* singular, const char* plural) {
  return fmt::format("{} {}", number, number == 1 ? singular : plural);
}

std::string in_quotes_if_needed(const std::string& x) {
  return x.find(' ') == x.npos ? x : '"' + x + '"';
}

} // namespace

void add_record_arguments(CLI::App& command, RecordArguments& arguments) {
  auto* record =
    command
      .add_option("--record", arguments.folder,
                  "record every change on the working memories and what stand-alone components "
                  "push and answer, such as pictures, into this new folder; `castor journal "
                  "replay DIR` replays it")
      ->type_name("DIR")
      ->check(check_output_folder);
  command
    .add_option("--record-limit", arguments.limit,
                fmt::format("MB that recorded pushes and answers may take; beyond that the oldest "
                            "are dropped; by default {}",
                            default_limit))
    ->type_name("MB")
    ->check(CLI::PositiveNumber)
    ->needs(record);
  command
    .add_option(
      "--journal", arguments.journal,
      "journal mode of all working memories, whatever the file says: full, batched or off")
    ->type_name("MODE")
    ->check(CLI::IsMember({"full", "batched", "off"}));
  command
    .add_option("--journal-dir", arguments.journal_folder,
                "the folder of these journals, whatever the file says")
    ->type_name("DIR")
    ->check(check_output_folder)
    ->excludes(record);
}

void apply_journal_arguments(const RecordArguments& arguments,
                             ArchitectureDescription& architecture) {
  for (auto& x : architecture.subarchitectures) {
    if (!arguments.journal.empty())
      set_option(x.working_memory, "journal", arguments.journal);
    if (!arguments.journal_folder.empty())
      set_option(x.working_memory, "journal-dir", arguments.journal_folder);
  }
}

RunRecording::RunRecording(const RecordArguments& arguments, const ArchitectureArguments& read_from,
                           const std::string& until_quiet, ArchitectureDescription& architecture,
                           SystemOptions& options, bool nodes_are_local)
  : folder_(fs::absolute(arguments.folder).lexically_normal()),
    limit_(arguments.limit.value_or(default_limit)) {
  if (arguments.journal == "off")
    throw std::runtime_error("--record needs journals: remove --journal off");
  if (arguments.journal.empty())
    refuse_own_journals(architecture);
  prepare_folder(folder_.path());
  facts_ = {read_from.file, variables_of(read_from), CASTOR_VERSION, unix_now(), {}, until_quiet};
  folder_.write(facts_);
  create(folder_.system_file()) << "# " << read_from.file
                                << " as it was run, without variables and includes\n\n"
                                << cast::to_cast(architecture);
  for (auto& x : architecture.subarchitectures) {
    set_option(x.working_memory, "journal",
               arguments.journal.empty() ? "batched" : arguments.journal);
    set_option(x.working_memory, "journal-dir", folder_.path().string());
    set_option(x.working_memory, "journal-keep", "true");
  }
  options.pushes = folder_.path();
  options.pushes_limit = limit_ << 20;
  has_other_machines_ = !nodes_are_local && !other_hosts(architecture).empty();
}

FinishedRecording RunRecording::finish(const std::vector<std::string>& plugins, Timestamp lasted) {
  facts_.end = facts_.begin + lasted;
  folder_.write(facts_);
  std::string replay = "castor ";
  for (auto& x : plugins)
    replay += "--plugin " + in_quotes_if_needed(fs::absolute(x).string()) + ' ';
  replay += "journal replay " + in_quotes_if_needed(folder_.path().string());
  return {folder_.path(),
          contents_of(files_in(folder_.path(), journal_extension),
                      files_in(folder_.path(), push_log_extension)),
          limit_, has_other_machines_, replay};
}

std::string in_words(const FinishedRecording& x) {
  auto& contents = x.contents;
  auto folder = x.folder.string();
  auto result = fmt::format("recorded in {}: {} of {} ({} in the end)", folder,
                            count(contents.changes, "change", "changes"),
                            count(contents.changes_by.size(), "working memory", "working memories"),
                            count(contents.entries, "entry", "entries"));
  std::uint64_t dropped = 0;
  std::uint64_t lost = 0;
  for (auto& y : contents.pushes) {
    result += fmt::format(", {} and {} of {}", count(y.pushes, "push", "pushes"),
                          count(y.pulls, "answer to a pull", "answers to pulls"), y.provider);
    dropped += y.dropped;
    lost += y.lost;
  }
  result += fmt::format("; {:.1f} MB\n", static_cast<double>(contents.bytes) / 1e6);
  if (dropped > 0)
    result += fmt::format("the {} oldest pushes and answers were dropped, for they took more than "
                          "{} MB (--record-limit)\n",
                          dropped, x.limit);
  if (lost > 0)
    result += fmt::format("{} pushes and answers are missing, for the disk was too slow\n", lost);
  if (x.has_other_machines)
    result +=
      fmt::format("what was recorded on other machines is there in {}: copy it together\n", folder);
  return result + "replay it with: " + x.replay + '\n';
}

nlohmann::ordered_json to_json(const FinishedRecording& x) {
  nlohmann::ordered_json result{{"folder", x.folder.string()},
                                {"entries", x.contents.entries},
                                {"changes", x.contents.changes},
                                {"bytes", x.contents.bytes},
                                {"other_machines", x.has_other_machines},
                                {"replay", x.replay},
                                {"providers", nlohmann::ordered_json::array()}};
  for (auto& y : x.contents.pushes)
    result["providers"].push_back(to_json(y));
  return result;
}

} // namespace castor::cli
