#include "castor/tools/cli/replay_source.hpp"

#include "castor/actors/component/stand_in.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/tools/cli/record.hpp"

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace castor::cli {

namespace {

namespace fs = std::filesystem;

void append(std::vector<fs::path>& to, const std::vector<fs::path>& what) {
  to.insert(to.end(), what.begin(), what.end());
}

void take_place(ReplaySource& result, const fs::path& place) {
  std::error_code error;
  if (!fs::exists(place, error))
    throw std::runtime_error("there is no file or folder " + place.string());
  if (!fs::is_directory(place, error)) {
    (place.extension() == push_log_extension ? result.pushes : result.journals).push_back(place);
    return;
  }
  auto journals = files_in(place, journal_extension);
  auto pushes = files_in(place, push_log_extension);
  if (RecordingFolder::is_one(place)) {
    if (result.folder)
      throw std::runtime_error("only one recording can be replayed at a time");
    result.folder.emplace(place);
    result.facts = result.folder->facts();
  } else if (journals.empty() && pushes.empty()) {
    throw std::runtime_error(place.string() + " holds no recording: there is neither a journal nor "
                                              "what `castor run --record` writes");
  }
  append(result.journals, journals);
  append(result.pushes, pushes);
}

} // namespace

void add_places_argument(CLI::App& command, std::vector<std::string>& places) {
  command
    .add_option("PLACE", places, "the folder of `castor run --record`, or journals of one system")
    ->required()
    ->type_name("DIR|FILE");
}

ReplaySource find_replay_source(const std::vector<std::string>& places) {
  ReplaySource result;
  for (auto& x : places)
    take_place(result, x);
  result.contents = contents_of(result.journals, result.pushes);
  result.begin = result.folder ? result.facts.begin : result.contents.first;
  result.end = std::max(result.facts.end.value_or(UnixTime{0}), result.contents.last);
  return result;
}

std::set<std::string>
components_named(const std::vector<std::string>& names, const RecordingContents& contents,
                 const std::vector<const ArchitectureDescription*>& architectures) {
  // What each name stands for.
  std::map<std::string, std::set<std::string>> known;
  for (auto& [subarchitecture, writers] : contents.changes_by)
    for (auto& [writer, changes] : writers)
      known[writer] = {writer};
  for (auto& x : contents.pushes)
    known[x.provider] = {x.provider};
  for (auto* architecture : architectures) {
    for (auto& x : architecture->standalone)
      known[x.name] = {x.name};
    for (auto& subarchitecture : architecture->subarchitectures)
      for (auto& x : subarchitecture.components) {
        known[x.name] = {x.name};
        known[subarchitecture.name].insert(x.name);
      }
  }
  std::set<std::string> result;
  for (auto& name : names) {
    auto i = known.find(name);
    if (i == known.end()) {
      std::vector<std::string_view> candidates;
      for (auto& [other, members] : known)
        candidates.push_back(other);
      auto guess = did_you_mean(name, candidates);
      std::string all;
      for (auto& candidate : candidates)
        all += (all.empty() ? "" : ", ") + std::string{candidate};
      throw std::runtime_error("--without: there is no component or subarchitecture " + name +
                               "; " + (guess.empty() ? "there are: " + all : guess));
    }
    result.insert(i->second.begin(), i->second.end());
  }
  return result;
}

void prepare_for_replay(ArchitectureDescription& architecture,
                        const std::set<std::string>& replayed, std::vector<fs::path>& pushes) {
  std::set<std::string> recorded;
  std::erase_if(pushes, [&](auto& file) {
    auto provider = PushLogReader{file}.summary().provider;
    auto is_there =
      std::ranges::any_of(architecture.standalone, [&](auto& x) { return x.name == provider; });
    if (is_there)
      recorded.insert(provider);
    return !is_there;
  });
  auto is_replayed = [&](const ComponentDescription& x) { return replayed.count(x.name) > 0; };
  architecture.left_out = {replayed.begin(), replayed.end()};
  for (auto& x : architecture.subarchitectures)
    std::erase_if(x.components, is_replayed);
  // Those that are left out have handed out nothing, but may be commanded.
  for (auto& x : architecture.standalone) {
    if (recorded.count(x.name) == 0 && !is_replayed(x))
      continue;
    x.class_name = stand_in_class;
    x.options.clear();
  }
  RecordArguments no_journals;
  no_journals.journal = "off";
  apply_journal_arguments(no_journals, architecture);
  architecture.host_names.clear();
  architecture.failover.clear();
  for_each_component(architecture, [](auto& x) { x.host.clear(); });
}

} // namespace castor::cli
